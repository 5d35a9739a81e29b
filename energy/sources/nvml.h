#pragma once

#include "energy/sources/gauge_integral.h"
#include "energy/sources/nvml_library.h"
#include "energy/sources/power_source.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace encore::energy {

/// A GPU before NVML is asked about it.
struct NvidiaGpu {
  unsigned index = 0;             ///< in the order of PCI addresses, which is NVML's, too
  std::string pci_id;             ///< "0000:01:00.0"; empty where the kernel lists no such device
  std::string kernel_driver;      ///< "nvidia", "nouveau" ..., empty: none or not known
  bool asleep = false;            ///< runtime power management has switched it off
  bool sleeps_when_idle = false;  ///< runtime power management may switch it off
};

/// The ways to read a GPU, best first.
enum class NvmlMethod {
  counter,  ///< millijoules since the driver was loaded (Volta and later)
  instant,  ///< the power field over the sensor's own short window
  usage,    ///< nvmlDeviceGetPowerUsage: a mean over a second on many boards
};

/// A GPU that can be read, and how.
struct NvmlReadable {
  NvmlDevice device = nullptr;
  NvmlMethod method = NvmlMethod::usage;
  SourceInfo info;
};

/// What is known of a GPU without asking: name, unit, domain.
SourceInfo untried_nvml_info(const NvidiaGpu& gpu, const std::string& library);

/// Finds the best way that works on this GPU. The fault names what stands in the way.
std::variant<NvmlReadable, NvmlFault> probe_nvml(const NvmlSession& session, const NvidiaGpu& gpu);

/// One GPU read through NVML. Holds NVML, and so the GPU, awake until it is destroyed.
class NvmlSource final : public PowerSource {
 public:
  NvmlSource(std::shared_ptr<NvmlSession> session, NvmlReadable readable);

  [[nodiscard]] const SourceInfo& info() const override { return readable_.info; }
  ReadResult read(Seconds now) override;

 private:
  ReadResult read_counter(Seconds now);
  ReadResult read_gauge(Seconds now);
  [[nodiscard]] std::string message(const NvmlFault& fault) const;

  std::shared_ptr<NvmlSession> session_;
  NvmlReadable readable_;
  GaugeIntegral integral_;
  // Of a counter: its last value, when that changed, and the sum of its steps.
  std::optional<std::uint64_t> last_millijoules_;
  std::uint64_t sum_millijoules_ = 0;
  Seconds last_change_;
  bool failed_ = false;
};

}  // namespace encore::energy
