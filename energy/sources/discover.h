#pragma once

#include "energy/sources/discovery.h"
#include "energy/sources/host.h"

#include <string>
#include <vector>

namespace encore::energy {

/// Looks for every kind of sensor: powercap, perf, battery, hwmon and NVML, in this order. What
/// repeats a counter of a kind before it is set aside. A kind that fails as a whole becomes a
/// finding with its message as obstacle, so that it never hides the others. Opens nothing.
/// `nvml_library`: as for find_nvml.
std::vector<Finding> discover(const SensorRoot& root, const std::string& nvml_library = {});

}  // namespace encore::energy
