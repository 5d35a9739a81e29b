#pragma once

#include "accel/counters.h"
#include "renderer/image.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace encore::renderer {

/// Which of a ray's costs a heatmap shows.
enum class HeatmapQuantity {
  steps,
  triangle_tests,
  box_tests,
  energy,  ///< modelled from the counts: see heatmap_values.h
};

/// "steps", "tests" (triangle tests) and "boxes" (box tests), as the command line names them;
/// "energy".
std::string_view to_string(HeatmapQuantity quantity);
/// Of those that are counted; energy is none of them, as it needs weights besides a name.
std::optional<HeatmapQuantity> parse_heatmap_quantity(std::string_view name);

/// A ray's count of a quantity. Throws std::invalid_argument for energy, which is not counted.
std::uint32_t cost_of(const accel::TraceCounters& counters, HeatmapQuantity quantity);

/// Costs a pixel: counts of the chosen quantity. Percentiles are of the nearest-rank kind: the
/// smallest value that at least so many per cent of the pixels do not exceed.
struct CostStatistics {
  std::uint32_t min = 0;
  std::uint32_t median = 0;
  std::uint32_t percentile_99 = 0;
  std::uint32_t max = 0;
  double mean = 0.0;
};

/// All zero for no pixels. Throws as cost_of() does.
CostStatistics cost_statistics(std::span<const accel::TraceCounters> counters,
                               HeatmapQuantity quantity);

/// The default palette's (Palette::helix) colour (linear RGB) for a value in [0, 1], from dark
/// violet over green to light yellow; values outside are clamped, NaN counts as 0. A helix of
/// constant chroma in OKLab (Ottosson 2020): equal steps of the value look equally large, lightness
/// alone tells the order, so it survives grey printing and colour blindness.
glm::vec3 palette_color(double value);

/// Draws counters (row by row, width x height = image's size) into `image`. The palette runs from
/// 0 to the 99th percentile, so that a few very costly pixels do not push all others into the dark;
/// what lies above has the last colour. No legend: the statistics returned hold the scale.
/// Throws std::invalid_argument if the image and the counters differ in size, or for energy.
CostStatistics draw_heatmap(std::span<const accel::TraceCounters> counters,
                            HeatmapQuantity quantity, Image& image);

}  // namespace encore::renderer
