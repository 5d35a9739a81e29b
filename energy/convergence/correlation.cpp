#include "energy/convergence/correlation.h"

#include "energy/student_t.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace encore::energy {

namespace {

double mean_square(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

double first_lag_inflation(std::span<const double> residuals, int terms) {
  const auto n = static_cast<double>(residuals.size());
  if (residuals.size() < 8) return 1.0;
  double squares = residuals.front() * residuals.front();
  double products = 0.0;
  for (std::size_t i = 1; i < residuals.size(); ++i) {
    squares += residuals[i] * residuals[i];
    products += residuals[i] * residuals[i - 1];
  }
  if (!(squares > 0.0)) return 1.0;
  const double phi =
      std::clamp((products / squares + terms / n) / (1.0 - (terms + 2) / n), 0.0, 0.99);
  return (1.0 + phi) / (1.0 - phi);
}

double scaled_inflation(std::span<const double> residuals) {
  constexpr std::size_t kLeastMeans = 32;
  std::vector<double> means(residuals.begin(), residuals.end());
  const double variance = mean_square(means);
  if (!(variance > 0.0)) return 1.0;
  double inflation = first_lag_inflation(means, 1);
  for (double m = 2.0; means.size() / 2 >= kLeastMeans; m *= 2.0) {
    for (std::size_t i = 0; i + 1 < means.size(); i += 2) {
      means[i / 2] = 0.5 * (means[i] + means[i + 1]);
    }
    means.resize(means.size() / 2);
    const double of_means = m * mean_square(means) / variance;
    inflation = std::max(inflation, of_means * first_lag_inflation(means, 1));
  }
  return inflation;
}

Estimate cautious_mean(std::span<const double> values, std::span<const double> weights) {
  Estimate estimate = estimate_mean(values, weights);
  if (!estimate.effective_samples || !estimate.ci95_half_width) return estimate;
  std::vector<double> residuals(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    residuals[i] = (values[i] - estimate.mean) * (weights.empty() ? 1.0 : weights[i]);
  }
  const double before = *estimate.effective_samples;
  const double after =
      std::max(2.0, static_cast<double>(values.size()) / scaled_inflation(residuals));
  if (after >= before) return estimate;
  const double deviation =
      *estimate.ci95_half_width / student_t_quantile(0.975, before - 1.0) * std::sqrt(before - 1.0);
  estimate.effective_samples = after;
  estimate.ci95_half_width =
      student_t_quantile(0.975, after - 1.0) * deviation / std::sqrt(after - 1.0);
  return estimate;
}

}  // namespace encore::energy
