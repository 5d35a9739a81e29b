#include "energy/sources/perf_pmu.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <utility>

namespace encore::energy {

namespace {

struct KnownEvent {
  std::string_view event;
  std::string_view label;  ///< as powercap calls the zone
  Domain domain;
  std::string_view includes;  ///< {} is the package
};
constexpr std::array<KnownEvent, 5> kEvents{{
    {"energy-pkg", "package", Domain::package,
     "processor package {}: cores, caches, memory controller and integrated GPU; without memory "
     "modules, discrete GPU, screen and losses of the power supply"},
    {"energy-cores", "core", Domain::cores,
     "all cores of processor package {}; part of the package"},
    {"energy-gpu", "uncore", Domain::integrated_gpu,
     "the GPU inside processor package {}; part of the package"},
    {"energy-ram", "dram", Domain::memory,
     "memory modules at processor package {}; beside the package"},
    {"energy-psys", "psys", Domain::platform,
     "platform, uncalibrated: whatever the mainboard's maker wired to it, the package included; "
     "not valid if it shows less than the package"},
}};

const KnownEvent& known(const PerfEvent& event) {
  return *std::find_if(kEvents.begin(), kEvents.end(),
                       [&](const KnownEvent& each) { return each.event == event.event; });
}

/// "event=0x02" → 2. Other terms would have to be placed by the PMU's format files.
std::optional<std::uint64_t> parse_config(std::string_view text) {
  constexpr std::string_view kTerm = "event=0x";
  if (text.compare(0, kTerm.size(), kTerm) != 0) return std::nullopt;
  std::uint64_t config = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data() + kTerm.size(), end, config, 16);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return config;
}

std::optional<double> parse_scale(std::string_view text) {
  double scale = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, scale);
  // A count of a joule is coarse already; most are billionths.
  if (error != std::errc() || stopped != end || !(scale > 0) || scale > 10) return std::nullopt;
  return scale;
}

/// The package of each processor of the mask as powercap names it.
std::map<int, std::string> units_of(const SensorRoot& root, const std::vector<int>& cpus) {
  const auto topology = [&](int cpu, std::string_view file) {
    return root.read(fmt::format("/sys/devices/system/cpu/cpu{}/topology/{}", cpu, file)).text;
  };
  std::map<std::string, int> dies;
  std::map<int, std::string> units;
  for (const int cpu : cpus) {
    // Without topology, one processor stands for one package all the same.
    units[cpu] = topology(cpu, "physical_package_id")
                     .value_or(cpus.size() == 1 ? "0" : fmt::format("cpu{}", cpu));
    ++dies[units[cpu]];
  }
  for (auto& [cpu, unit] : units) {
    if (dies[unit] < 2) continue;
    unit += "-die-" + topology(cpu, "die_id").value_or(fmt::format("cpu{}", cpu));
  }
  return units;
}

/// The event without a processor.
PerfEvent read_event(const SensorRoot& root, const KnownEvent& wanted) {
  PerfEvent event;
  event.event = wanted.event;
  event.domain = wanted.domain;
  event.place = fmt::format("{}/events/{}", kPowerPmu, wanted.event);
  const auto need = [&](const std::string& file, const auto& parse) {
    const FileText content = root.read(file);
    auto value = parse(content.text.value_or(""));
    if (!value && event.problem.empty()) {
      event.problem = content.text ? fmt::format("{}: '{}' is not understood", file, *content.text)
                                   : fmt::format("{}: {}", file,
                                                 describe_error(root.resolve(file), content.error));
    }
    return value;
  };
  event.config = need(event.place, parse_config).value_or(0);
  event.scale = need(event.place + ".scale", parse_scale).value_or(0);
  need(event.place + ".unit", [](const std::string& unit) -> std::optional<bool> {
    if (unit != "Joules") return std::nullopt;
    return true;
  });
  const auto type = need(fmt::format("{}/type", kPowerPmu), parse_unsigned);
  event.type = static_cast<std::uint32_t>(type.value_or(0));
  return event;
}

}  // namespace

std::optional<std::vector<int>> parse_cpu_list(std::string_view text) {
  constexpr std::uint64_t kMost = 65536;
  std::vector<int> cpus;
  while (true) {
    const std::size_t comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    const std::size_t dash = item.find('-');
    const auto first = parse_unsigned(item.substr(0, dash));
    const auto last =
        dash == std::string_view::npos ? first : parse_unsigned(item.substr(dash + 1));
    if (!first || !last || *last < *first || *last >= kMost) return std::nullopt;
    if (cpus.size() + (*last - *first) >= kMost) return std::nullopt;
    for (std::uint64_t cpu = *first; cpu <= *last; ++cpu) cpus.push_back(static_cast<int>(cpu));
    if (comma == std::string_view::npos) return cpus;
    text.remove_prefix(comma + 1);
  }
}

std::vector<PerfEvent> list_perf_events(const SensorRoot& root) {
  std::vector<PerfEvent> events;
  const std::vector<std::string> files = root.list(fmt::format("{}/events", kPowerPmu));
  const std::string mask_file = fmt::format("{}/cpumask", kPowerPmu);
  const FileText mask = root.read(mask_file);
  const auto cpus = parse_cpu_list(mask.text.value_or(""));
  const std::vector<int> readers = cpus.value_or(std::vector<int>{0});
  const std::map<int, std::string> units = units_of(root, readers);
  for (const KnownEvent& wanted : kEvents) {
    if (std::find(files.begin(), files.end(), wanted.event) == files.end()) continue;
    PerfEvent event = read_event(root, wanted);
    if (!cpus && event.problem.empty()) {
      event.problem = mask.text
                          ? fmt::format("{}: '{}' is no list of processors", mask_file, *mask.text)
                          : fmt::format("{}: {}", mask_file,
                                        describe_error(root.resolve(mask_file), mask.error));
    }
    for (const int cpu : readers) {
      event.cpu = cpu;
      event.unit = wanted.domain == Domain::platform ? "" : units.at(cpu);
      events.push_back(event);
      // The platform is one, whichever package is asked.
      if (wanted.domain == Domain::platform) break;
    }
  }
  return events;
}

SourceInfo describe_perf_event(const PerfEvent& event) {
  const KnownEvent& is = known(event);
  SourceInfo info;
  info.name = "perf:";
  if (event.domain == Domain::package) {
    info.name += "package-" + event.unit;
  } else {
    if (!event.unit.empty()) info.name += "package-" + event.unit + '/';
    info.name += is.label;
  }
  info.kind = SourceKind::perf_energy;
  info.domain = event.domain;
  info.unit = event.unit;
  info.includes = fmt::format(fmt::runtime(is.includes), event.unit);
  info.place = fmt::format("{} on processor {}", event.place, event.cpu);
  info.provenance = {Origin::measured,
                     fmt::format("RAPL counter through perf event power/{}/", event.event)};
  info.update_period = Seconds(0.001);
  info.poll_period = Seconds(0.05);
  // perf counts in finer steps than the hardware, which most often has 2^-14 J.
  info.energy_step = Joules(std::max(event.scale, 1.0 / 16384.0));
  if (event.domain == Domain::platform) info.gain_uncertainty = 0.2;
  return info;
}

}  // namespace encore::energy
