#pragma once

#include <optional>
#include <span>

namespace encore::energy {

/// A straight line through a series.
struct Drift {
  double per_second = 0.0;
  double half_width = 0.0;         ///< of per_second, 95 %
  bool significant = false;        ///< 0 lies outside of per_second +- half_width
  double at_middle = 0.0;          ///< the line's value in the middle, which is the mean
  double deviation = 0.0;          ///< standard deviation about the line
  double effective_samples = 0.0;  ///< of the deviations from the line
};

/// Least squares over times (s, rising) and values. The slope's uncertainty counts effective
/// samples, since a correlated series wanders and looks like drift: n / tau, tau being the larger
/// of what estimate_mean() finds in the residuals and (1 + phi) / (1 - phi) of their first lag,
/// each raised for what the line itself took out. Nothing for fewer than 20 values, or fewer than 8
/// effective ones: too few to tell drift from wandering.
std::optional<Drift> linear_drift(std::span<const double> times, std::span<const double> values);

}  // namespace encore::energy
