#pragma once

#include <cmath>

namespace encore::energy {

/// (1 - e^-x) / x for x >= 0, 1 at x = 0: the mean of e^-s over s in [0, x]. Exact to a few ulp for
/// every x, the infinite one included.
inline double mean_decay(double x) {
  return x > 0.0 ? -std::expm1(-x) / x : 1.0;
}

/// 1 - mean_decay(x), without the cancellation near x = 0.
inline double mean_rise(double x) {
  if (x >= 1.0) return 1.0 + std::expm1(-x) / x;
  // x/2! - x^2/3! + x^3/4! - ...; the terms fall by more than x/3 each.
  double term = x / 2.0;
  double sum = 0.0;
  for (int n = 3; n < 25; ++n) {
    sum += term;
    term *= -x / n;
  }
  return sum;
}

/// 1 - e^(-dt / tau): how much of the way to its end an exponential goes. tau = 0 arrives at once.
inline double approach(double dt, double tau) {
  if (!(dt > 0.0)) return 0.0;
  return tau > 0.0 ? -std::expm1(-dt / tau) : 1.0;
}

}  // namespace encore::energy
