#include "renderer/heatmap.h"

#include "renderer/heatmap_palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace encore::renderer {

namespace {

constexpr std::array<std::pair<HeatmapQuantity, std::string_view>, 3> kNames = {{
    {HeatmapQuantity::steps, "steps"},
    {HeatmapQuantity::triangle_tests, "tests"},
    {HeatmapQuantity::box_tests, "boxes"},
}};

/// The value of a rank in [0, 1) once everything is in order up to there.
std::uint32_t nearest_rank(std::vector<std::uint32_t>& values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1)) - 1;
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

std::string_view to_string(HeatmapQuantity quantity) {
  for (const auto& [value, name] : kNames) {
    if (value == quantity) return name;
  }
  return "energy";
}

std::optional<HeatmapQuantity> parse_heatmap_quantity(std::string_view name) {
  for (const auto& [value, known] : kNames) {
    if (known == name) return value;
  }
  return std::nullopt;
}

std::uint32_t cost_of(const accel::TraceCounters& counters, HeatmapQuantity quantity) {
  switch (quantity) {
    case HeatmapQuantity::steps:
      return counters.steps;
    case HeatmapQuantity::triangle_tests:
      return counters.triangle_tests;
    case HeatmapQuantity::box_tests:
      return counters.box_tests;
    case HeatmapQuantity::energy:
      break;
  }
  throw std::invalid_argument("energy is not counted; it needs what steps and tests cost");
}

CostStatistics cost_statistics(std::span<const accel::TraceCounters> counters,
                               HeatmapQuantity quantity) {
  CostStatistics statistics;
  if (counters.empty()) return statistics;
  std::vector<std::uint32_t> costs;
  costs.reserve(counters.size());
  double sum = 0.0;
  for (const accel::TraceCounters& c : counters) {
    costs.push_back(cost_of(c, quantity));
    sum += costs.back();
  }
  statistics.mean = sum / static_cast<double>(costs.size());
  const auto [min, max] = std::minmax_element(costs.begin(), costs.end());
  statistics.min = *min;
  statistics.max = *max;
  statistics.median = nearest_rank(costs, 0.5);
  statistics.percentile_99 = nearest_rank(costs, 0.99);
  return statistics;
}

glm::vec3 palette_color(double value) {
  return palette_color(Palette::helix, value);
}

CostStatistics draw_heatmap(std::span<const accel::TraceCounters> counters,
                            HeatmapQuantity quantity, Image& image) {
  if (image.pixels.size() != counters.size()) {
    throw std::invalid_argument("a heatmap needs one counter a pixel");
  }
  const CostStatistics statistics = cost_statistics(counters, quantity);
  const double scale = statistics.percentile_99 > 0 ? 1.0 / statistics.percentile_99 : 0.0;
  for (std::size_t i = 0; i < counters.size(); ++i) {
    // Above the scale means above it even where the scale is 0: 99 % of the pixels cost nothing.
    const std::uint32_t cost = cost_of(counters[i], quantity);
    const bool above = cost > statistics.percentile_99;
    image.pixels[i] = palette_color(above ? 1.0 : cost * scale);
  }
  return statistics;
}

}  // namespace encore::renderer
