#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// A place in a plot; `label` is written beside it and may be empty.
struct PlotPoint {
  double x = 0.0;
  double y = 0.0;
  std::string label;
};

/// Points that belong together: one colour, mark and line of the legend.
struct PlotSeries {
  std::string label;
  std::vector<PlotPoint> points;
  bool joined = true;  ///< by straight lines, in the order of the points
};

/// A plot with two axes, each with a title that names its unit.
struct LogPlot {
  std::string title;
  std::string x_title;
  std::string y_title;
  std::vector<PlotSeries> series;
  bool log_x = true;
  bool log_y = true;
  /// Larger values are drawn at this one's height, as on the edge; a title should say so.
  std::optional<double> most_y = std::nullopt;
  /// On a logarithmic axis: smaller values, 0 among them, are drawn at this one's height.
  std::optional<double> least_y = std::nullopt;
};

/// An SVG 1.1 picture, 800 px wide, dark on white, the plots below each other. Points that an axis
/// cannot hold (not finite, or not above 0 on a logarithmic one) are left out. A plot without
/// points says so. Texts may hold any characters.
std::string plots_svg(const std::vector<LogPlot>& plots);

/// Writes plots_svg() to a file. Throws scene::InputError, which names the file and the fault.
void write_plots_svg(const std::filesystem::path& file, const std::vector<LogPlot>& plots);

}  // namespace encore::app
