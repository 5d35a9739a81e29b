#include "energy/statistics.h"

#include "energy/student_t.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace encore::energy {

namespace {

constexpr std::size_t kLeastForCorrelation = 20;
constexpr std::size_t kBatches = 20;

/// Mean of the squares of a series whose own mean is 0.
double variance_about_zero(std::span<const double> series) {
  double sum = 0.0;
  for (const double v : series) sum += v * v;
  return sum / static_cast<double>(series.size());
}

/// Sokal's estimate of the integrated autocorrelation time (1 for independent samples).
double autocorrelation_time(std::span<const double> series, double variance) {
  const std::size_t n = series.size();
  double tau = 1.0;
  std::size_t lag = 1;
  for (; lag < n / 2; ++lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < n; ++i) sum += series[i] * series[i + lag];
    tau += 2.0 * sum / (static_cast<double>(n) * variance);
    if (static_cast<double>(lag) >= 5.0 * tau) break;
  }
  // Correlations about the sample's own mean come out too low; Wolff (2004) gives by how much.
  return tau * (1.0 + static_cast<double>(2 * lag + 1) / static_cast<double>(n));
}

/// How much larger the variance of batch means is than independent samples would make it.
double batch_inflation(std::span<const double> series, double variance) {
  const std::size_t length = series.size() / kBatches;
  if (length < 2) return 1.0;
  std::vector<double> means(kBatches, 0.0);
  double mean = 0.0;
  for (std::size_t batch = 0; batch < kBatches; ++batch) {
    for (std::size_t i = 0; i < length; ++i) means[batch] += series[batch * length + i];
    means[batch] /= static_cast<double>(length);
    mean += means[batch] / kBatches;
  }
  double squares = 0.0;
  for (const double m : means) squares += (m - mean) * (m - mean);
  return static_cast<double>(length) * squares / (kBatches - 1) / variance;
}

}  // namespace

Estimate estimate_mean(std::span<const double> values, std::span<const double> weights) {
  Estimate estimate;
  estimate.samples = values.size();
  const std::size_t n = values.size();
  if (n == 0) return estimate;
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };

  double weight_sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) weight_sum += weight(i);
  // A running mean does not overflow, and is exact for equal values.
  double weight_so_far = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    weight_so_far += weight(i);
    if (weight_so_far > 0.0) {
      estimate.mean += (values[i] - estimate.mean) * (weight(i) / weight_so_far);
    }
  }
  if (n < 2 || !(weight_sum > 0.0)) return estimate;

  // The residuals of the (ratio) mean: each sample's pull on it, in units of the mean.
  const double mean_weight = weight_sum / static_cast<double>(n);
  std::vector<double> residuals(n);
  double squares = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double off = values[i] - estimate.mean;
    residuals[i] = off * (weight(i) / mean_weight);
    squares += off * off * (weight(i) / mean_weight);
  }
  estimate.standard_deviation = std::sqrt(squares / static_cast<double>(n - 1));

  // How many independent samples are these worth?
  const double variance = variance_about_zero(residuals);
  double inflation = 1.0;
  if (n >= kLeastForCorrelation && variance > 0.0) {
    inflation = std::max(
        {1.0, autocorrelation_time(residuals, variance), batch_inflation(residuals, variance)});
  }
  const double effective = std::max(2.0, static_cast<double>(n) / inflation);
  estimate.effective_samples = effective;
  // variance * n_eff / (n_eff - 1) is the unbiased variance; divided by n_eff, that of the mean.
  estimate.ci95_half_width =
      student_t_quantile(0.975, effective - 1.0) * std::sqrt(variance / (effective - 1.0));
  return estimate;
}

std::optional<double> percentile(std::span<const double> values, double q) {
  if (values.empty()) return std::nullopt;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double place = std::clamp(q, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (sorted[above] - sorted[below]) * (place - static_cast<double>(below));
}

}  // namespace encore::energy
