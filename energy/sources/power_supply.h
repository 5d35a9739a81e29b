#pragma once

#include "energy/sources/sensor_files.h"
#include "energy/units.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::energy {

/// What /sys/class/power_supply/NAME said at one moment: its `uevent`, which the kernel fills in
/// one go, so that its values belong together. Keys are those of the files: "power_now".
struct SupplySnapshot {
  std::string name;
  std::map<std::string, std::string, std::less<>> values;
  int error = 0;  ///< errno if nothing could be read

  [[nodiscard]] std::string text(std::string_view key) const;
  /// A whole number of micro-units as a plain number of units; nothing if it is not there.
  [[nodiscard]] std::optional<double> micro(std::string_view key) const;
  /// Whether the supply feeds this machine and is a pack that is in its place. A mouse's battery
  /// (scope Device) is not; neither is an uninterruptible power supply.
  [[nodiscard]] bool is_system_battery() const;
  [[nodiscard]] bool discharging() const { return text("status") == "Discharging"; }

  /// The size of the current times the voltage, or of power_now, since drivers disagree about the
  /// sign. Nothing where the driver does not know: 0 while discharging, -1000 (an unknown -1 in
  /// milliwatts or milliamperes), no such key.
  [[nodiscard]] std::optional<Watts> rate() const;
  /// What is left, as the gauge counts it: energy (Wh to J), else charge at the nominal voltage.
  [[nodiscard]] std::optional<Joules> stored() const { return energy_of("now"); }
  [[nodiscard]] std::optional<Joules> full() const { return energy_of("full"); }
  [[nodiscard]] std::optional<Joules> design() const { return energy_of("full_design"); }
  /// Ampere-seconds left; only for packs that count charge instead of energy.
  [[nodiscard]] std::optional<double> charge_now() const;

 private:
  [[nodiscard]] std::optional<Joules> energy_of(std::string_view which) const;
};

/// Reads the uevent; where that fails or leaves values out, the files of their names.
SupplySnapshot read_supply(const SensorFiles& files, const std::string& name);

/// The supplies of a machine.
struct Supplies {
  std::vector<SupplySnapshot> packs;   ///< system batteries
  std::vector<std::string> others;     ///< batteries that do not feed the machine, and why not
  std::vector<std::string> mains;      ///< names of chargers and sockets
  std::optional<std::string> plugged;  ///< the first of them that is online
};
Supplies read_supplies(const SensorFiles& files);

/// Whether a charger or socket is delivering; false on battery; nothing where nothing tells (most
/// desktops). Asks the chargers first and a pack only where there is no charger, since asking a
/// pack makes it work.
std::optional<bool> read_on_mains(const SensorFiles& files);

/// Whether supply `name` is a charger or socket that is delivering. Reads two small files.
bool is_mains(const SensorFiles& files, const std::string& name);
bool is_online(const SensorFiles& files, const std::string& name);

}  // namespace encore::energy
