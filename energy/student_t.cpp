#include "energy/student_t.h"

#include <cmath>
#include <limits>

namespace encore::energy {

namespace {

/// The continued fraction of the incomplete beta function (DLMF 8.17.22), evaluated from the front
/// by Lentz's method; converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  constexpr int kMaxTerms = 20000;
  const auto nonzero = [](double v) { return std::fabs(v) < kTiny ? kTiny : v; };

  double c = 1.0;
  double d = 1.0 / nonzero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m <= kMaxTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1.0 / nonzero(1.0 + even * d);
    c = nonzero(1.0 + even / c);
    fraction *= d * c;

    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1.0 / nonzero(1.0 + odd * d);
    c = nonzero(1.0 + odd / c);
    const double step = d * c;
    fraction *= step;
    if (std::fabs(step - 1.0) < 1e-16) break;
  }
  return fraction;
}

/// The regularised incomplete beta function I_x(a, b); `y` = 1 - x, given apart because the caller
/// knows it without cancellation.
double incomplete_beta(double a, double b, double x, double y) {
  if (x <= 0.0) return 0.0;
  if (y <= 0.0) return 1.0;
  const double log_x = x > 0.5 ? std::log1p(-y) : std::log(x);
  const double log_y = y > 0.5 ? std::log1p(-x) : std::log(y);
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * log_x + b * log_y);
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, y) / b;
}

}  // namespace

double student_t_tail(double t, double dof) {
  if (!(dof > 0.0) || std::isnan(t)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(t)) return t > 0 ? 0.0 : 1.0;
  if (t < 0) return 1.0 - student_t_tail(-t, dof);
  // P(T > t) = I_x(dof / 2, 1 / 2) / 2 at x = dof / (dof + t^2).
  const double sum = dof + t * t;
  return 0.5 * incomplete_beta(0.5 * dof, 0.5, dof / sum, t * t / sum);
}

double student_t_quantile(double p, double dof) {
  if (!(p >= 0.0 && p <= 1.0) || !(dof > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  if (p == 0.5) return 0.0;
  if (p < 0.5) return -student_t_quantile(1.0 - p, dof);
  if (p == 1.0) return std::numeric_limits<double>::infinity();

  // Bracket the root of the falling tail by doubling, then halve down to neighbouring doubles.
  const double wanted = 1.0 - p;
  double low = 0.0;
  double high = 1.0;
  while (student_t_tail(high, dof) > wanted) {
    low = high;
    high *= 2.0;
  }
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (student_t_tail(middle, dof) > wanted ? low : high) = middle;
  }
}

}  // namespace encore::energy
