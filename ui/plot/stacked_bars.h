#pragma once

#include "ui/plot/bar_layout.h"

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace encore::ui {

/// What the user chose in a chart of stacked bars.
struct BarState {
  BarMode mode = BarMode::absolute;
  bool show_values = true;              ///< sums above the bars, where there is room
  bool show_differences = true;         ///< of a group's first two bars of one unit, in %
  float scroll = 0.0F;                  ///< pixels
  std::optional<std::size_t> selected;  ///< group
};

struct BarResult {
  bool hovered = false;
  std::optional<PlacedPart> under_mouse;  ///< as bar_at()
  bool selection_changed = false;         ///< a group was clicked, or dropped
};

/// Draws stacked bars of `size` pixels (0: what is left) at Dear ImGui's cursor. `name` is its
/// widget's name. The wheel and dragging scroll where there are more groups than room; a click
/// selects a group. `reason`: what is said where there are no groups.
BarResult stacked_bars(std::string_view name, const BarData& data, BarState& state,
                       ImVec2 size = {0.0F, 0.0F},
                       std::string_view reason = "nothing measured yet");

}  // namespace encore::ui
