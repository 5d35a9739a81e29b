#pragma once

#include "energy/sources/host.h"
#include "energy/sources/power_source.h"
#include "energy/sources/sensor_root.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// A RAPL zone as the kernel's powercap class shows it. Its number is no socket's number (psys
/// takes one, too), so that all meaning comes from `label`.
struct RaplZone {
  std::string id;                ///< "intel-rapl:0:1"; the numbers are hexadecimal
  std::string control;           ///< "intel-rapl", "intel-rapl-mmio"
  std::string folder;            ///< "/sys/class/powercap/intel-rapl:0:1"
  std::string label;             ///< content of `name`: "package-0", "dram"; empty if unreadable
  std::optional<Domain> domain;  ///< nothing if the label is not known
  std::string unit;              ///< of the package that it belongs to: "0", "0-die-1"; psys: ""
  std::string name;              ///< of the source: "rapl:package-0/dram", "rapl:package-0@mmio"
  [[nodiscard]] std::string energy_file() const { return folder + "/energy_uj"; }
};

/// All zones: from the flat links of /sys/class/powercap, else from the tree of
/// /sys/devices/virtual/powercap. Zones of the processor's registers (control "intel-rapl") first,
/// since the others repeat them.
std::vector<RaplZone> list_rapl_zones(const SensorRoot& root);

/// What is known of the zone's source; reads its range and its power limits.
SourceInfo describe_rapl_zone(const SensorRoot& root, const RaplZone& zone, const Host& host);

/// The counter starts over behind so many microjoules; nothing if the kernel does not tell.
std::optional<std::uint64_t> rapl_range(const SensorRoot& root, const RaplZone& zone);

/// No load draws more: a larger step is a reset.
Watts rapl_most_power(const SensorRoot& root, const RaplZone& zone);

}  // namespace encore::energy
