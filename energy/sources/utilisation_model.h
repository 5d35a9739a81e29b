#pragma once

#include "energy/sources/power_source.h"
#include "energy/sources/sensor_root.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace encore::energy {

/// An estimate from processor load where there is no sensor: P = idle + (max - idle) * u, the
/// linear model between a machine's lowest and highest power (Fan, Weber, Barroso 2007). Both come
/// from the user: there is no generic table.
struct UtilisationModel {
  Watts idle;
  Watts max;                 ///< at 100 % load
  std::string detail;        ///< where the two come from
  double uncertainty = 0.4;  ///< relative; such estimates are off by 30 to 50 %

  friend bool operator==(const UtilisationModel&, const UtilisationModel&) = default;
};

/// Throws PowerModelError unless 0 <= idle < max <= kLargestModelPower.
void check(const UtilisationModel& model);

/// Processor time since the start of the machine, in clock ticks of all processors together.
struct ProcessorTicks {
  std::uint64_t busy = 0;     ///< user, nice, system, irq, softirq
  std::uint64_t waiting = 0;  ///< idle and iowait: nothing ran
  std::uint64_t stolen = 0;   ///< another guest of the host ran; neither busy nor waiting here
  unsigned processors = 0;
};
/// Reads the text of /proc/stat; nothing if it is not one.
std::optional<ProcessorTicks> parse_proc_stat(std::string_view text);

/// Shares of the processors' time; nothing if no tick passed or the counters fell.
struct Utilisation {
  double busy = 0.0;
  double stolen = 0.0;
};
std::optional<Utilisation> utilisation_between(const ProcessorTicks& from,
                                               const ProcessorTicks& to);

/// Whose load is looked at.
enum class LoadScope {
  machine,    ///< /proc/stat
  container,  ///< the cgroup's cpu.stat, against the processors that the container may use
};
/// Container, if the root looks like the inside of one and its cgroup tells its load.
LoadScope load_scope(const SensorRoot& root);

/// A counter of estimated joules, "model:utilisation". Throws PowerModelError as check() does.
std::unique_ptr<PowerSource> make_utilisation_source(const UtilisationModel& model,
                                                     const SensorRoot& root, LoadScope scope);

/// What is known of that source before it is opened.
SourceInfo utilisation_source_info(const UtilisationModel& model, LoadScope scope);

}  // namespace encore::energy
