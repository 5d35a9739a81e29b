#include "energy/battery_life/runtime.h"

#include "energy/battery_life/constant_power.h"
#include "energy/battery_life/kinetic.h"
#include "energy/battery_life/peukert.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace encore::energy {

namespace {

struct End {
  EndReason reason = EndReason::never;
  std::optional<Seconds> time;
};

End empty_after(std::optional<Seconds> time) {
  return {time ? EndReason::empty : EndReason::never, time};
}

/// The current that the models without a voltage reckon with.
double nominal_amperes(const Battery& battery, Watts load) {
  return load.value / battery.nominal_volts;
}

End constant_end(const Battery& battery, Watts load) {
  if (battery.soc <= 0.0 && load.value > 0.0) return {EndReason::empty, Seconds(0.0)};
  const double r0 = battery.cell.r0_ohms * battery.series / battery.parallel;
  if (!current_for_power(battery.nominal_volts, r0, load)) {
    return {EndReason::brown_out, Seconds(0.0)};
  }
  return empty_after(constant_power_time(battery.full * battery.soc, load));
}

End peukert_end(const Battery& battery, Watts load) {
  auto time = peukert_time(battery.coulombs, battery.peukert, nominal_amperes(battery, load));
  if (time) *time = *time * battery.soc;
  return empty_after(time);
}

End kinetic_end(const Battery& battery, Watts load) {
  const KineticBattery wells = kinetic_battery(battery);
  const double amperes = nominal_amperes(battery, load);
  if (!(amperes > 0.0)) return {};
  return empty_after(kinetic_time_to_empty(wells, kinetic_rest(wells, battery.soc), amperes));
}

End thevenin_end(const Battery& battery, Watts load) {
  const PackCircuit circuit = pack_circuit(battery);
  const DischargeEnd end =
      discharge_constant_power(circuit, thevenin_rest(circuit, battery.soc), load, StepLimits{});
  if (end.reason == EndReason::never || !std::isfinite(end.time.value)) return {};
  return {end.reason, end.time};
}

End end_of(const Battery& battery, Watts load, BatteryModel model) {
  switch (model) {
    case BatteryModel::constant:
      return constant_end(battery, load);
    case BatteryModel::peukert:
      return peukert_end(battery, load);
    case BatteryModel::kinetic:
      return kinetic_end(battery, load);
    case BatteryModel::thevenin:
      break;
  }
  return thevenin_end(battery, load);
}

std::string note_on(const Battery& battery, Watts load, const End& end, BatteryModel model) {
  const bool has_rate = model == BatteryModel::peukert || model == BatteryModel::kinetic;
  if (has_rate && end.time && load * *end.time > battery.full * battery.soc) {
    const double rated = battery.coulombs / (battery.peukert.rated_hours * 3600.0);
    const double amperes = nominal_amperes(battery, load);
    if (amperes < rated) {
      return fmt::format("more than the label promises, as {:.3g} A is below the rated {:.3g} A",
                         amperes, rated);
    }
  }
  if (end.reason == EndReason::brown_out && end.time->value == 0.0) {
    return "the battery cannot give this power at all";
  }
  if (end.reason == EndReason::cut_off && end.time->value == 0.0) {
    return "the voltage is at the cut-off as soon as this load is on";
  }
  return {};
}

}  // namespace

std::string_view to_string(BatteryModel model) {
  switch (model) {
    case BatteryModel::constant:
      return "constant";
    case BatteryModel::peukert:
      return "peukert";
    case BatteryModel::kinetic:
      return "kinetic";
    case BatteryModel::thevenin:
      break;
  }
  return "thevenin";
}

std::optional<BatteryModel> parse_battery_model(std::string_view word) {
  for (const BatteryModel model : kBatteryModels) {
    if (to_string(model) == word) return model;
  }
  return std::nullopt;
}

BatteryForecast forecast(const Battery& battery, const BatteryLoad& load, BatteryModel model) {
  const auto usable = [](Watts w) { return std::isfinite(w.value) && w.value >= 0.0; };
  if (!usable(load.watts) || (load.half_width && !usable(*load.half_width))) {
    throw std::invalid_argument("a load is 0 W or more and finite");
  }
  if (const std::string fault = battery_fault(battery); !fault.empty()) {
    throw std::invalid_argument("battery: " + fault);
  }
  const End end = end_of(battery, load.watts, model);
  BatteryForecast forecast;
  forecast.model = model;
  forecast.reason = end.reason;
  forecast.time = end.time;
  if (end.time) forecast.delivered = load.watts * *end.time;
  forecast.note = note_on(battery, load.watts, end, model);
  if (load.half_width) {
    forecast.earliest = end_of(battery, load.watts + *load.half_width, model).time;
    const Watts light = load.watts - *load.half_width;
    if (light.value > 0.0) forecast.latest = end_of(battery, light, model).time;
  }
  return forecast;
}

std::optional<Remaining> frames_left(const BatteryForecast& forecast, const BatteryLoad& load,
                                     Joules each) {
  if (!forecast.time || !(each.value > 0.0)) return std::nullopt;
  const double a_second = load.watts.value / each.value;
  Remaining remaining;
  remaining.value = forecast.time->value * a_second;
  if (forecast.earliest) remaining.low = forecast.earliest->value * a_second;
  if (forecast.latest) remaining.high = forecast.latest->value * a_second;
  return remaining;
}

}  // namespace encore::energy
