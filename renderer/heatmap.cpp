#include "renderer/heatmap.h"

#include "scene/portable_math.h"

#include <glm/common.hpp>

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

std::uint32_t cost_of(const accel::TraceCounters& counters, HeatmapQuantity quantity) {
  switch (quantity) {
    case HeatmapQuantity::steps:
      return counters.steps;
    case HeatmapQuantity::triangle_tests:
      return counters.triangle_tests;
    case HeatmapQuantity::box_tests:
      return counters.box_tests;
  }
  return 0;
}

/// Linear sRGB of a colour in OKLab (Ottosson 2020).
glm::dvec3 linear_from_oklab(double lightness, double a, double b) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

constexpr std::size_t kColors = 256;

std::array<glm::vec3, kColors> make_palette() {
  // The chroma is the largest with which the whole helix stays inside what a screen can show.
  constexpr double kChroma = 0.092;
  constexpr double kDark = 0.22;
  constexpr double kLight = 0.93;
  constexpr double kViolet = 305.0;
  constexpr double kYellow = 100.0;
  std::array<glm::vec3, kColors> colors{};
  for (std::size_t i = 0; i < kColors; ++i) {
    const double t = static_cast<double>(i) / (kColors - 1);
    const double hue = kViolet + (kYellow - kViolet) * t;
    const glm::dvec3 color =
        linear_from_oklab(kDark + (kLight - kDark) * t, kChroma * scene::portable_cos_degrees(hue),
                          kChroma * scene::portable_sin_degrees(hue));
    colors[i] = glm::vec3(glm::clamp(color, 0.0, 1.0));
  }
  return colors;
}

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
  return {};
}

std::optional<HeatmapQuantity> parse_heatmap_quantity(std::string_view name) {
  for (const auto& [value, known] : kNames) {
    if (known == name) return value;
  }
  return std::nullopt;
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
  static const std::array<glm::vec3, kColors> kPalette = make_palette();
  if (!(value > 0.0)) return kPalette.front();
  const double clamped = std::min(value, 1.0);
  return kPalette[static_cast<std::size_t>(clamped * (kColors - 1) + 0.5)];
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
