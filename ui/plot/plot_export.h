#pragma once

#include "ui/plot/bar_layout.h"
#include "ui/plot/scatter_layout.h"
#include "ui/plot/strip_chart.h"

#include <cstddef>
#include <string>

namespace encore::ui {

// What a plot shows as CSV (RFC 4180, LF, units in the columns' names), to be copied. Missing
// values are empty fields, never 0.

/// One row a drawn bucket: series, provenance, from_s, to_s, samples, changed, first_W, last_W,
/// mean_W, min_W, max_W, low_W, high_W, integral_J, covered_s. `most` as SampleHistory::between;
/// hidden series are left out.
std::string strip_csv(const StripData& data, const StripState& state, std::size_t most);
/// One row a series: the statistics of the selection; only the header without one.
std::string selection_csv(const StripData& data, StripState& state);
/// One row a part: group, bar, part, value, ci95, unit, provenance, detail.
std::string bars_csv(const BarData& data);
/// One row a point: series, elapsed_s, relative_ci95, effective_samples, provenance; those too,
/// that rest on too few samples to be drawn.
std::string errors_csv(const ErrorData& data);

}  // namespace encore::ui
