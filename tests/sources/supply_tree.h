#pragma once

#include "energy/sources/sensor_root.h"
#include "tests/support/files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <string>

namespace encore::energy {

/// Power supplies in a folder of the test's own, whose values change as a test goes on.
class SupplyTree {
 public:
  using Values = std::map<std::string, std::string>;

  /// Writes the supply's files, its uevent among them; values that are not named keep theirs.
  void set(const std::string& name, const Values& changes) {
    Values& values = supplies_[name];
    for (const auto& [key, value] : changes) {
      values[key] = value;
      folder_.write(path(name) / key, value + "\n");
    }
    std::string uevent = "DEVTYPE=power_supply\nPOWER_SUPPLY_NAME=" + name + "\n";
    for (const auto& [key, value] : values) {
      std::string upper = key;
      std::transform(upper.begin(), upper.end(), upper.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      uevent += "POWER_SUPPLY_" + upper + "=" + value + "\n";
    }
    folder_.write(path(name) / "uevent", uevent);
  }
  void remove(const std::string& name) {
    supplies_.erase(name);
    std::filesystem::remove_all(folder_.path() / path(name));
  }
  /// A full pack of 50 Wh that discharges with 10 W, and a charger that is not plugged in.
  void set_laptop() {
    set("BAT0", {{"type", "Battery"},
                 {"status", "Discharging"},
                 {"present", "1"},
                 {"voltage_now", "12000000"},
                 {"voltage_min_design", "11400000"},
                 {"power_now", "10000000"},
                 {"energy_now", "50000000"},
                 {"energy_full", "50000000"}});
    set("AC", {{"type", "Mains"}, {"online", "0"}});
  }
  [[nodiscard]] SensorRoot root() const { return SensorRoot(folder_.path()); }

 private:
  static std::filesystem::path path(const std::string& name) {
    return std::filesystem::path("sys/class/power_supply") / name;
  }
  test::TemporaryFolder folder_;
  std::map<std::string, Values> supplies_;
};

}  // namespace encore::energy
