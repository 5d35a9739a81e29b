#pragma once

#include "energy/provenance.h"
#include "ui/plot/axis.h"
#include "ui/plot/plot_colors.h"

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace encore::ui {

/// Something that has a cost and an error.
struct ScatterPoint {
  double x = 0.0;
  double y = 0.0;
  std::string label;   ///< lines for the tooltip
  bool front = false;  ///< on the Pareto front
};

/// Points of one colour and mark.
struct ScatterSeries {
  enum class Mark : std::uint8_t { disc, ring, square } mark = Mark::disc;
  std::string name;
  PlotColor color = PlotColor::cpu;
  std::vector<ScatterPoint> points;
};

struct ScatterData {
  std::vector<ScatterSeries> series;
  std::string x_unit;           ///< of the values: "s", "J"
  energy::Provenance x_origin;  ///< shown beside the front where it is no clock
  std::string y_unit = "%";
  /// Errors below are not told apart: a line across, and what is smaller is drawn on it.
  std::optional<double> floor;
  std::string floor_label;
};

/// What the user chose in a chart of error against cost.
struct ScatterState {
  Axis x;
  Axis y;
  bool fit = true;  ///< the axes follow the data until they are moved
  std::set<std::string> hidden;

  std::optional<double> drag_from;  ///< between frames only
};

struct ScatterHit {
  std::size_t series = 0;
  std::size_t point = 0;
};

/// Whether a point has a place on logarithmic axes, given that errors are raised to the floor.
bool drawable(const ScatterPoint& point, const ScatterData& data);
/// The height at which a point is drawn: its error, or the floor.
double shown_error(const ScatterPoint& point, const ScatterData& data);
/// The points of the front, of series that are shown, by rising cost.
std::vector<ScatterHit> front_of(const ScatterData& data, const ScatterState& state);

/// Draws errors against costs, both logarithmic, in `size` pixels (0: what is left) at Dear ImGui's
/// cursor, with a mark a point and the Pareto front as a line. `name` is its widget's name. A left
/// drag zooms to the range, a double click fits. Returns the point under the mouse. `reason`: what
/// is said where there are no points.
std::optional<ScatterHit> scatter_chart(std::string_view name, const ScatterData& data,
                                        ScatterState& state, ImVec2 size = {0.0F, 0.0F},
                                        std::string_view reason = "nothing is known yet");

}  // namespace encore::ui
