#include "energy/sources/rapl.h"

#include "energy/sources/energy_counter.h"
#include "energy/sources/rapl_zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>

namespace encore::energy {

namespace {

using Values = std::vector<std::optional<std::uint64_t>>;

/// The rule lasts beyond the next boot, which a plain chmod does not.
constexpr std::string_view kPermissionFix =
    "sudo groupadd -f energy && sudo usermod -aG energy \"$USER\" && echo "
    "'SUBSYSTEM==\"powercap\", "
    "KERNEL==\"intel-rapl*\", RUN+=\"/usr/bin/chgrp energy /sys/%p/energy_uj\", "
    "RUN+=\"/usr/bin/chmod g+r /sys/%p/energy_uj\"' | sudo tee /etc/udev/rules.d/70-energy.rules "
    "&& "
    "sudo udevadm control --reload && sudo udevadm trigger --subsystem-match=powercap; then log in "
    "again";

class RaplSource final : public PowerSource {
 public:
  RaplSource(SourceInfo info, const SensorRoot& root, const RaplZone& zone)
      : info_(std::move(info)),
        path_(root.resolve(zone.energy_file())),
        counter_({Joules(1e-6), rapl_range(root, zone), rapl_most_power(root, zone),
                  info_.update_period, info_.place}) {}

  [[nodiscard]] const SourceInfo& info() const override { return info_; }

  ReadResult read(Seconds now) override {
    const FileText file = read_small_file(path_);
    if (!file.text) {
      const bool gone = file.error == ENOENT || file.error == ENODEV;
      std::string reason = describe_error(path_, file.error);
      if (file.error == EACCES) reason += "; encore doctor prints the fix";
      if (gone) reason += "; the zone was there before: has its kernel module been unloaded?";
      return counter_.fail(gone ? ReadState::lost : ReadState::failed, reason);
    }
    const auto value = parse_unsigned(*file.text);
    if (!value) {
      return counter_.fail(ReadState::failed, fmt::format("'{}' is no number", *file.text));
    }
    return counter_.update(now, *value);
  }

 private:
  SourceInfo info_;
  std::filesystem::path path_;
  EnergyCounter counter_;
};

std::optional<Obstacle> obstacle_of(const SensorRoot& root, const RaplZone& zone) {
  if (!zone.domain) {
    const std::string name = zone.folder + "/name";
    const FileText label = root.read(name);
    if (!label.text) {
      return Obstacle{name + ": " + describe_error(root.resolve(name), label.error), {}};
    }
    return Obstacle{fmt::format("{}: zone '{}' is of no known kind", name, zone.label), {}};
  }
  const std::filesystem::path path = root.resolve(zone.energy_file());
  const FileText energy = read_small_file(path);
  if (!energy.text) {
    const bool denied = energy.error == EACCES || energy.error == EPERM;
    return Obstacle{zone.energy_file() + ": " + describe_error(path, energy.error),
                    denied ? std::string(kPermissionFix) : std::string()};
  }
  if (!parse_unsigned(*energy.text)) {
    return Obstacle{fmt::format("{}: '{}' is no number", zone.energy_file(), *energy.text), {}};
  }
  return std::nullopt;
}

/// Values of the usable packages; nothing for all others.
Values package_values(const SensorRoot& root, const std::vector<RaplZone>& zones,
                      const std::vector<Finding>& findings) {
  Values values(zones.size());
  for (std::size_t i = 0; i < zones.size(); ++i) {
    const bool counts = zones[i].domain == Domain::package && !findings[i].obstacle &&
                        findings[i].set_aside.empty();
    const FileText file = counts ? root.read(zones[i].energy_file()) : FileText{};
    if (file.text) values[i] = parse_unsigned(*file.text);
  }
  return values;
}

bool nearly_equal(std::optional<std::uint64_t> a, std::optional<std::uint64_t> b) {
  constexpr std::uint64_t kOneJoule = 1'000'000;
  if (!a || !b || *a == 0 || *b == 0) return false;
  return std::max(*a, *b) - std::min(*a, *b) < kOneJoule;
}

/// Some processors show one counter of the socket at each of its dies: adding them would count it
/// twice. Two counters of their own do not agree to the microjoule, and surely not again later.
void set_mirrors_aside(const SensorRoot& root, const std::vector<RaplZone>& zones,
                       std::vector<Finding>& findings, const std::function<void()>& pause) {
  constexpr int kLaterReadings = 3;
  std::vector<Values> readings{package_values(root, zones, findings)};
  const auto suspicious = [&](std::size_t i, std::size_t j) {
    return nearly_equal(readings.front()[i], readings.front()[j]);
  };
  // An update between the reads of two zones makes true mirrors differ in one of several readings.
  const auto mirrored = [&](std::size_t i, std::size_t j) {
    const auto equal = std::count_if(readings.begin(), readings.end(), [&](const Values& values) {
      return values[i] && values[i] == values[j];
    });
    return suspicious(i, j) && equal >= 2;
  };
  for (std::size_t j = 1; j < zones.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (!suspicious(i, j)) continue;
      while (readings.size() <= kLaterReadings) {
        pause();
        readings.push_back(package_values(root, zones, findings));
      }
      if (!findings[i].set_aside.empty() || !mirrored(i, j)) continue;
      findings[j].set_aside =
          fmt::format("mirrors {}: the same value in reading after reading", zones[i].name);
      break;
    }
  }
}

/// One counter can be reached on several ways; the first that works is kept.
void set_repeats_aside(const std::vector<RaplZone>& zones, std::vector<Finding>& findings) {
  for (std::size_t j = 0; j < zones.size(); ++j) {
    for (std::size_t i = 0; i < j && findings[j].set_aside.empty(); ++i) {
      const bool same = zones[i].domain == zones[j].domain && zones[i].unit == zones[j].unit;
      if (findings[i].obstacle || findings[j].obstacle || !same) continue;
      findings[j].set_aside = fmt::format("repeats {} ({})", zones[i].name, zones[i].id);
    }
  }
}

void set_parts_aside(const std::vector<RaplZone>& zones, std::vector<Finding>& findings,
                     const Host& host) {
  for (std::size_t j = 0; j < zones.size(); ++j) {
    if (findings[j].obstacle || !findings[j].set_aside.empty()) continue;
    if (host.amd && zones[j].domain == Domain::cores) {
      findings[j].set_aside =
          "counts one core only: this processor has no counter of all its cores";
      continue;
    }
    for (std::size_t i = 0; i < zones.size(); ++i) {
      const bool usable = !findings[i].obstacle && zones[i].domain == Domain::package;
      if (!usable || zones[i].unit != zones[j].unit ||
          !holds(Domain::package, findings[j].info.domain)) {
        continue;
      }
      findings[j].set_aside = "part of " + zones[i].name;
      break;
    }
  }
}

Finding nothing_found(const SensorRoot& root, const Host& host) {
  Finding finding;
  finding.info.name = "rapl";
  finding.info.kind = SourceKind::rapl;
  finding.info.domain = Domain::package;
  finding.info.place = "/sys/class/powercap";
  std::error_code ignored;
  const bool there = std::filesystem::exists(root.resolve(finding.info.place), ignored);
  std::string reason = fmt::format("no powercap zones: {} {}", finding.info.place,
                                   there ? "holds no RAPL zone" : "is not there");
  reason += why_no_counters(host);
  finding.info.provenance = {Origin::unavailable, reason};
  finding.obstacle = Obstacle{reason, way_to_counters(host, "intel_rapl_msr")};
  return finding;
}

}  // namespace

std::vector<Finding> find_rapl(const SensorRoot& root, const std::function<void()>& pause) {
  const Host host = read_host(root);
  const std::vector<RaplZone> zones = list_rapl_zones(root);
  if (zones.empty()) return {nothing_found(root, host)};
  std::vector<Finding> findings;
  for (const RaplZone& zone : zones) {
    Finding finding;
    finding.info = describe_rapl_zone(root, zone, host);
    finding.obstacle = obstacle_of(root, zone);
    if (finding.obstacle) {
      finding.info.provenance = {Origin::unavailable, finding.obstacle->reason};
    } else {
      finding.open = [info = finding.info, root, zone]() -> std::unique_ptr<PowerSource> {
        if (const auto obstacle = obstacle_of(root, zone)) {
          throw SensorError(obstacle->reason + "; run encore doctor for the way out");
        }
        return std::make_unique<RaplSource>(info, root, zone);
      };
    }
    findings.push_back(std::move(finding));
  }
  set_repeats_aside(zones, findings);
  set_mirrors_aside(root, zones, findings, pause);
  set_parts_aside(zones, findings, host);
  return findings;
}

std::vector<Finding> find_rapl(const SensorRoot& root) {
  // Longer than a counter's update period.
  return find_rapl(root, [] { std::this_thread::sleep_for(std::chrono::milliseconds(3)); });
}

}  // namespace encore::energy
