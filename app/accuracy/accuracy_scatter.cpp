#include "app/accuracy/accuracy_scatter.h"

#include "app/log_plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace encore::app {

namespace {

using Cost = std::optional<double> AccuracyRow::*;

/// One colour a device and mode; the structures and samples of the front are written beside it.
LogPlot scatter(const std::vector<AccuracyRow>& rows, Cost cost, bool AccuracyRow::*best) {
  LogPlot plot;
  PlotSeries front;
  front.label = "Pareto front";
  for (const AccuracyRow& row : rows) {
    if (!(row.*cost)) continue;
    const std::string name = fmt::format("{}, {}", to_string(row.spec.device),
                                         accel::to_string(row.spec.structure.intersection));
    auto series = std::find_if(plot.series.begin(), plot.series.end(),
                               [&](const PlotSeries& one) { return one.label == name; });
    if (series == plot.series.end()) {
      plot.series.push_back({name, {}, false});
      series = plot.series.end() - 1;
    }
    series->points.push_back({*(row.*cost), row.errors.rmse, ""});
    if (!(row.*best)) continue;
    front.points.push_back(
        {*(row.*cost), row.errors.rmse,
         fmt::format("{} ×{}", accel::to_string(row.spec.structure.kind), row.spec.rays.samples)});
  }
  std::sort(front.points.begin(), front.points.end(),
            [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  plot.series.push_back(std::move(front));
  plot.y_title = "RMSE against the reference (linear RGB)";
  return plot;
}

}  // namespace

void write_accuracy_scatter(const std::filesystem::path& folder,
                            const std::vector<AccuracyRow>& rows,
                            const std::optional<double>& own_error) {
  if (rows.empty()) return;
  const WorkloadSpec& spec = rows.front().spec;
  const std::string of =
      fmt::format("{}, {}x{}", spec.scene->name, spec.size.width, spec.size.height);
  LogPlot time = scatter(rows, &AccuracyRow::ms, &AccuracyRow::best_by_time);
  time.title = "Error against time: " + of;
  time.x_title = "time a frame, ms";
  if (own_error && *own_error > 0.0) time.least_y = own_error;
  write_plots_svg(folder / "accuracy-time.svg", {time});
  if (std::none_of(rows.begin(), rows.end(), [](const AccuracyRow& r) { return r.joules; })) return;
  LogPlot energy = scatter(rows, &AccuracyRow::joules, &AccuracyRow::best_by_energy);
  const auto known = std::find_if(rows.begin(), rows.end(),
                                  [](const AccuracyRow& r) { return r.joules.has_value(); });
  energy.title = fmt::format("Error against energy ({}): {}", energy::to_string(known->origin), of);
  energy.x_title = "energy a frame, J";
  energy.least_y = time.least_y;
  write_plots_svg(folder / "accuracy-energy.svg", {energy});
}

}  // namespace encore::app
