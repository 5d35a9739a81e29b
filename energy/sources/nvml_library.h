#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>

namespace encore::energy {

/// The results of NVML's functions that are told apart here, by NVIDIA's numbers.
enum class NvmlCode : int {
  ok = 0,
  uninitialized = 1,
  invalid_argument = 2,
  not_supported = 3,
  no_permission = 4,
  not_found = 6,
  driver_not_loaded = 9,
  function_not_found = 13,
  gpu_lost = 15,
  reset_required = 16,
  version_mismatch = 18,
  unknown = 999,
};

/// What an NVML error means in plain words, and the way out (empty if there is none).
struct NvmlFault {
  std::string reason;
  std::string fix;
};
NvmlFault explain(NvmlCode code);

/// One value of nvmlDeviceGetFieldValues, laid out as the library fills it in.
struct NvmlFieldValue {
  std::uint32_t field = 0;
  std::uint32_t scope = 0;
  std::int64_t timestamp_us = 0;
  std::int64_t latency_us = 0;
  std::uint32_t value_type = 0;
  std::int32_t result = 0;
  union {
    double as_double;
    std::uint32_t as_u32;
    std::uint64_t as_u64;
  };
  NvmlFieldValue() : as_u64(0) {}
};
static_assert(sizeof(NvmlFieldValue) == 40 && std::is_standard_layout_v<NvmlFieldValue>);

/// The number in a field value, whatever its type; an error's code if it holds none.
std::variant<double, NvmlCode> number_of(const NvmlFieldValue& value);

/// A GPU as the library knows it.
using NvmlDevice = struct NvmlDeviceTag*;

class NvmlSession;

/// NVIDIA's management library, loaded at run time; the program does not need it. Its functions are
/// looked up one by one: one that an old library lacks is null, and its feature is absent.
class NvmlLibrary : public std::enable_shared_from_this<NvmlLibrary> {
 public:
  /// Loads the library at `path`, or where the system keeps it if `path` is empty. Loading touches
  /// no device. In place of a library: why there is none.
  static std::variant<std::shared_ptr<NvmlLibrary>, NvmlFault> load(const std::string& path = {});
  ~NvmlLibrary();
  NvmlLibrary(const NvmlLibrary&) = delete;
  NvmlLibrary& operator=(const NvmlLibrary&) = delete;

  /// Starts NVML, or joins the session that runs: it ends with the last pointer to it.
  std::variant<std::shared_ptr<NvmlSession>, NvmlFault> start();

  [[nodiscard]] const std::string& path() const { return path_; }

  template <class... Arguments>
  using Function = NvmlCode (*)(Arguments...);
  // Always there.
  Function<> init = nullptr;
  Function<> shutdown = nullptr;
  Function<unsigned*> device_count = nullptr;
  Function<unsigned, NvmlDevice*> device_by_index = nullptr;
  Function<const char*, NvmlDevice*> device_by_pci_id = nullptr;
  // Null where the library lacks them.
  Function<NvmlDevice, char*, unsigned> device_name = nullptr;
  Function<NvmlDevice, char*, unsigned> device_uuid = nullptr;
  Function<char*, unsigned> driver_version = nullptr;
  Function<NvmlDevice, unsigned*, unsigned*> mig_mode = nullptr;
  Function<NvmlDevice, unsigned*> power_usage = nullptr;             ///< milliwatts
  Function<NvmlDevice, unsigned long long*> total_energy = nullptr;  ///< millijoules
  Function<NvmlDevice, int, NvmlFieldValue*> field_values = nullptr;

 private:
  friend class NvmlSession;
  NvmlLibrary(void* handle, std::string path);
  /// Name of the first indispensable function that is missing; empty if none is.
  std::string look_up();

  void* handle_ = nullptr;
  std::string path_;
  std::weak_ptr<NvmlSession> session_;
};

/// NVML started; destroying it shuts NVML down, which lets a GPU sleep again.
class NvmlSession {
 public:
  explicit NvmlSession(std::shared_ptr<NvmlLibrary> library);
  ~NvmlSession();
  NvmlSession(const NvmlSession&) = delete;
  NvmlSession& operator=(const NvmlSession&) = delete;

  [[nodiscard]] const NvmlLibrary& library() const { return *library_; }

 private:
  std::shared_ptr<NvmlLibrary> library_;
};

}  // namespace encore::energy
