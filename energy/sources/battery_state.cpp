#include "energy/sources/battery.h"

namespace encore::energy {

namespace {

/// A sum that has no value as soon as one part has none.
template <class Unit>
void add(std::optional<Unit>& sum, const std::optional<Unit>& part, bool first) {
  if (first) {
    sum = part;
  } else if (sum && part) {
    *sum += *part;
  } else {
    sum.reset();
  }
}

std::optional<double> ratio(const std::optional<Joules>& part, const std::optional<Joules>& whole) {
  if (!part || !whole || whole->value <= 0) return std::nullopt;
  return *part / *whole;
}

}  // namespace

std::optional<double> BatteryState::charge() const {
  return ratio(now, full);
}

std::optional<double> BatteryState::health() const {
  return ratio(full, design);
}

std::optional<BatteryState> read_battery_state(const SensorFiles& files) {
  const Supplies supplies = read_supplies(files);
  if (supplies.packs.empty()) return std::nullopt;
  BatteryState state;
  bool first = true;
  bool first_discharging = true;
  for (const SupplySnapshot& pack : supplies.packs) {
    const char* joint = first ? "" : "+";
    state.name += joint + pack.name;
    state.status += joint + pack.text("status");
    add(state.now, pack.stored(), first);
    add(state.full, pack.full(), first);
    add(state.design, pack.design(), first);
    if (first) {
      state.voltage = pack.micro("voltage_now");
      state.design_voltage = pack.micro("voltage_min_design");
    }
    first = false;
    if (!pack.discharging()) continue;
    add(state.power, pack.rate(), first_discharging);
    first_discharging = false;
  }
  // A charger says so itself; without one, a pack that discharges does.
  if (!supplies.mains.empty()) {
    state.on_mains = supplies.plugged.has_value();
  } else if (!first_discharging) {
    state.on_mains = false;
  }
  return state;
}

std::optional<BatteryState> read_battery_state(const SensorRoot& root) {
  return read_battery_state(SensorFiles(root));
}

}  // namespace encore::energy
