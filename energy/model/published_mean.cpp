#include "energy/model/published_mean.h"

#include "energy/student_t.h"

#include <cmath>

namespace encore::energy {

PublishedMean published_mean(std::span<const double> figures) {
  PublishedMean result;
  result.count = figures.size();
  if (figures.empty()) return result;
  const auto n = static_cast<double>(figures.size());
  for (const double figure : figures) result.mean += figure / n;
  if (figures.size() < 2) return result;

  double squares = 0.0;
  for (const double figure : figures) {
    squares += (figure - result.mean) * (figure - result.mean);
  }
  const double deviation = std::sqrt(squares / (n - 1.0));
  result.standard_deviation = deviation;
  result.normal_half_width = normal_half_width(deviation, figures.size());
  result.student_half_width = student_t_quantile(0.975, n - 1.0) * deviation / std::sqrt(n);
  return result;
}

double normal_half_width(double standard_deviation, std::size_t count) {
  return kNormal95 * standard_deviation / std::sqrt(static_cast<double>(count));
}

}  // namespace encore::energy
