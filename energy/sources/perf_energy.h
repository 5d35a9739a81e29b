#pragma once

#include "energy/sources/discovery.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace encore::energy {

/// The system calls behind a perf counter, so that tests can put their own in their place. Errors
/// are negative errno values.
struct PerfCalls {
  /// Opens a counter of a PMU for all processes on one processor: a file descriptor.
  std::function<int(std::uint32_t type, std::uint64_t config, int cpu)> open;
  /// Reads the counter's 8 bytes: 0, or -ENODATA if the counter has ended.
  std::function<int(int file, std::uint64_t& value)> read;
  std::function<void(int file)> close;
};
PerfCalls system_perf_calls();

/// As find_perf_energy(root), with these calls.
std::vector<Finding> find_perf_energy(const SensorRoot& root, const PerfCalls& calls);

/// Sets those perf counters aside that powercap gives, too: both are the same register. Powercap
/// may have set its own aside (a mirrored die); what is read through perf is then no better.
void set_repeated_aside(std::vector<Finding>& perf, const std::vector<Finding>& powercap);

}  // namespace encore::energy
