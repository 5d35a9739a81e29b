#pragma once

#include "ui/plot/axis.h"
#include "ui/plot/bar_layout.h"

#include <optional>
#include <string_view>

namespace encore::ui {

/// A stretch of an axis that was picked with the mouse.
struct AxisRange {
  double from = 0.0;
  double to = 0.0;

  friend bool operator==(const AxisRange&, const AxisRange&) = default;
};

/// What the mouse did to a plot's area in this frame.
struct PlotInput {
  bool hovered = false;
  float mouse_x = 0.0F;
  float mouse_y = 0.0F;
  bool x_moved = false;  ///< the axis was zoomed or panned
  bool y_moved = false;
  bool fit = false;                   ///< a double click
  bool clicked = false;               ///< pressed and let go with hardly a move
  std::optional<AxisRange> dragging;  ///< the range while it is being picked
  std::optional<AxisRange> picked;    ///< the range when the button was let go
};

/// Makes the area a widget called `name` and lets the mouse move the axes: the wheel zooms x at the
/// cursor (with Ctrl: y; with Shift: pans), dragging with the right or middle button pans, a left
/// drag picks a range of x, a double click asks to fit. `drag_from` is the caller's: where a pick
/// began. Axes that are null stay.
PlotInput plot_input(std::string_view name, const PlotRect& area, Axis* x, Axis* y,
                     std::optional<double>& drag_from);

/// What a plot that follows its data does about the input: moving an axis or picking a range ends
/// the following (`state.fit`), a double click begins it again. `state.x` is the axis of ranges.
template <class State>
void follow_input(const PlotInput& input, State& state) {
  if (input.x_moved || input.y_moved) state.fit = false;
  if (input.picked) {
    set_range(state.x, input.picked->from, input.picked->to);
    state.fit = false;
  }
  if (input.fit) state.fit = true;
}

}  // namespace encore::ui
