#include "energy/sources/rapl_zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <set>

namespace encore::energy {

namespace {

constexpr std::string_view kFlat = "/sys/class/powercap";
constexpr std::string_view kTree = "/sys/devices/virtual/powercap";
constexpr std::string_view kControl = "intel-rapl";
constexpr std::string_view kPackage = "package-";
/// Counters have 32 bits, so that their range tells the size of a count.
constexpr double kCounts = 4294967295.0;
/// 2^-14 J, the count of most processors.
constexpr Joules kUsualStep(1.0 / 16384.0);

/// "intel-rapl" or "intel-rapl-mmio", then hexadecimal numbers behind colons.
bool is_zone(std::string_view id) {
  const std::size_t colon = id.find(':');
  if (id.compare(0, kControl.size(), kControl) != 0 || colon == std::string_view::npos)
    return false;
  bool digits = false;
  for (const char c : id.substr(colon + 1)) {
    const bool digit = std::isxdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit && (c != ':' || !digits)) return false;
    digits = digit;
  }
  return digits;
}

void add_zone(const SensorRoot& root, const std::string& folder, const std::string& id,
              std::vector<RaplZone>& zones) {
  const FileText label = root.read(folder + "/name");
  // A link that leads nowhere, as copies of a machine's tree may hold, is no zone.
  if (!label.text && label.error == ENOENT) return;
  RaplZone zone;
  zone.id = id;
  zone.control = id.substr(0, id.find(':'));
  zone.folder = folder;
  zone.label = label.text.value_or("");
  zones.push_back(std::move(zone));
}

void walk_tree(const SensorRoot& root, const std::string& folder, std::vector<RaplZone>& zones) {
  for (const std::string& name : root.list(folder)) {
    const std::string inner = fmt::format("{}/{}", folder, name);
    const bool control =
        name.find(':') == std::string::npos && name.compare(0, kControl.size(), kControl) == 0;
    if (is_zone(name)) add_zone(root, inner, name, zones);
    if (is_zone(name) || control) walk_tree(root, inner, zones);
  }
}

bool is_package(std::string_view label) {
  return label.size() > kPackage.size() && label.compare(0, kPackage.size(), kPackage) == 0;
}

std::optional<Domain> domain_of(std::string_view label) {
  if (is_package(label)) return Domain::package;
  if (label == "core") return Domain::cores;
  if (label == "uncore") return Domain::integrated_gpu;
  if (label == "dram") return Domain::memory;
  if (label == "psys") return Domain::platform;
  return std::nullopt;
}

/// The zone that this one lies in; null for a top zone.
const RaplZone* parent_of(const RaplZone& zone, const std::vector<RaplZone>& zones) {
  const std::string above = zone.id.substr(0, zone.id.rfind(':'));
  const auto found = std::find_if(zones.begin(), zones.end(),
                                  [&](const RaplZone& other) { return other.id == above; });
  return found == zones.end() ? nullptr : &*found;
}

void name_zones(std::vector<RaplZone>& zones) {
  std::set<std::string> taken;
  for (RaplZone& zone : zones) {
    const RaplZone* parent = parent_of(zone, zones);
    zone.domain = domain_of(zone.label);
    const std::string& package = parent != nullptr ? parent->label : zone.label;
    if (is_package(package)) zone.unit = package.substr(kPackage.size());
    zone.name = "rapl:";
    if (parent != nullptr) zone.name += parent->label + '/';
    zone.name += zone.label.empty() ? zone.id : zone.label;
    if (zone.control != kControl) {
      zone.name += '@' + zone.control.substr(std::min(kControl.size() + 1, zone.control.size()));
    }
    if (!taken.insert(zone.name).second) taken.insert(zone.name += '@' + zone.id);
  }
}

Joules step_of(std::optional<std::uint64_t> range) {
  if (!range) return kUsualStep;
  const Joules step(static_cast<double>(*range) * 1e-6 / kCounts);
  // A tree that another program wrote may state any range.
  return step < Joules(1e-6) || step > Joules(4.0) ? kUsualStep : step;
}

std::string sentence(const RaplZone& zone, const Host& host, Joules step) {
  std::string text;
  switch (zone.domain.value_or(Domain::package)) {
    case Domain::package:
      text = fmt::format(
          "processor package {}: cores, caches, memory controller and integrated GPU; without "
          "memory modules, discrete GPU, screen and losses of the power supply",
          zone.unit);
      break;
    case Domain::cores:
      text = host.amd
                 ? fmt::format("one core of processor package {}, not all of them", zone.unit)
                 : fmt::format("all cores of processor package {}; part of the package", zone.unit);
      break;
    case Domain::integrated_gpu:
      text = fmt::format("the GPU inside processor package {}; part of the package", zone.unit);
      break;
    case Domain::memory:
      text = fmt::format("memory modules at processor package {}; beside the package", zone.unit);
      break;
    default:
      text =
          "platform, uncalibrated: whatever the mainboard's maker wired to it, the package "
          "included; not valid if it shows less than the package";
      if (step >= Joules(0.5)) text += fmt::format("; counts in steps of {:.3g} J", step.value);
  }
  if (host.sgx) {
    text += "; SGX blurs the counter, so that windows below 100 ms are less certain";
  }
  return text;
}

}  // namespace

std::vector<RaplZone> list_rapl_zones(const SensorRoot& root) {
  std::vector<RaplZone> zones;
  for (const std::string& id : root.list(kFlat)) {
    if (is_zone(id)) add_zone(root, fmt::format("{}/{}", kFlat, id), id, zones);
  }
  if (zones.empty()) walk_tree(root, std::string(kTree), zones);
  std::stable_partition(zones.begin(), zones.end(),
                        [](const RaplZone& zone) { return zone.control == kControl; });
  name_zones(zones);
  return zones;
}

std::optional<std::uint64_t> rapl_range(const SensorRoot& root, const RaplZone& zone) {
  const FileText file = root.read(zone.folder + "/max_energy_range_uj");
  const auto range = file.text ? parse_unsigned(*file.text) : std::nullopt;
  return range && *range > 0 ? range : std::nullopt;
}

Watts rapl_most_power(const SensorRoot& root, const RaplZone& zone) {
  // A limit holds on average only and can be switched off, and short bursts go far beyond the
  // first: limits therefore widen the bound but never narrow it.
  Watts most(zone.domain == Domain::platform ? 4000.0 : 1000.0);
  for (int i = 0; i < 4; ++i) {
    const FileText file = root.read(fmt::format("{}/constraint_{}_power_limit_uw", zone.folder, i));
    const auto limit = file.text ? parse_unsigned(*file.text) : std::nullopt;
    // Firmware writes absurd values for "no limit".
    if (!limit || *limit > 10'000'000'000U) continue;
    most = std::max(most, Watts(2e-6 * static_cast<double>(*limit)));
  }
  return most;
}

SourceInfo describe_rapl_zone(const SensorRoot& root, const RaplZone& zone, const Host& host) {
  SourceInfo info;
  info.name = zone.name;
  info.kind = SourceKind::rapl;
  info.domain = zone.domain.value_or(Domain::package);
  info.unit = zone.unit;
  info.place = zone.energy_file();
  info.energy_step = step_of(rapl_range(root, zone));
  info.includes = sentence(zone, host, *info.energy_step);
  info.provenance = {Origin::measured, fmt::format("RAPL counter {} ({})", zone.id, zone.label)};
  info.update_period = Seconds(0.001);
  info.poll_period = Seconds(0.05);
  if (zone.domain == Domain::platform) info.gain_uncertainty = 0.2;
  return info;
}

}  // namespace encore::energy
