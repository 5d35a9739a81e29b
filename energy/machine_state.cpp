#include "energy/machine_state.h"

#include "energy/sources/hwmon_chips.h"
#include "energy/sources/power_supply.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace encore::energy {

namespace {

constexpr std::string_view kCpus = "/sys/devices/system/cpu";
constexpr std::string_view kHwmon = "/sys/class/hwmon";

bool starts_with_number(std::string_view text, std::string_view word) {
  return text.starts_with(word) && text.size() > word.size() &&
         text.substr(word.size()).find_first_not_of("0123456789") == std::string_view::npos;
}

/// Thousandths of a degree; a sensor that is not connected shows something absurd.
std::optional<double> degrees(const SensorFiles& files, const std::string& path) {
  const auto thousandths = files.integer(path);
  if (!thousandths || *thousandths < -60'000 || *thousandths > 150'000) return std::nullopt;
  return static_cast<double>(*thousandths) / 1e3;
}

void keep_hotter(std::optional<double>& hottest, std::optional<double> other) {
  if (other && (!hottest || *other > *hottest)) hottest = other;
}

/// The temperatures of a chip by label, or by file where there is none.
std::map<std::string, double> temperatures(const SensorFiles& files, const std::string& folder) {
  std::map<std::string, double> found;
  constexpr std::string_view kInput = "_input";
  for (const std::string& file : files.list(folder)) {
    if (!file.starts_with("temp") || !file.ends_with(kInput)) continue;
    const std::string sensor = file.substr(0, file.size() - kInput.size());
    const auto value = degrees(files, folder + "/" + file);
    if (value) found[files.text(folder + "/" + sensor + "_label").value_or(sensor)] = *value;
  }
  return found;
}

std::optional<double> chip_temperature(const SensorFiles& files, const std::string& folder) {
  const auto all = temperatures(files, folder);
  // AMD's Tctl may be the real Tdie plus an offset that only rules the fan.
  if (const auto die = all.find("Tdie"); die != all.end()) return die->second;
  std::optional<double> hottest;
  for (const auto& [label, value] : all) keep_hotter(hottest, value);
  return hottest;
}

std::optional<double> zone_temperature(const SensorFiles& files) {
  constexpr std::string_view kZones = "/sys/class/thermal";
  std::optional<double> hottest;
  for (const std::string& zone : files.list(kZones)) {
    const std::string folder = std::string(kZones) + "/" + zone;
    const std::string type = files.text(folder + "/type").value_or("");
    if (!zone.starts_with("thermal_zone")) continue;
    if (type != "x86_pkg_temp" && !type.starts_with("cpu")) continue;
    keep_hotter(hottest, degrees(files, folder + "/temp"));
  }
  return hottest;
}

std::optional<double> cpu_clock(const SensorFiles& files) {
  double sum = 0.0;
  int cores = 0;
  for (const std::string& cpu : list_cpus(files.root())) {
    const std::string path = std::string(kCpus) + "/" + cpu + "/cpufreq/scaling_cur_freq";
    const auto kilohertz = files.integer(path);
    if (!kilohertz || *kilohertz <= 0) continue;
    sum += static_cast<double>(*kilohertz) / 1e3;
    ++cores;
  }
  if (cores == 0) return std::nullopt;
  return sum / cores;
}

std::optional<std::uint64_t> throttle_events(const SensorFiles& files) {
  // Keyed by package and core; a package's own counter has no core.
  std::map<std::pair<std::string, std::string>, std::uint64_t> counts;
  for (const std::string& cpu : list_cpus(files.root())) {
    const std::string folder = std::string(kCpus) + "/" + cpu;
    const std::string topology = folder + "/topology/";
    const std::string package = files.text(topology + "physical_package_id").value_or("0");
    const std::string core = files.text(topology + "core_id").value_or(cpu);
    const auto keep = [&](const char* file, const std::string& key) {
      const auto count = files.integer(folder + "/thermal_throttle/" + file);
      if (!count || *count < 0) return;
      std::uint64_t& kept = counts[{package, key}];
      kept = std::max(kept, static_cast<std::uint64_t>(*count));
    };
    keep("core_throttle_count", core);
    keep("package_throttle_count", "package");
  }
  if (counts.empty()) return std::nullopt;
  std::uint64_t sum = 0;
  for (const auto& [key, count] : counts) sum += count;
  return sum;
}

/// Clock of a GPU whose driver has it below /sys/class/drm, in MHz.
std::optional<double> drm_clock(const SensorFiles& files, const std::string& device) {
  constexpr std::array kFiles = {"gt/gt0/rps_act_freq_mhz", "gt_act_freq_mhz",
                                 "device/tile0/gt0/freq0/act_freq"};
  constexpr std::string_view kCards = "/sys/class/drm";
  for (const std::string& card : files.list(kCards)) {
    if (!starts_with_number(card, "card")) continue;
    const std::string folder = std::string(kCards) + "/" + card;
    if (hwmon_device(files, folder) != device) continue;
    for (const char* file : kFiles) {
      const auto megahertz = files.integer(folder + "/" + file);
      if (megahertz && *megahertz > 0) return static_cast<double>(*megahertz);
    }
  }
  return std::nullopt;
}

void read_gpu(const SensorFiles& files, MachineState& state) {
  for (const std::string& entry : files.list(kHwmon)) {
    const std::string folder = std::string(kHwmon) + "/" + entry;
    const std::string name = files.text(folder + "/name").value_or("");
    if (name != "amdgpu" && name != "i915" && name != "xe" && name != "nouveau") continue;
    const std::string device = hwmon_device(files, folder);
    if (hwmon_asleep(files, folder, device)) continue;
    const auto all = temperatures(files, folder);
    // The edge is what most tools show; without it, the hottest.
    if (const auto edge = all.find("edge"); edge != all.end()) {
      state.gpu_temperature_c = edge->second;
    } else {
      for (const auto& [label, value] : all) keep_hotter(state.gpu_temperature_c, value);
    }
    const auto hertz = files.integer(folder + "/freq1_input");
    state.gpu_clock_mhz = hertz && *hertz > 0 ? std::optional(static_cast<double>(*hertz) / 1e6)
                                              : drm_clock(files, device);
    if (state.gpu_temperature_c || state.gpu_clock_mhz) return;
  }
}

}  // namespace

std::vector<std::string> list_cpus(const SensorRoot& root) {
  std::vector<std::string> cpus = root.list(kCpus);
  std::erase_if(cpus, [](const std::string& name) { return !starts_with_number(name, "cpu"); });
  return cpus;
}

std::optional<double> read_cpu_temperature(const SensorRoot& root) {
  const SensorFiles files(root);
  std::optional<double> hottest;
  for (const std::string& entry : files.list(kHwmon)) {
    const std::string folder = std::string(kHwmon) + "/" + entry;
    const std::string name = files.text(folder + "/name").value_or("");
    if (name != "coretemp" && name != "k10temp" && name != "zenpower") continue;
    keep_hotter(hottest, chip_temperature(files, folder));
  }
  return hottest ? hottest : zone_temperature(files);
}

MachineState read_machine_state(const SensorRoot& root) {
  const SensorFiles files(root);
  MachineState state;
  state.cpu_temperature_c = read_cpu_temperature(root);
  state.cpu_clock_mhz = cpu_clock(files);
  state.throttle_events = throttle_events(files);
  if (const auto mains = read_on_mains(files)) state.on_battery = !*mains;
  read_gpu(files, state);
  return state;
}

}  // namespace encore::energy
