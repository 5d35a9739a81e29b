#include "energy/sources/power_supply.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <utility>

namespace encore::energy {

namespace {

constexpr std::string_view kFolder = "/sys/class/power_supply";
constexpr double kSecondsPerHour = 3600.0;
/// An unknown rate of -1 mW or -1 mA as older kernels pass it on. No pack of a machine that runs
/// gives so little.
constexpr double kUnknownRate = -0.001;

std::string path_of(const std::string& name, std::string_view file) {
  return std::string(kFolder) + "/" + name + "/" + std::string(file);
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

void parse_uevent(std::string_view text, SupplySnapshot& snapshot) {
  constexpr std::string_view kPrefix = "POWER_SUPPLY_";
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t split = line.find('=');
    if (split == std::string_view::npos || !line.starts_with(kPrefix)) continue;
    snapshot.values[lower(line.substr(kPrefix.size(), split - kPrefix.size()))] =
        std::string(line.substr(split + 1));
  }
}

/// A rate as the driver says it, or nothing where its value means that it does not know.
std::optional<double> known_rate(std::optional<double> value) {
  if (!value || *value == 0.0 || *value == kUnknownRate) return std::nullopt;
  return std::abs(*value);
}

}  // namespace

std::string SupplySnapshot::text(std::string_view key) const {
  const auto found = values.find(key);
  return found == values.end() ? std::string() : found->second;
}

std::optional<double> SupplySnapshot::micro(std::string_view key) const {
  const auto number = parse_integer(text(key));
  if (!number) return std::nullopt;
  return static_cast<double>(*number) / 1e6;
}

bool SupplySnapshot::is_system_battery() const {
  return text("type") == "Battery" && text("scope") != "Device" && text("present") != "0";
}

std::optional<Watts> SupplySnapshot::rate() const {
  if (const auto power = known_rate(micro("power_now"))) return Watts(*power);
  const auto current = known_rate(micro("current_now"));
  const auto voltage = micro("voltage_now");
  if (current && voltage && *voltage > 0) return Watts(*current * *voltage);
  return std::nullopt;
}

std::optional<double> SupplySnapshot::charge_now() const {
  if (micro("energy_now")) return std::nullopt;
  const auto charge = micro("charge_now");
  if (!charge || *charge < 0) return std::nullopt;
  return *charge * kSecondsPerHour;
}

std::optional<Joules> SupplySnapshot::energy_of(std::string_view which) const {
  const auto energy = micro("energy_" + std::string(which));
  if (energy && *energy >= 0) return Joules(*energy * kSecondsPerHour);
  const auto charge = micro("charge_" + std::string(which));
  // The design voltage lies in the middle of the discharge; the present one only near its own end.
  const auto nominal = micro("voltage_min_design");
  const auto voltage = nominal && *nominal > 0 ? nominal : micro("voltage_now");
  if (!charge || *charge < 0 || !voltage) return std::nullopt;
  return Joules(*charge * *voltage * kSecondsPerHour);
}

SupplySnapshot read_supply(const SensorFiles& files, const std::string& name) {
  SupplySnapshot snapshot;
  snapshot.name = name;
  const FileText uevent = files.read(path_of(name, "uevent"));
  snapshot.error = uevent.error;
  if (uevent.text) parse_uevent(*uevent.text, snapshot);
  // Where a driver fails at one property, some kernels fail at the whole uevent; older ones leave
  // out the type. The files then say it one by one.
  constexpr std::array kNeeded = {"type", "scope", "present", "status"};
  constexpr std::array kValues = {"power_now",  "current_now",        "voltage_now",
                                  "energy_now", "energy_full",        "energy_full_design",
                                  "charge_now", "charge_full",        "charge_full_design",
                                  "capacity",   "voltage_min_design", "cycle_count"};
  const auto fetch = [&](const char* key) {
    if (snapshot.values.contains(key)) return;
    if (auto value = files.text(path_of(name, key))) snapshot.values[key] = std::move(*value);
  };
  const bool whole = uevent.text && !snapshot.values.empty();
  for (const char* key : kNeeded) fetch(key);
  if (!whole) {
    for (const char* key : kValues) fetch(key);
  }
  if (!snapshot.values.empty()) snapshot.error = 0;
  return snapshot;
}

bool is_mains(const SensorFiles& files, const std::string& name) {
  const std::string type = files.text(path_of(name, "type")).value_or("");
  const bool feeds = type == "Mains" || type.starts_with("USB") || type == "Wireless";
  return feeds && files.text(path_of(name, "scope")).value_or("") != "Device";
}

bool is_online(const SensorFiles& files, const std::string& name) {
  return files.integer(path_of(name, "online")).value_or(0) > 0;
}

std::optional<bool> read_on_mains(const SensorFiles& files) {
  bool charger = false;
  std::vector<std::string> packs;
  for (const std::string& name : files.list(kFolder)) {
    if (is_mains(files, name)) {
      if (is_online(files, name)) return true;
      charger = true;
    } else if (files.text(path_of(name, "type")) == "Battery" &&
               files.text(path_of(name, "scope")) != "Device" &&
               files.text(path_of(name, "present")) != "0") {
      packs.push_back(name);
    }
  }
  // A desktop's USB sockets are chargers that never deliver.
  if (charger) return packs.empty() ? std::nullopt : std::optional(false);
  const bool discharging = std::any_of(packs.begin(), packs.end(), [&](const std::string& name) {
    return files.text(path_of(name, "status")) == "Discharging";
  });
  return discharging ? std::optional(false) : std::nullopt;
}

Supplies read_supplies(const SensorFiles& files) {
  Supplies supplies;
  for (const std::string& name : files.list(kFolder)) {
    if (is_mains(files, name)) {
      supplies.mains.push_back(name);
      if (!supplies.plugged && is_online(files, name)) supplies.plugged = name;
      continue;
    }
    // A UPS has a type of its own; asking a device's battery more than its scope costs radio.
    if (files.text(path_of(name, "type")).value_or("") != "Battery") continue;
    if (files.text(path_of(name, "scope")).value_or("") == "Device") {
      supplies.others.push_back(name + " belongs to a device (scope Device)");
      continue;
    }
    SupplySnapshot snapshot = read_supply(files, name);
    if (snapshot.is_system_battery()) {
      supplies.packs.push_back(std::move(snapshot));
    } else {
      supplies.others.push_back(name + " is not in its place (present 0)");
    }
  }
  return supplies;
}

}  // namespace encore::energy
