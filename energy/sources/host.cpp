#include "energy/sources/host.h"

#include <fmt/format.h>

#include <sstream>
#include <system_error>

namespace encore::energy {

namespace {

bool holds_word(const std::string& text, std::string_view word) {
  std::istringstream words(text);
  for (std::string each; words >> each;) {
    if (each == word) return true;
  }
  return false;
}

/// The value of a line "key : value" in /proc/cpuinfo; the first processor speaks for all.
std::string cpu_line(const std::string& cpuinfo, std::string_view key) {
  std::istringstream lines(cpuinfo);
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const std::size_t colon = line.find(':');
    const std::size_t blank = line.find_first_not_of(" \t", key.size());
    if (colon != std::string::npos && blank == colon) return line.substr(colon + 1);
  }
  return {};
}

bool is_container(const SensorRoot& root) {
  std::error_code ignored;
  for (const char* mark : {"/.dockerenv", "/run/.containerenv"}) {
    if (std::filesystem::exists(root.resolve(mark), ignored)) return true;
  }
  const std::string groups = root.read("/proc/1/cgroup").text.value_or("");
  for (const char* runtime : {"docker", "kubepods", "containerd", "/lxc", "libpod"}) {
    if (groups.find(runtime) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

Host read_host(const SensorRoot& root) {
  Host host;
  const std::string cpuinfo = root.read("/proc/cpuinfo").text.value_or("");
  const std::string vendor = cpu_line(cpuinfo, "vendor_id");
  host.amd = holds_word(vendor, "AuthenticAMD") || holds_word(vendor, "HygonGenuine");
  const std::string flags = cpu_line(cpuinfo, "flags");
  host.sgx = holds_word(flags, "sgx");
  if (!flags.empty()) host.virtual_machine = holds_word(flags, "hypervisor");
  host.container = is_container(root);
  return host;
}

bool is_virtual_machine(const SensorRoot& root) {
  return read_host(root).virtual_machine.value_or(false);
}

std::string why_no_counters(const Host& host) {
  if (host.virtual_machine.value_or(false)) {
    return "; this is a virtual machine, and hypervisors seldom pass energy counters on";
  }
  if (host.container) return "; this is a container, and container runtimes hide energy counters";
  return {};
}

std::string way_to_counters(const Host& host, std::string_view module) {
  if (host.virtual_machine.value_or(false)) {
    return "measure on the host itself, or share the host's counters with this machine and name "
           "their folder with --sysfs-root";
  }
  if (host.container) {
    return "measure outside the container, or start it with --security-opt "
           "systempaths=unconfined";
  }
  return fmt::format("sudo modprobe {} (Intel processors, AMD's from Zen on)", module);
}

}  // namespace encore::energy
