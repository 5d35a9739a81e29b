#pragma once

#include "renderer/heatmap_palette.h"
#include "renderer/heatmap_values.h"
#include "renderer/image.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace encore::renderer {

enum class HeatmapScale { linear, logarithmic };

/// The values between which a palette runs.
struct HeatmapRange {
  double low = 0.0;
  double high = 1.0;  ///< not below `low`
  HeatmapScale scale = HeatmapScale::linear;
};

/// Where a value lies in a range: 0 at its low end, 1 at its high one, outside beyond them. NaN
/// stays NaN. On a logarithmic scale values up to 0 are at minus infinity. Where the ends are the
/// same, what equals them is at 0, all else at an infinity. Throws std::invalid_argument for ends
/// that are not finite or the wrong way round, or a logarithmic scale that begins at 0 or below.
double heatmap_place(const HeatmapRange& range, double value);

/// The range that draw_heatmap() has: from 0 (logarithmic: the smallest positive value; linear with
/// negative values: the smallest) to the 99th percentile. A logarithmic one needs a positive value;
/// without any it is linear.
HeatmapRange default_range(const ValueStatistics& statistics,
                           HeatmapScale scale = HeatmapScale::linear);

/// How values are drawn.
struct HeatmapStyle {
  Palette palette = Palette::helix;
  HeatmapRange range;
  std::optional<glm::vec3> below;  ///< linear colour of values below the range; none: its first
  std::optional<glm::vec3> above;  ///< likewise above; none: its last
  glm::vec3 missing{0.0F, 0.0F, 0.0F};  ///< of values that are NaN
};

/// Draws values, row by row, into `image`, whose size is theirs. Throws std::invalid_argument if
/// the sizes differ, and as heatmap_place().
void draw_heatmap(std::span<const float> values, const HeatmapStyle& style, Image& image);
/// The same as four bytes a pixel (sRGB codes as write_png()'s, opaque), for textures;
/// rgba.size() == 4 * values.size().
void draw_heatmap(std::span<const float> values, const HeatmapStyle& style,
                  std::span<std::uint8_t> rgba);

/// How many values lie in each of some equal parts of a range (equal ratios, where the scale is
/// logarithmic). The last part holds the range's high end.
struct HeatmapHistogram {
  std::vector<std::uint64_t> bins;
  double low = 0.0;
  double high = 0.0;
  HeatmapScale scale = HeatmapScale::linear;
  std::uint64_t below = 0;
  std::uint64_t above = 0;
  std::uint64_t missing = 0;  ///< NaN
};

/// Throws std::invalid_argument for no bins, and as heatmap_place().
HeatmapHistogram heatmap_histogram(std::span<const float> values, const HeatmapRange& range,
                                   std::size_t bins);

}  // namespace encore::renderer
