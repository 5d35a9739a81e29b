#include "ui/plot/plot_input.h"

#include "ui/plot/plot_draw.h"
#include "ui/widget_map.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

constexpr double kZoomStep = 0.85;  // a notch of the wheel
constexpr float kLeastDrag = 3.0F;  // pixels: less is a click
constexpr double kPanStep = 0.1;    // of the width, a notch

double position_x(const PlotRect& area, float x) {
  return static_cast<double>(x - area.x0) / static_cast<double>(area.width());
}

double position_y(const PlotRect& area, float y) {
  return static_cast<double>(area.y1 - y) / static_cast<double>(area.height());
}

void wheel(const PlotRect& area, Axis* x, Axis* y, PlotInput& input) {
  const ImGuiIO& io = ImGui::GetIO();
  const double notches = static_cast<double>(io.MouseWheel);
  const double sideways = static_cast<double>(io.MouseWheelH) + (io.KeyShift ? notches : 0.0);
  if (sideways != 0.0 && x != nullptr) {
    pan(*x, -kPanStep * sideways);
    input.x_moved = true;
    return;
  }
  if (notches == 0.0) return;
  const double factor = std::pow(kZoomStep, notches);
  if (io.KeyCtrl && y != nullptr) {
    zoom_at(*y, position_y(area, input.mouse_y), factor);
    input.y_moved = true;
  } else if (!io.KeyCtrl && x != nullptr) {
    zoom_at(*x, position_x(area, input.mouse_x), factor);
    input.x_moved = true;
  }
}

void drag_to_pan(const PlotRect& area, Axis* x, Axis* y, PlotInput& input) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool held =
      ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle);
  if (!held) return;
  if (x != nullptr && io.MouseDelta.x != 0.0F) {
    pan(*x, -static_cast<double>(io.MouseDelta.x / area.width()));
    input.x_moved = true;
  }
  if (y != nullptr && io.MouseDelta.y != 0.0F) {
    pan(*y, static_cast<double>(io.MouseDelta.y / area.height()));
    input.y_moved = true;
  }
}

void drag_to_pick(const PlotRect& area, const Axis& x, std::optional<double>& from,
                  PlotInput& input) {
  const double here = axis_value(x, std::clamp(position_x(area, input.mouse_x), 0.0, 1.0));
  if (ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) from = here;
  if (!from) return;
  // By pixels, not by values: the strip may move on under the mouse.
  const ImVec2 moved = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F);
  const bool far = std::abs(moved.x) >= kLeastDrag;
  const AxisRange range{std::min(*from, here), std::max(*from, here)};
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (far) input.dragging = range;
    return;
  }
  const ImVec2 pressed = ImGui::GetIO().MouseClickedPos[ImGuiMouseButton_Left];
  if (std::abs(input.mouse_x - pressed.x) >= kLeastDrag && range.to > range.from) {
    input.picked = range;
  } else {
    input.clicked = true;
  }
  from.reset();
}

}  // namespace

PlotInput plot_input(std::string_view name, const PlotRect& area, Axis* x, Axis* y,
                     std::optional<double>& drag_from) {
  PlotInput input;
  if (area.width() < 1.0F || area.height() < 1.0F) return input;
  ImGui::SetCursorScreenPos({area.x0, area.y0});
  ImGui::InvisibleButton("area", {area.width(), area.height()},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  note_widget(name);
  // The wheel is the plot's: what it lies in must not scroll.
  ImGui::SetItemUsingMouseWheel();
  input.hovered = ImGui::IsItemHovered();
  input.mouse_x = ImGui::GetIO().MousePos.x;
  input.mouse_y = ImGui::GetIO().MousePos.y;
  if (input.hovered) wheel(area, x, y, input);
  if (ImGui::IsItemActive()) drag_to_pan(area, x, y, input);
  if (x != nullptr) drag_to_pick(area, *x, drag_from, input);
  input.fit = input.hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  return input;
}

}  // namespace encore::ui
