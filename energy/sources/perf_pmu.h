#pragma once

#include "energy/sources/power_source.h"
#include "energy/sources/sensor_root.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// Where the kernel describes its performance counters of energy.
constexpr std::string_view kPowerPmu = "/sys/bus/event_source/devices/power";

/// One energy event on one processor of the PMU's mask, which names one of each package.
struct PerfEvent {
  std::string event;  ///< "energy-pkg"
  Domain domain = Domain::package;
  std::uint32_t type = 0;
  std::uint64_t config = 0;
  int cpu = 0;
  std::string unit;     ///< as powercap numbers packages: "0", "0-die-1"; psys: ""
  double scale = 0;     ///< joules of one count
  std::string place;    ///< the event's file
  std::string problem;  ///< why it cannot be counted; empty: it may be
};

/// All energy events of known domains on all processors of the mask; empty without the PMU.
std::vector<PerfEvent> list_perf_events(const SensorRoot& root);

SourceInfo describe_perf_event(const PerfEvent& event);

/// "0-3,8" as a list; nothing if it is not one or names more than 65536 processors.
std::optional<std::vector<int>> parse_cpu_list(std::string_view text);

}  // namespace encore::energy
