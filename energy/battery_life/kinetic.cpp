#include "energy/battery_life/kinetic.h"

#include "energy/battery_life/bisection.h"
#include "energy/battery_life/exponential.h"

#include <cmath>

namespace encore::energy {

KineticBattery kinetic_battery(const Battery& battery) {
  const KineticParameters& p = battery.kinetic;
  // Empty after H hours at I = C / H: c y = I H (c + (1 - c) mean_decay(k' H)).
  const double rated_s = battery.peukert.rated_hours * 3600.0;
  const double left_behind = (1.0 - p.c) / p.c * mean_decay(p.rate_per_s * rated_s);
  return {p.coulombs.value_or(battery.coulombs * (1.0 + left_behind)), p.c, p.rate_per_s};
}

KineticState kinetic_rest(const KineticBattery& battery, double soc) {
  const double charge = battery.coulombs * soc;
  return {battery.c * charge, (1.0 - battery.c) * charge};
}

KineticState kinetic_step(const KineticBattery& battery, const KineticState& state, double amperes,
                          Seconds dt) {
  // The textbook form, y1 e + (y0 k' c - I) g / k' - I c (k' dt - g) / k' with e = exp(-k' dt) and
  // g = 1 - e, put together so that nothing cancels and k' may be 0.
  const double x = battery.rate_per_s * dt.value;
  const double c = battery.c;
  const double bound_share = 1.0 - c;
  const double taken = amperes * dt.value;
  // What flows between the wells while they even out.
  const double flow = (c * state.bound - bound_share * state.available) * -std::expm1(-x);
  return {state.available + flow - taken * (c + bound_share * mean_decay(x)),
          state.bound - flow - taken * bound_share * mean_rise(x)};
}

std::optional<Seconds> kinetic_time_to_empty(const KineticBattery& battery,
                                             const KineticState& state, double amperes) {
  if (state.available <= 0.0) return Seconds(0.0);
  if (!(amperes > 0.0)) return std::nullopt;
  const double all = (state.available + state.bound) / amperes;
  if (!std::isfinite(all)) return std::nullopt;
  // One root: at a constant current the charge at hand falls all the time, or rises first and then
  // falls, as its second derivative keeps its sign.
  return Seconds(first_true(0.0, all, [&](double t) {
    return kinetic_step(battery, state, amperes, Seconds(t)).available <= 0.0;
  }));
}

}  // namespace encore::energy
