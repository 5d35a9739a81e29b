#include "energy/sampling/low_pass.h"

#include "energy/battery_life/exponential.h"

#include <algorithm>

namespace encore::energy {

double low_pass_step(double shown, double input, double dt, double tau) {
  const double next = shown + (input - shown) * approach(dt, tau);
  return std::clamp(next, std::min(shown, input), std::max(shown, input));
}

double low_pass_ramp(double shown, double from, double to, double dt, double tau) {
  if (!(dt > 0.0)) return shown;
  const double late = tau > 0.0 ? mean_rise(dt / tau) : 1.0;
  const double next = shown + (from - shown) * approach(dt, tau) + (to - from) * late;
  const auto [low, high] = std::minmax({shown, from, to});
  return std::clamp(next, low, high);
}

}  // namespace encore::energy
