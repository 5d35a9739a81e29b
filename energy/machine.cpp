#include "energy/machine.h"

#include "energy/machine_gpus.h"
#include "energy/machine_state.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace encore::energy {

namespace {

std::optional<std::string> read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::optional<std::string> read_line(const std::filesystem::path& path) {
  const auto text = read_text(path);
  if (!text) return std::nullopt;
  const std::string_view line = trimmed(std::string_view(*text).substr(0, text->find('\n')));
  if (line.empty()) return std::nullopt;
  return std::string(line);
}

/// The lines "key : value" of a file; `separator` stands between the two.
std::vector<std::pair<std::string, std::string>> read_pairs(const std::filesystem::path& path,
                                                            char separator) {
  std::vector<std::pair<std::string, std::string>> pairs;
  const auto text = read_text(path);
  if (!text) return pairs;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t split = line.find(separator);
    if (split == std::string::npos) continue;
    const std::string_view view(line);
    pairs.emplace_back(trimmed(view.substr(0, split)), trimmed(view.substr(split + 1)));
  }
  return pairs;
}

void read_cpu(const std::filesystem::path& path, Machine& machine) {
  std::uint64_t logical = 0;
  std::set<std::pair<std::string, std::string>> cores;
  std::string package;
  for (const auto& [key, value] : read_pairs(path, ':')) {
    if (key == "processor") ++logical;
    if (key == "model name" && !machine.cpu_model) machine.cpu_model = value;
    if (key == "microcode" && !machine.microcode) machine.microcode = value;
    // A core counts once, however many threads it runs; its number is unique in its package only.
    if (key == "physical id") package = value;
    if (key == "core id") cores.emplace(package, value);
    if (key == "flags" && !machine.virtual_machine) {
      machine.virtual_machine = (' ' + value + ' ').find(" hypervisor ") != std::string::npos;
    }
  }
  if (logical > 0) machine.logical_cores = logical;
  if (!cores.empty()) machine.physical_cores = cores.size();
}

std::optional<std::uint64_t> read_memory(const std::filesystem::path& path) {
  for (const auto& [key, value] : read_pairs(path, ':')) {
    std::uint64_t kibibytes = 0;
    if (key != "MemTotal") continue;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), kibibytes);
    if (error == std::errc{}) return kibibytes * 1024;
  }
  return std::nullopt;
}

std::optional<std::string> read_os(const std::filesystem::path& path) {
  for (auto [key, value] : read_pairs(path, '=')) {
    if (key != "PRETTY_NAME") continue;
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
      value = value.substr(1, value.size() - 2);
    }
    return value;
  }
  return std::nullopt;
}

void read_clock_limits(const SensorRoot& root, Machine& machine) {
  const auto megahertz = [&](const std::string& cpu, const char* file) -> std::optional<double> {
    const auto text = root.read("/sys/devices/system/cpu/" + cpu + "/cpufreq/" + file).text;
    const auto kilohertz = parse_unsigned(text.value_or(""));
    if (!kilohertz || *kilohertz == 0) return std::nullopt;
    return static_cast<double>(*kilohertz) / 1e3;
  };
  // Cores differ: some processors have slow and fast ones.
  for (const std::string& cpu : list_cpus(root)) {
    const auto low = megahertz(cpu, "cpuinfo_min_freq");
    const auto high = megahertz(cpu, "cpuinfo_max_freq");
    if (low) machine.cpu_min_mhz = std::min(*low, machine.cpu_min_mhz.value_or(*low));
    if (high) machine.cpu_max_mhz = std::max(*high, machine.cpu_max_mhz.value_or(*high));
  }
}

std::optional<bool> read_boost(const SensorRoot& root) {
  const std::string cpus = "/sys/devices/system/cpu/";
  if (const auto off = root.read(cpus + "intel_pstate/no_turbo").text) return *off == "0";
  for (const char* file : {"cpufreq/boost", "cpu0/cpufreq/boost"}) {
    if (const auto on = root.read(cpus + file).text) return *on == "1";
  }
  return std::nullopt;
}

std::optional<std::string> read_container(const SensorRoot& root) {
  // Docker and podman leave a file; others are seen in the name of the first process's group.
  const auto exists = [&](const char* path) {
    std::error_code error;
    return std::filesystem::exists(root.resolve(path), error);
  };
  if (exists("/.dockerenv")) return "docker";
  if (exists("/run/.containerenv")) return "podman";
  if (const auto manager = root.read("/run/systemd/container").text; manager && !manager->empty()) {
    return *manager;
  }
  const std::string groups = root.read("/proc/1/cgroup").text.value_or("");
  for (const char* name : {"kubepods", "docker", "containerd", "libpod", "lxc"}) {
    if (groups.find(name) != std::string::npos) return name;
  }
  return std::nullopt;
}

std::optional<std::string> build_id() {
#ifdef ENCORE_BUILD_ID
  return ENCORE_BUILD_ID;
#else
  return std::nullopt;
#endif
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "g++ " __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

Machine read_machine(const std::filesystem::path& root) {
  Machine machine;
  read_cpu(root / "proc/cpuinfo", machine);
  machine.memory_bytes = read_memory(root / "proc/meminfo");
  machine.operating_system = read_os(root / "etc/os-release");
  machine.kernel = read_line(root / "proc/sys/kernel/osrelease");
  machine.governor = read_line(root / "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  machine.compiler = compiler_name();
  machine.build_type = ENCORE_BUILD_TYPE;
  machine.build_id = build_id();
  const SensorRoot sensors(root);
  read_clock_limits(sensors, machine);
  machine.boost = read_boost(sensors);
  const MachineState state = read_machine_state(sensors);
  machine.cpu_temperature_c = state.cpu_temperature_c;
  if (state.on_battery) machine.power_supply = *state.on_battery ? "battery" : "mains";
  machine.container = read_container(sensors);
  machine.gpus = read_gpus(sensors);
  return machine;
}

std::string read_command_line(const std::filesystem::path& root) {
  const auto text = read_text(root / "proc/self/cmdline");
  if (!text) return {};
  std::string line;
  // Words end with a zero byte each.
  for (std::size_t start = 0; start < text->size();) {
    const std::size_t end = std::min(text->find('\0', start), text->size());
    const std::string word = text->substr(start, end - start);
    start = end + 1;
    if (!line.empty()) line += ' ';
    const bool plain =
        !word.empty() &&
        word.find_first_not_of(
            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%") ==
            std::string::npos;
    if (plain) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace encore::energy
