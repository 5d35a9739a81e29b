#include "accel/settings.h"
#include "ui/panels/camera_navigation.h"
#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

constexpr std::size_t kPlace = kPaneCount;

std::string title_of(const UiState& state) {
  const PaneSettings& pane = state.settings.panes.at(state.inspected_pane);
  return fmt::format("Structure in 3D: pane {}, {}", device_title(pane.device),
                     accel::to_string(pane.structure.kind));
}

void draw_header(const Rect& area, const View& view, UiState& state) {
  const float em = ImGui::GetFontSize();
  const float right = area.right() - em * 0.5F;
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  ImGui::SetCursorScreenPos({area.x + em * 0.5F, area.y + std::round(em * 0.2F)});
  draw_pane_switch("structure_view", state);
  ImGui::AlignTextToFramePadding();
  const std::string title = title_of(state);
  ImGui::TextUnformatted(fitted(title, right - ImGui::GetCursorScreenPos().x - em * 2.0F).c_str());
  note_widget("structure_view.title", title);
  tooltip(
      "The structure alone, with a camera of its own. A click selects the node under the "
      "mouse.");
  ImGui::SameLine();
  ImGui::SetCursorScreenPos({right - em * 1.4F, ImGui::GetCursorScreenPos().y});
  if (ImGui::Button("×")) state.structure_view = false;
  note_widget("structure_view.close");
  tooltip("Closes this view; V opens it again.");

  ImGui::SetCursorScreenPos(
      {area.x + em * 0.5F, area.y + std::round(em * 0.4F + ImGui::GetFrameHeight())});
  const PaneView& shown = view.structure_view;
  const std::string nodes =
      fmt::format("{} nodes drawn, {} left out", count_text(shown.nodes_drawn),
                  count_text(shown.nodes_hidden_small));
  colored_text(colors.dim_text, fitted(nodes, right - ImGui::GetCursorScreenPos().x));
  note_widget("structure_view.nodes", nodes);
  tooltip(
      "Left out are nodes that look smaller than the overlay's least size, or that are more "
      "than its limit; the smallest go first.");
}

void draw_reason(const Rect& room, const View& view, const UiState& state) {
  const PaneView& pane = view.panes.at(state.inspected_pane);
  std::string reason = view.structure_view.problem;
  if (reason.empty()) {
    reason = pane.stats ? "drawing" : "There is no structure yet: it shows when it is built.";
  }
  const ImVec2 size = ImGui::CalcTextSize(reason.c_str());
  ImGui::SetCursorScreenPos({room.x + std::max(0.0F, (room.width - size.x) * 0.5F),
                             room.y + (room.height - size.y) * 0.5F});
  colored_text(theme_colors(state.preferences.theme).dim_text, fitted(reason, room.width));
  note_widget("structure_view.reason", reason);
}

void draw_interior(const Rect& room, const View& view, UiState& state, Commands& commands) {
  const PaneView& shown = view.structure_view;
  const Rect picture = fit_picture(room, shown.width, shown.height);
  const bool there = shown.texture != 0 && !picture.empty();
  if (there) draw_picture(picture, shown.texture);
  if (!state.free_camera) state.free_camera = state.camera;
  const NavigationInput input{.place = kPlace,
                              .room = room,
                              .picture = picture.empty() ? room : picture,
                              .scene_size = scene_size(view)};
  const NavigationOutput mouse =
      navigate(input, state.preferences, state.inspect.navigation, *state.free_camera);
  note_moving(state);
  if (!there) return draw_reason(room, view, state);
  note_area("structure_view.picture", picture.x, picture.y, picture.width, picture.height,
            fmt::format("{}x{}", shown.width, shown.height));
  if (!mouse.clicked) return;
  const auto pixel =
      pixel_at(picture, shown.width, shown.height, mouse.clicked->first, mouse.clicked->second);
  if (pixel) commands.push_back(PickNode{pixel->first, pixel->second});
}

}  // namespace

void draw_pane_switch(const char* where, UiState& state) {
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
    const PaneDevice device = state.settings.panes.at(pane).device;
    if (device != PaneDevice::cpu && device != PaneDevice::gpu) continue;
    const bool on = state.inspected_pane == pane;
    const std::string label = fmt::format("{}##{}", device_title(device), pane);
    ImGui::PushStyleColor(ImGuiCol_Text, device_color(device));
    if (on) {
      ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    }
    if (ImGui::Button(label.c_str()) && !on) {
      state.inspected_pane = pane;
      state.selected_node.reset();
    }
    ImGui::PopStyleColor(on ? 2 : 1);
    note_widget(fmt::format("{}.pane.{}", where, pane), on ? "on" : "off");
    tooltip(pane == 0 ? "The structure of the left pane." : "The structure of the right pane.");
    ImGui::SameLine();
  }
}

void draw_structure_view(const Rect& area, const View& view, UiState& state, Commands& commands) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0F, 0.0F));
  const bool visible = begin_part("##structure view", area, ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  if (visible) {
    const float header = std::min(pane_header_height(), area.height);
    const Rect room{area.x, area.y + header, area.width, area.height - header};
    state.picture_areas.at(kPlace) = pixels_of(room);
    ImGui::GetWindowDrawList()->AddRectFilled(
        {room.x, room.y}, {room.right(), room.bottom()},
        ImGui::GetColorU32(theme_colors(state.preferences.theme).canvas));
    draw_header({area.x, area.y, area.width, header}, view, state);
    if (!room.empty()) draw_interior(room, view, state, commands);
  }
  ImGui::End();
}

}  // namespace encore::ui
