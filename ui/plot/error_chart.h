#pragma once

#include "ui/plot/scatter_layout.h"

#include <imgui.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace encore::ui {

/// What the user chose in a chart of error against run time.
struct ErrorState {
  Axis x = elapsed_axis();
  Axis y = error_axis();
  bool fit = true;             ///< the axes follow the data until they are moved
  bool show_reference = true;  ///< the slope of 1/sqrt(t)
  std::set<std::string> hidden;

  std::optional<double> drag_from;  ///< between frames only
};

struct ErrorResult {
  bool hovered = false;
  std::optional<ErrorHit> under_mouse;
};

/// Draws the relative half-width of the 95 % interval against run time, both logarithmic, in `size`
/// pixels (0: what is left) at Dear ImGui's cursor. `name` is its widget's name. A left drag zooms
/// to the range, a double click fits. `reason`: what is said where no series has points.
ErrorResult error_chart(std::string_view name, const ErrorData& data, ErrorState& state,
                        ImVec2 size = {0.0F, 0.0F},
                        std::string_view reason = "no interval is known yet");

}  // namespace encore::ui
