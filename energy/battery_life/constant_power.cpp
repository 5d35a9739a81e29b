#include "energy/battery_life/constant_power.h"

#include <cmath>

namespace encore::energy {

std::optional<Seconds> constant_power_time(Joules charge, Watts load) {
  const Seconds time(charge.value / load.value);
  if (!(load.value > 0.0) || !std::isfinite(time.value)) return std::nullopt;
  return time;
}

std::optional<double> current_for_power(double emf_volts, double r0_ohms, Watts load) {
  if (load.value == 0.0) return 0.0;
  if (!(emf_volts > 0.0)) return std::nullopt;
  // The current without R0; dividing twice keeps E * E from under- and overflowing.
  const double ideal = load.value / emf_volts;
  const double loss = 4.0 * r0_ohms * (ideal / emf_volts);
  if (!(loss <= 1.0)) return std::nullopt;
  return 2.0 * ideal / (1.0 + std::sqrt(1.0 - loss));
}

}  // namespace encore::energy
