#pragma once

#include "energy/sources/sensor_root.h"

#include <string>
#include <vector>

namespace encore::energy {

/// The graphics cards as far as the system's files tell without asking (and so waking) a card:
/// "name (driver)" or "name (driver version)" each, in the order of the kernel. The name is the
/// maker's where the driver gives it, else the one of the list of PCI devices, else its numbers,
/// "PCI 1002:73bf".
std::vector<std::string> read_gpus(const SensorRoot& root);

}  // namespace encore::energy
