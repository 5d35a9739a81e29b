#include "energy/convergence/allan.h"

#include <algorithm>
#include <cmath>

namespace encore::energy {

namespace {

constexpr std::size_t kLeastPairs = 4;

}  // namespace

double AllanPoint::relative_error() const {
  // Neighbouring differences share a mean: their squares are worth 2/3 of independent ones.
  return std::sqrt(0.75 / static_cast<double>(std::max<std::size_t>(pairs, 1)));
}

std::vector<AllanPoint> allan_deviation(std::span<const double> values) {
  std::vector<AllanPoint> points;
  std::vector<double> means(values.begin(), values.end());
  for (std::size_t m = 1; means.size() >= 2; m *= 2) {
    double squares = 0.0;
    for (std::size_t i = 1; i < means.size(); ++i) {
      const double step = means[i] - means[i - 1];
      squares += step * step;
    }
    const std::size_t pairs = means.size() - 1;
    points.push_back({m, std::sqrt(squares / (2.0 * static_cast<double>(pairs))), pairs});
    for (std::size_t i = 0; i + 1 < means.size(); i += 2) {
      means[i / 2] = 0.5 * means[i] + 0.5 * means[i + 1];
    }
    means.resize(means.size() / 2);
  }
  return points;
}

std::optional<double> allan_slope(std::span<const AllanPoint> points, std::size_t first) {
  double weights = 0.0;
  double x_sum = 0.0;
  double y_sum = 0.0;
  std::size_t used = 0;
  const auto usable = [](const AllanPoint& p) { return p.pairs >= kLeastPairs && p.deviation > 0; };
  for (std::size_t i = first; i < points.size(); ++i) {
    if (!usable(points[i])) continue;
    const auto w = static_cast<double>(points[i].pairs);
    weights += w;
    x_sum += w * std::log(static_cast<double>(points[i].m));
    y_sum += w * std::log(points[i].deviation);
    ++used;
  }
  if (used < 2) return std::nullopt;
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = first; i < points.size(); ++i) {
    if (!usable(points[i])) continue;
    const auto w = static_cast<double>(points[i].pairs);
    const double x = std::log(static_cast<double>(points[i].m)) - x_sum / weights;
    xx += w * x * x;
    xy += w * x * (std::log(points[i].deviation) - y_sum / weights);
  }
  return xy / xx;
}

std::optional<AllanPoint> allan_minimum(std::span<const AllanPoint> points) {
  while (!points.empty() && points.back().pairs < kLeastPairs) {
    points = points.first(points.size() - 1);
  }
  if (points.empty()) return std::nullopt;
  const auto lower = [](const AllanPoint& a, const AllanPoint& b) {
    return a.deviation < b.deviation;
  };
  const auto least = std::min_element(points.begin(), points.end(), lower);
  const AllanPoint& last = points.back();
  // A correlated series rises first and falls later on: only a rise that lasts is a drift.
  if (last.deviation < 0.9 * std::max_element(least, points.end(), lower)->deviation) {
    return std::nullopt;
  }
  const double error = std::hypot(last.relative_error(), least->relative_error());
  if (last.deviation > least->deviation * std::exp(3.0 * error)) return *least;
  return std::nullopt;
}

}  // namespace encore::energy
