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

/// Tells of the pixel under the mouse, once a pixel, and once that it has left.
void follow_hover(const Rect& picture, const NavigationOutput& mouse, const PaneContext& context) {
  std::optional<InspectState::Pixel>& told = context.state.inspect.hovered;
  const PaneView& shown = context.shown();
  const ImVec2 at = ImGui::GetIO().MousePos;
  const auto pixel = mouse.hovered ? pixel_at(picture, shown.width, shown.height, at.x, at.y)
                                   : std::optional<std::pair<int, int>>{};
  if (!pixel) return forget_hover(context.pane, context.state, context.commands);
  const InspectState::Pixel now{context.pane, pixel->first, pixel->second};
  if (told != now) {
    if (told && told->pane != now.pane) forget_hover(told->pane, context.state, context.commands);
    told = now;
    context.commands.push_back(HoverPixel{now.pane, now.x, now.y});
  }
}

void draw_interior(const Rect& room, const PaneContext& context) {
  const PaneView& shown = context.shown();
  const Rect picture = fit_picture(room, shown.width, shown.height);
  const bool there = shown.texture != 0 && !picture.empty();
  if (there) draw_picture(picture, shown.texture);
  const NavigationInput input{.place = context.pane,
                              .room = room,
                              .picture = picture.empty() ? room : picture,
                              .scene_size = scene_size(context.view)};
  UiState& state = context.state;
  const NavigationOutput mouse =
      navigate(input, state.preferences, state.inspect.navigation, state.camera);
  note_moving(state);
  if (there) {
    note_area(context.name("picture"), picture.x, picture.y, picture.width, picture.height,
              fmt::format("{}x{}", shown.width, shown.height));
    follow_hover(picture, mouse, context);
  } else {
    forget_hover(context.pane, state, context.commands);
  }
  if (mouse.clicked && there) {
    const auto pixel =
        pixel_at(picture, shown.width, shown.height, mouse.clicked->first, mouse.clicked->second);
    if (pixel) context.commands.push_back(PickPixel{context.pane, pixel->first, pixel->second});
  }
  const bool told = state.inspect.hovered && state.inspect.hovered->pane == context.pane;
  if (told && shown.hover) draw_hover_box(room, *shown.hover);
  draw_pane_legend(room, context);
}

}  // namespace

void draw_picture(const Rect& picture, std::uint64_t texture) {
  ImGui::GetWindowDrawList()->AddImage(
      // The texture's name, as the window's back end takes it.
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), {picture.x, picture.y},
      {picture.right(), picture.bottom()});
}

UiState::Area pixels_of(const Rect& area) {
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  return {std::max(0, static_cast<int>(std::floor(area.width * scale.x))),
          std::max(0, static_cast<int>(std::floor(area.height * scale.y)))};
}

double scene_size(const View& view) {
  return view.scene.info ? view.scene.info->diagonal : 0.0;
}

void forget_hover(std::size_t pane, UiState& state, Commands& commands) {
  std::optional<InspectState::Pixel>& told = state.inspect.hovered;
  if (!told || told->pane != pane) return;
  told.reset();
  commands.push_back(HoverPixel{pane, -1, -1});
}

void note_moving(UiState& state) {
  const auto& frames = state.inspect.navigation.moved_in_frame;
  state.camera_moving = std::any_of(frames.begin(), frames.end(),
                                    [](int frame) { return frame >= ImGui::GetFrameCount() - 1; });
}

void draw_pane(std::size_t pane, const Rect& area, const View& view, UiState& state,
               Commands& commands) {
  const PaneContext context{pane, view, state, commands};
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0F, 0.0F));
  const std::string id = fmt::format("##pane {}", pane);
  const bool visible = begin_part(id.c_str(), area, ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  if (visible) {
    const float header = std::min(pane_header_height(), area.height);
    const Rect room{area.x, area.y + header, area.width, area.height - header};
    state.picture_areas.at(pane) = pixels_of(room);
    ImGui::GetWindowDrawList()->AddRectFilled(
        {room.x, room.y}, {room.right(), room.bottom()},
        ImGui::GetColorU32(theme_colors(state.preferences.theme).canvas));
    draw_pane_header({area.x, area.y, area.width, header}, context);
    if (!room.empty()) {
      draw_interior(room, context);
      draw_pane_state(room, context);
    }
  }
  ImGui::End();
}

}  // namespace encore::ui
