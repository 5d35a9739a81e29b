#pragma once

#include "energy/sources/power_source.h"
#include "energy/sources/sensor_root.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace encore::energy {

/// Why a sensor cannot be used, and what to do about it.
struct Obstacle {
  std::string reason;  ///< "/sys/class/powercap/.../energy_uj: permission denied (mode 0400)"
  std::string fix;     ///< the exact command or setting; empty if there is none
};

/// A sensor that was found, or whose absence needs a word.
struct Finding {
  SourceInfo info;
  std::optional<Obstacle> obstacle;  ///< empty: usable
  /// Why a usable sensor is not taken by itself (a duplicate, nested, opt-in); empty: it may be.
  std::string set_aside;
  /// Opens it, each time anew; set if usable. Throws SensorError if it has gone meanwhile.
  std::function<std::unique_ptr<PowerSource>()> open;
};

/// A sensor that cannot be opened. what() is one line: place, reason, way out.
class SensorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One function a kind, each in the file of its name. They open nothing that costs energy or wakes
/// a device, and return one finding with an obstacle where the kind is absent altogether ("no
/// powercap zones: ...").
std::vector<Finding> find_rapl(const SensorRoot& root);
std::vector<Finding> find_perf_energy(const SensorRoot& root);
std::vector<Finding> find_batteries(const SensorRoot& root);
std::vector<Finding> find_hwmon(const SensorRoot& root);
/// `library`: empty to look for libnvidia-ml.so.1 in the usual places.
std::vector<Finding> find_nvml(const SensorRoot& root, const std::string& library = {});

}  // namespace encore::energy
