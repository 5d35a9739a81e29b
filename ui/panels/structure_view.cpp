#include "accel/inspect/node_table.h"
#include "accel/settings.h"
#include "scene/camera_motion.h"
#include "ui/panels/camera_navigation.h"
#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace encore::ui {

namespace {

constexpr std::size_t kPlace = kPaneCount;

/// How far the first camera is turned from the panes' one, and raised.
constexpr double kTurned = 35.0 * std::numbers::pi / 180.0;
constexpr double kRaised = 20.0 * std::numbers::pi / 180.0;

std::string title_of(const UiState& state) {
  const PaneSettings& pane = state.settings.panes.at(state.inspected_pane);
  return fmt::format("{} in 3D", accel::to_string(pane.structure.kind));
}

/// Of the scene. While one is loaded the nodes may still be those of the last scene.
std::optional<scene::Bounds> whole_of(const View& view, const UiState& state) {
  if (view.scene.info) return view.scene.info->bounds;
  const auto& nodes = view.panes.at(state.inspected_pane).nodes;
  if (view.scene.loading.active || !nodes || nodes->empty()) return std::nullopt;
  return nodes->bounds();
}

/// From the side and from above the panes' camera, so that the whole is seen, and that camera.
void place_camera(const Rect& room, const View& view, UiState& state) {
  const auto bounds = whole_of(view, state);
  if (!bounds || room.empty()) return;
  const scene::Camera turned =
      scene::orbit(state.camera, kTurned, kRaised, up_axis_of(state.preferences));
  state.free_camera = scene::focus(turned, *bounds, double(room.width) / double(room.height));
}

void draw_title(const Rect& line, UiState& state) {
  const char* const label = "Reset";
  const float reset = ImGui::CalcTextSize(label).x + 2.0F * ImGui::GetStyle().FramePadding.x;
  const std::string title = title_of(state);
  const float room = line.width - reset - ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetCursorScreenPos({line.x, line.y});
  ImGui::TextUnformatted(fitted(title, room).c_str());
  note_widget("structure_view.title", title);
  tooltip(title +
          ": the structure alone, with a camera of its own. A click selects the node under the "
          "mouse.");
  ImGui::SetCursorScreenPos({line.right() - reset, line.y});
  // The next frame places the camera anew.
  if (ImGui::SmallButton(label)) state.free_camera.reset();
  note_widget("structure_view.reset");
  tooltip("Shows the whole structure again, from the side and from above the panes' camera.");
}

void draw_header(const Rect& area, const View& view, UiState& state) {
  const float em = ImGui::GetFontSize();
  const float right = area.right() - em * 0.5F;
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  ImGui::SetCursorScreenPos({area.x + em * 0.5F, area.y + std::round(em * 0.2F)});
  draw_pane_switch("structure_view", state);
  ImGui::SetCursorScreenPos({right - em * 1.4F, ImGui::GetCursorScreenPos().y});
  if (ImGui::Button("×")) state.structure_view = false;
  note_widget("structure_view.close");
  tooltip("Closes this view; V opens it again.");

  const Rect line{area.x + em * 0.5F, area.y + std::round(em * 0.4F + ImGui::GetFrameHeight()),
                  area.width - em, pane_header_line()};
  draw_title(line, state);

  ImGui::SetCursorScreenPos({line.x, line.bottom()});
  const PaneView& shown = view.structure_view;
  const std::string nodes =
      fmt::format("{} nodes drawn, {} left out", count_text(shown.nodes_drawn),
                  count_text(shown.nodes_hidden_small));
  colored_text(colors.dim_text, fitted(nodes, right - ImGui::GetCursorScreenPos().x));
  note_widget("structure_view.nodes", nodes);
  tooltip(nodes +
          ". Left out are nodes that look smaller than the overlay's least size, or that are more "
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
  if (!state.free_camera) place_camera(room, view, state);
  if (!state.free_camera) return draw_reason(room, view, state);
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
