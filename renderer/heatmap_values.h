#pragma once

#include "accel/counters.h"
#include "renderer/heatmap.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::renderer {

/// What a traversal step and the tests are taken to cost, in joules, or in any other measure where
/// only their proportions count. There are no defaults: whoever gives them says where they come
/// from.
struct CostWeights {
  double step = 0.0;
  double box_test = 0.0;
  double triangle_test = 0.0;
};

/// One value a pixel, with what a legend has to say. A value that is not known is NaN.
struct HeatmapValues {
  std::vector<float> values;
  std::string unit;        ///< "steps", "triangle tests", "box tests", "J"
  std::string provenance;  ///< where the values come from, as it was given
};

/// Counts of a quantity. Throws std::invalid_argument for HeatmapQuantity::energy, which needs
/// weights.
HeatmapValues count_values(std::span<const accel::TraceCounters> counters,
                           HeatmapQuantity quantity);

/// Joules a pixel by weights in joules: a model, not a measurement, which `provenance` has to say.
/// Throws std::invalid_argument for weights that are negative, not finite, or all 0.
HeatmapValues energy_values(std::span<const accel::TraceCounters> counters,
                            const CostWeights& joules, std::string provenance);

/// A frame's joules shared among its pixels in proportion to their weighted counts: the sum is
/// `frame_j` but for rounding. Nothing if no pixel cost anything, so that there is no proportion.
/// Throws as energy_values() does, and for joules that are negative or not finite.
std::optional<HeatmapValues> shared_energy_values(std::span<const accel::TraceCounters> counters,
                                                  const CostWeights& proportions, double frame_j,
                                                  std::string provenance);

/// Statistics of the values that are known (finite). Percentiles are of the nearest-rank kind, as
/// CostStatistics'.
struct ValueStatistics {
  float min = 0.0F;
  float median = 0.0F;
  float percentile_99 = 0.0F;
  float max = 0.0F;
  double mean = 0.0;
  double sum = 0.0;
  std::uint64_t count = 0;                 ///< of known values
  std::uint64_t missing = 0;               ///< of the others
  std::optional<float> smallest_positive;  ///< where a logarithmic scale can begin
};

/// Nothing if no value is known.
std::optional<ValueStatistics> value_statistics(std::span<const float> values);

}  // namespace encore::renderer
