#include "scene/camera_motion.h"
#include "ui/panels/menu_parts.h"
#include "ui/style.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace encore::ui {

namespace {

scene::Axis up_axis(const Preferences& preferences) {
  constexpr std::array<scene::Axis, 3> kAxes{scene::Axis::x, scene::Axis::y, scene::Axis::z};
  return kAxes[static_cast<std::size_t>(std::clamp(preferences.up_axis, 0, 2))];
}

void draw_themes(const MenuContext& context) {
  Theme& theme = context.state.preferences.theme;
  if (menu_entry({.name = "menu.view.theme.dark",
                  .label = "Dark",
                  .tip = "Light letters on dark ground.",
                  .selected = theme == Theme::dark})) {
    theme = Theme::dark;
  }
  if (menu_entry({.name = "menu.view.theme.light",
                  .label = "Light",
                  .tip = "Dark letters on light ground, for bright rooms and for print.",
                  .selected = theme == Theme::light})) {
    theme = Theme::light;
  }
}

void draw_scales(const MenuContext& context) {
  float& scale = context.state.preferences.ui_scale;
  const float monitor = ui_scale(Preferences{}, context.view.window.monitor_scale);
  if (menu_entry({.name = "menu.view.scale.monitor",
                  .label = fmt::format("As the monitor says ({:.0f} %)", monitor * 100.0F),
                  .tip = "The scale that the desktop tells for this monitor.",
                  .selected = scale == 0.0F,
                  .keys = shortcut_text(Action::scale_reset)})) {
    scale = 0.0F;
  }
  for (const float choice : {0.75F, 1.0F, 1.25F, 1.5F, 1.75F, 2.0F, 2.5F, 3.0F}) {
    if (menu_entry({.name = fmt::format("menu.view.scale.{:.0f}", choice * 100.0F),
                    .label = fmt::format("{:.0f} %", choice * 100.0F),
                    .tip = "The size of letters and controls.",
                    .selected = scale == choice})) {
      scale = choice;
    }
  }
  ImGui::Separator();
  action_entry(context, Action::scale_up,
               {.name = "menu.view.scale.up", .label = "Larger", .tip = "One quarter more."});
  action_entry(context, Action::scale_down,
               {.name = "menu.view.scale.down", .label = "Smaller", .tip = "One quarter less."});
}

void draw_directions(const MenuContext& context) {
  struct Direction {
    const char* name;
    const char* label;
    scene::ViewAxis axis;
  };
  constexpr std::array<Direction, 6> kDirections{{{"minus_z", "−Z", scene::ViewAxis::minus_z},
                                                  {"plus_z", "+Z", scene::ViewAxis::plus_z},
                                                  {"minus_x", "−X", scene::ViewAxis::minus_x},
                                                  {"plus_x", "+X", scene::ViewAxis::plus_x},
                                                  {"minus_y", "−Y", scene::ViewAxis::minus_y},
                                                  {"plus_y", "+Y", scene::ViewAxis::plus_y}}};
  UiState& state = context.state;
  for (const Direction& direction : kDirections) {
    if (menu_entry({.name = std::string("menu.view.along.") + direction.name,
                    .label = direction.label,
                    .tip = "Looks along this axis, from the same distance."})) {
      state.camera =
          scene::view_along_axis(state.camera, direction.axis, up_axis(state.preferences));
    }
  }
}

void draw_up_axes(const MenuContext& context) {
  UiState& state = context.state;
  constexpr std::array<const char*, 3> kLabels{"X", "Y", "Z"};
  for (int axis = 0; axis < 3; ++axis) {
    const char* label = kLabels[static_cast<std::size_t>(axis)];
    if (menu_entry({.name = fmt::format("menu.view.up.{}", label),
                    .label = label,
                    .tip = "Which way is up when the camera is turned.",
                    .selected = state.preferences.up_axis == axis})) {
      state.preferences.up_axis = axis;
      state.camera = scene::with_up_axis(state.camera, up_axis(state.preferences));
    }
  }
}

void draw_bookmarks(const MenuContext& context) {
  for (int n = 1; n <= 9; ++n) {
    action_entry(context, Action::recall_camera,
                 {.name = fmt::format("menu.view.recall.{}", n),
                  .label = fmt::format("Camera {}", n),
                  .tip = "Goes back to the camera that was stored here."},
                 n);
  }
  ImGui::Separator();
  for (int n = 1; n <= 9; ++n) {
    action_entry(context, Action::store_camera,
                 {.name = fmt::format("menu.view.store.{}", n),
                  .label = fmt::format("Store as {}", n),
                  .tip = "Keeps the camera for this scene."},
                 n);
  }
}

void draw_camera_entries(const MenuContext& context) {
  action_entry(context, Action::focus,
               {.name = "menu.view.focus",
                .label = "Focus",
                .tip = "Shows the whole scene, or the selected node."});
  action_entry(context, Action::reset_camera,
               {.name = "menu.view.reset_camera",
                .label = "Scene's camera",
                .tip = "Goes back to the camera that the scene names."});
  action_entry(context, Action::orthographic,
               {.name = "menu.view.orthographic",
                .label = "Orthographic",
                .tip = "All rays run along the view, so that sizes do not shrink with distance.",
                .selected = context.state.camera.orthographic()});
  if (begin_menu("Look along", "menu.view.along")) {
    draw_directions(context);
    ImGui::EndMenu();
  }
  if (begin_menu("Up", "menu.view.up")) {
    draw_up_axes(context);
    ImGui::EndMenu();
  }
  if (begin_menu("Stored cameras", "menu.view.bookmarks", context.view.scene.scene != nullptr)) {
    draw_bookmarks(context);
    ImGui::EndMenu();
  }
}

}  // namespace

void draw_view_menu(const MenuContext& context) {
  LayoutSettings& layout = context.state.preferences.layout;
  toggle_entry({.name = "menu.view.left", .label = "Settings", .tip = "The left column."},
               layout.left);
  toggle_entry({.name = "menu.view.right", .label = "Structure", .tip = "The right column."},
               layout.right);
  toggle_entry({.name = "menu.view.plots",
                .label = "Plots",
                .tip = "Power, energy and time a phase, and error, below the panes."},
               layout.plots);
  action_entry(context, Action::structure_view,
               {.name = "menu.view.structure_view",
                .label = "3D view",
                .tip = "The inspected structure alone, with a camera of its own.",
                .selected = context.state.structure_view});
  action_entry(context, Action::full_screen,
               {.name = "menu.view.full_screen",
                .label = "Full screen",
                .tip = "Without the desktop's frame, and back."});
  ImGui::Separator();
  draw_camera_entries(context);
  ImGui::Separator();
  if (begin_menu("Theme", "menu.view.theme")) {
    draw_themes(context);
    ImGui::EndMenu();
  }
  if (begin_menu("Size of text", "menu.view.scale")) {
    draw_scales(context);
    ImGui::EndMenu();
  }
  if (menu_entry({.name = "menu.view.reset_layout",
                  .label = "Usual layout",
                  .tip = "All parts shown, at their usual sizes."})) {
    layout = LayoutSettings{};
  }
}

}  // namespace encore::ui
