#pragma once

#include "energy/sources/sensor_root.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// What changes while measuring and changes what is measured. What cannot be read has no value.
struct MachineState {
  std::optional<double> cpu_temperature_c;  ///< of the hottest core or package
  std::optional<double> cpu_clock_mhz;      ///< mean over the cores
  /// How often cores and packages slowed down because of heat, since the machine started. Each is
  /// counted once, however many threads show its counter.
  std::optional<std::uint64_t> throttle_events;
  std::optional<bool> on_battery;
  /// Of the first GPU that is awake and tells through sysfs; a sleeping one is not asked.
  std::optional<double> gpu_temperature_c;
  std::optional<double> gpu_clock_mhz;

  friend bool operator==(const MachineState&, const MachineState&) = default;
};

/// Wakes no device that sleeps. Reads some six small files a core: once a
/// second is no burden.
MachineState read_machine_state(const SensorRoot& root);

/// The CPU's part of it: from the processor's own sensor (coretemp, k10temp, zenpower), else from
/// the firmware's thermal zones.
std::optional<double> read_cpu_temperature(const SensorRoot& root);

/// The names of the processor's threads: "cpu0", "cpu1", ...
std::vector<std::string> list_cpus(const SensorRoot& root);

}  // namespace encore::energy
