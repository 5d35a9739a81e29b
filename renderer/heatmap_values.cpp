#include "renderer/heatmap_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace encore::renderer {

namespace {

void check(const CostWeights& w) {
  for (const double weight : {w.step, w.box_test, w.triangle_test}) {
    if (!(weight >= 0.0) || !std::isfinite(weight)) {
      throw std::invalid_argument("a step's and a test's costs must be finite and not negative");
    }
  }
  if (w.step == 0.0 && w.box_test == 0.0 && w.triangle_test == 0.0) {
    throw std::invalid_argument("steps and tests that all cost nothing give no energy to show");
  }
}

double cost_of(const accel::TraceCounters& c, const CostWeights& w) {
  return c.steps * w.step + c.box_tests * w.box_test + c.triangle_tests * w.triangle_test;
}

std::string_view unit_of(HeatmapQuantity quantity) {
  switch (quantity) {
    case HeatmapQuantity::steps:
      return "steps";
    case HeatmapQuantity::triangle_tests:
      return "triangle tests";
    case HeatmapQuantity::box_tests:
      return "box tests";
    case HeatmapQuantity::energy:
      return "J";
  }
  return {};
}

float nearest_rank(std::vector<float>& values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1)) - 1;
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

HeatmapValues count_values(std::span<const accel::TraceCounters> counters,
                           HeatmapQuantity quantity) {
  HeatmapValues result;
  result.unit = unit_of(quantity);
  result.provenance = "counted";
  result.values.reserve(counters.size());
  for (const accel::TraceCounters& c : counters) {
    result.values.push_back(static_cast<float>(cost_of(c, quantity)));
  }
  return result;
}

HeatmapValues energy_values(std::span<const accel::TraceCounters> counters,
                            const CostWeights& joules, std::string provenance) {
  check(joules);
  HeatmapValues result;
  result.unit = unit_of(HeatmapQuantity::energy);
  result.provenance = std::move(provenance);
  result.values.reserve(counters.size());
  for (const accel::TraceCounters& c : counters) {
    result.values.push_back(static_cast<float>(cost_of(c, joules)));
  }
  return result;
}

std::optional<HeatmapValues> shared_energy_values(std::span<const accel::TraceCounters> counters,
                                                  const CostWeights& proportions, double frame_j,
                                                  std::string provenance) {
  check(proportions);
  if (!(frame_j >= 0.0) || !std::isfinite(frame_j)) {
    throw std::invalid_argument("a frame's joules must be finite and not negative");
  }
  // By the largest, so that neither tiny nor huge weights leave the range of numbers.
  const double largest =
      std::max({proportions.step, proportions.box_test, proportions.triangle_test});
  const CostWeights relative{proportions.step / largest, proportions.box_test / largest,
                             proportions.triangle_test / largest};
  double sum = 0.0;
  for (const accel::TraceCounters& c : counters) sum += cost_of(c, relative);
  if (!(sum > 0.0)) return std::nullopt;
  HeatmapValues result;
  result.unit = unit_of(HeatmapQuantity::energy);
  result.provenance = std::move(provenance);
  result.values.reserve(counters.size());
  for (const accel::TraceCounters& c : counters) {
    result.values.push_back(static_cast<float>(cost_of(c, relative) / sum * frame_j));
  }
  return result;
}

std::optional<ValueStatistics> value_statistics(std::span<const float> values) {
  ValueStatistics statistics;
  std::vector<float> known;
  known.reserve(values.size());
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    known.push_back(value);
    statistics.sum += static_cast<double>(value);
    if (value > 0.0F && value < statistics.smallest_positive.value_or(HUGE_VALF)) {
      statistics.smallest_positive = value;
    }
  }
  statistics.count = known.size();
  statistics.missing = values.size() - known.size();
  if (known.empty()) return std::nullopt;
  statistics.mean = statistics.sum / static_cast<double>(known.size());
  const auto [min, max] = std::minmax_element(known.begin(), known.end());
  statistics.min = *min;
  statistics.max = *max;
  statistics.median = nearest_rank(known, 0.5);
  statistics.percentile_99 = nearest_rank(known, 0.99);
  return statistics;
}

}  // namespace encore::renderer
