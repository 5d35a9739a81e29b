#pragma once

#include "ui/accuracy_state.h"
#include "ui/plot/scatter_chart.h"
#include "ui/view.h"

#include <cstddef>
#include <string>
#include <vector>

namespace encore::ui {

// What the window of accuracy is made of; internal to it.

/// Columns of its table.
enum class AccuracyColumn {
  device,
  structure,
  mode,
  samples,
  rmse,
  missed,
  invented,
  wrong,
  largest_t,
  time,
  energy,
  pareto,
};

/// The places of the results in the order of a column; what is not known comes last either way.
std::vector<std::size_t> sorted_results(const std::vector<AccuracyResult>& results,
                                        AccuracyColumn column, bool descending);

/// "bvh-median, cpu, watertight, 4 samples".
std::string result_name(const AccuracyResult& result);

/// Whether any result has joules.
bool knows_joules(const AccuracyView& view);
/// Errors (% of white) over seconds or joules a frame: a series each device and mode.
ScatterData accuracy_scatter(const AccuracyView& view, bool by_joules);

void draw_accuracy_table(const AccuracyView& view, float height);

}  // namespace encore::ui
