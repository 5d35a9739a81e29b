#include "ui/layout_drag.h"
#include "ui/panels/pane_parts.h"
#include "ui/panels/panels.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace encore::ui {

namespace {

using Drag = LayoutSettings (*)(const LayoutSettings&, const LayoutInput&, float);

struct Splitter {
  const char* id;
  Rect area;
  bool upright;  ///< a vertical bar, which is dragged to the left and right
  Drag drag;
  float LayoutSettings::*value;
};

/// One gap between parts: dragged, or by a double click put back.
void draw_splitter(const Splitter& splitter, const LayoutInput& input, UiState& state) {
  if (splitter.area.empty()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0F, 0.0F));
  if (begin_part(splitter.id, splitter.area, ImGuiWindowFlags_NoBackground)) {
    ImGui::InvisibleButton("drag", {splitter.area.width, splitter.area.height});
    note_widget(splitter.id);
    const bool active = ImGui::IsItemActive();
    if (active || ImGui::IsItemHovered()) {
      ImGui::SetMouseCursor(splitter.upright ? ImGuiMouseCursor_ResizeEW
                                             : ImGuiMouseCursor_ResizeNS);
      ImGui::GetWindowDrawList()->AddRectFilled(
          {splitter.area.x, splitter.area.y}, {splitter.area.right(), splitter.area.bottom()},
          ImGui::GetColorU32(active ? ImGuiCol_SeparatorActive : ImGuiCol_SeparatorHovered));
    }
    LayoutSettings& settings = state.preferences.layout;
    if (ImGui::IsItemActivated()) state.shell.grabbed = settings;
    if (active && state.shell.grabbed) {
      const ImVec2 moved = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F);
      settings = splitter.drag(*state.shell.grabbed, input, splitter.upright ? moved.x : moved.y);
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      settings.*splitter.value = LayoutSettings{}.*splitter.value;
      state.shell.grabbed.reset();
    }
    if (ImGui::IsItemDeactivated()) state.shell.grabbed.reset();
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void draw_splitters(const Layout& layout, const LayoutInput& input, UiState& state) {
  const Splitter splitters[]{
      {"splitter.left", layout.left_splitter, true, drag_left, &LayoutSettings::left_width},
      {"splitter.right", layout.right_splitter, true, drag_right, &LayoutSettings::right_width},
      {"splitter.plots", layout.plots_splitter, false, drag_plots, &LayoutSettings::plots_share},
      {"splitter.plot", layout.plot_splitter, true, drag_plot_split, &LayoutSettings::plot_split},
      {"splitter.pane", layout.pane_splitter, !panes_stacked(layout), drag_pane_split,
       &LayoutSettings::pane_split},
  };
  for (const Splitter& splitter : splitters) draw_splitter(splitter, input, state);
}

bool power_line_shown(const View& view, const UiState& state) {
  return view.power.origin == energy::Origin::unavailable && !view.power_opening &&
         !state.shell.power_line_dismissed;
}

std::string power_line_text(const View& view) {
  const std::string& why = view.power_problem.empty() ? view.power.detail : view.power_problem;
  if (why.empty()) return "No watts: no power source is open. Times and counts are all there.";
  return "No watts: " + why;
}

/// Why there are no watts and what can be done, below the menu.
void draw_power_line(const Rect& area, const View& view, UiState& state) {
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  const auto mixed = [](float a, float b) { return a + 0.13F * (b - a); };
  const ImVec4 ground(mixed(colors.background.x, colors.warning.x),
                      mixed(colors.background.y, colors.warning.y),
                      mixed(colors.background.z, colors.warning.z), 1.0F);
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(em * 0.6F, em * 0.2F));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ground);
  if (begin_part("##power line", area)) {
    const float buttons = em * 22.0F;
    const std::string text = power_line_text(view);
    ImGui::AlignTextToFramePadding();
    const std::string shown = fitted(text, std::max(em * 4.0F, area.width - buttons - em));
    ImGui::TextUnformatted(shown.c_str());
    note_widget("power_line.text", text);
    if (shown != text) hint(text);
    ImGui::SameLine(std::max(ImGui::GetItemRectSize().x + em, area.width - buttons));
    if (ImGui::Button("Sensor doctor")) state.doctor_open = true;
    note_widget("power_line.doctor");
    hint("Lists the sensors of this machine, what is in the way of each, and the way out.");
    ImGui::SameLine();
    if (ImGui::Button("Enter idle and busy watts…")) state.dialog = Dialog::energy;
    note_widget("power_line.watts");
    hint("With two numbers from a meter, joules are computed from times, marked as modelled.");
    ImGui::SameLine();
    if (ImGui::Button("×")) state.shell.power_line_dismissed = true;
    note_widget("power_line.dismiss");
    hint("Puts this line away; the badge above goes on saying it.");
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

int shown_panes(const UiState& state) {
  int count = state.structure_view ? 1 : 0;
  for (const PaneSettings& pane : state.settings.panes) {
    if (pane.device != PaneDevice::off) ++count;
  }
  return count;
}

/// The panes that are on, each in the next place, and after them the 3D view.
void draw_panes(const Layout& layout, const View& view, UiState& state, Commands& commands) {
  if (shown_panes(state) == 0) {
    for (std::size_t pane = 0; pane < kPaneCount; ++pane) forget_hover(pane, state, commands);
    if (!layout.panes[0].empty()) draw_no_panes(layout.panes[0], state);
    return;
  }
  std::size_t place = 0;
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
    const bool on = state.settings.panes[pane].device != PaneDevice::off;
    if (on && !layout.panes[place].empty()) {
      draw_pane(pane, layout.panes[place], view, state, commands);
    } else {
      forget_hover(pane, state, commands);
    }
    if (on) ++place;
  }
  if (state.structure_view && place < layout.panes.size() && !layout.panes[place].empty()) {
    draw_structure_view(layout.panes[place], view, state, commands);
  }
}

void draw_middle(const Layout& layout, const View& view, UiState& state, Commands& commands) {
  draw_panes(layout, view, state, commands);
  const Rect& last =
      layout.error.empty() ? layout.bars.empty() ? layout.power : layout.bars : layout.error;
  state.plots_area = {layout.power.x, layout.power.y, last.right() - layout.power.x,
                      layout.power.height};
  if (!layout.power.empty()) draw_power_plot(layout.power, view, state, commands);
  if (!layout.bars.empty()) draw_bars_plot(layout.bars, view, state, commands);
  if (!layout.error.empty()) draw_error_plot(layout.error, view, state, commands);
}

}  // namespace

void draw_window(const View& view, UiState& state, Commands& commands) {
  handle_shortcuts(view, state, commands);
  draw_menu(view, state, commands);

  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  const float menu = ImGui::GetFrameHeight();
  const bool line = power_line_shown(view, state);
  const float line_height = line ? std::round(ImGui::GetFrameHeight() + em * 0.4F) : 0.0F;
  const LayoutInput input{.width = size.x,
                          .height = size.y,
                          .em = em,
                          .menu_height = menu + line_height,
                          .status_height = std::round(ImGui::GetFrameHeight() + em * 0.2F),
                          .panes = std::max(1, shown_panes(state))};
  const Layout layout = make_layout(state.preferences.layout, input);
  ImGui::GetBackgroundDrawList()->AddRectFilled(
      {0.0F, 0.0F}, size, ImGui::GetColorU32(theme_colors(state.preferences.theme).canvas));

  if (line) draw_power_line({0.0F, menu, size.x, line_height}, view, state);
  if (!layout.left.empty()) draw_settings_column(layout.left, view, state, commands);
  if (!layout.right.empty()) draw_structure_column(layout.right, view, state, commands);
  draw_middle(layout, view, state, commands);
  draw_splitters(layout, input, state);
  if (!layout.status.empty()) draw_status(layout.status, view, state, commands);
  if (state.sessions_open) draw_sessions_window(view, state, commands);
  if (state.doctor_open) draw_doctor_window(view, state, commands);
  if (state.accuracy.open) draw_accuracy_window(view, state, commands);
  draw_dialogs(view, state, commands);
  draw_notices(layout, state);
  state.shell.history.observe(state.settings, ImGui::IsAnyItemActive());
}

}  // namespace encore::ui
