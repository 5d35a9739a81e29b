#include "energy/battery_life/present.h"

#include <fmt/format.h>

#include <algorithm>

namespace encore::energy {

Battery battery_present(const BatteryState& state) {
  const auto need = [&](std::optional<double> value, const char* what) {
    if (value && *value > 0.0) return *value;
    throw BatteryError(
        fmt::format("{} does not tell its {}; describe the battery with --battery FILE.toml or "
                    "--preset NAME (docs/battery-life.md)",
                    state.name, what));
  };
  const auto plain = [](const auto& quantity) {
    return quantity ? std::optional<double>(quantity->value) : std::nullopt;
  };
  const double volts = need(state.design_voltage ? state.design_voltage : state.voltage, "voltage");
  const double joules = need(plain(state.full ? state.full : state.design), "full charge");
  if (!state.now) need(std::nullopt, "charge now");
  Battery battery = battery_from_label(state.name, volts, joules / volts);
  battery.full = Joules(joules);
  // Gauges go a little past what they call full.
  battery.soc = std::clamp(state.now->value / joules, 0.0, 1.0);
  battery.source = "present in this machine; cells assumed typical";
  return battery;
}

}  // namespace encore::energy
