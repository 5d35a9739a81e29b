#include "energy/convergence/drift.h"

#include "energy/convergence/correlation.h"
#include "energy/statistics.h"
#include "energy/student_t.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace encore::energy {

namespace {

/// How many residuals of a line are worth one independent one: the larger of two estimates, since
/// the line takes slow wandering out of them, and with it correlation.
double inflation_of(std::span<const double> residuals) {
  const auto n = static_cast<double>(residuals.size());
  // Any kind of correlation, if the series is long; the correction was chosen by simulation: about
  // twice what a mean takes out, over the some 10 tau lags of the estimate (tests/convergence).
  const double tau = n / *estimate_mean(residuals).effective_samples;
  return std::max(tau * (1.0 + 10.0 * (tau - 1.0) / n), first_lag_inflation(residuals, 2));
}

}  // namespace

std::optional<Drift> linear_drift(std::span<const double> times, std::span<const double> values) {
  constexpr std::size_t kLeast = 20;
  constexpr double kLeastEffective = 8.0;
  const std::size_t n = values.size();
  if (n < kLeast || times.size() != n) return std::nullopt;
  const auto count = static_cast<double>(n);
  double time_mean = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    time_mean += (times[i] - time_mean) / static_cast<double>(i + 1);
    mean += (values[i] - mean) / static_cast<double>(i + 1);
  }
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    xx += (times[i] - time_mean) * (times[i] - time_mean);
    xy += (times[i] - time_mean) * (values[i] - mean);
  }
  if (!(xx > 0.0)) return std::nullopt;

  Drift drift;
  drift.per_second = xy / xx;
  drift.at_middle = mean;
  std::vector<double> residuals(n);
  double squares = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    residuals[i] = values[i] - mean - drift.per_second * (times[i] - time_mean);
    squares += residuals[i] * residuals[i];
  }
  // What is left of an exact line is rounding, which is correlated, too.
  const bool exact = squares <= 1e-20 * drift.per_second * xy;
  const double inflation = exact ? 1.0 : inflation_of(residuals);
  drift.effective_samples = count / inflation;
  if (drift.effective_samples < kLeastEffective) return std::nullopt;
  const double freedom = drift.effective_samples - 2.0;
  const double variance = squares / count * drift.effective_samples / freedom;
  drift.deviation = std::sqrt(variance);
  drift.half_width = student_t_quantile(0.975, freedom) * std::sqrt(variance * inflation / xx);
  drift.significant = std::fabs(drift.per_second) > drift.half_width;
  return drift;
}

}  // namespace encore::energy
