#include "scene/camera_motion.h"
#include "ui/panels/camera_navigation.h"
#include "ui/panels/settings_column.h"
#include "ui/shortcuts.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::ui {

namespace {

using scene::ViewAxis;

/// A button that does what a key does, too.
struct ActionButton {
  const char* name;
  const char* label;
  Action action;
  const char* tip;
};

void draw_action(const ColumnContext& context, const ActionButton& button, bool beside) {
  const std::string_view keys = shortcut_text(button.action);
  const Row row{button.name, button.label,
                keys.empty() ? button.tip : fmt::format("{} ({})", button.tip, keys)};
  const bool enabled = available(button.action, context.view, context.state);
  if (beside ? text_button_beside(row, enabled) : text_button(row, enabled)) {
    perform(button.action, context.view, context.state, context.commands);
  }
}

void draw_projection(const ColumnContext& context) {
  constexpr std::array<ValueChoice<bool>, 2> kProjections{{
      {false, "perspective", "rays fan out from the eye"},
      {true, "orthographic", "rays run along the view, so that lengths can be compared"},
  }};
  scene::Camera& camera = context.state.camera;
  bool orthographic = camera.orthographic();
  if (value_choice_row({"settings.camera.projection", "Projection",
                        "How rays leave the eye; a change keeps the size of what is at the "
                        "target's depth (O)."},
                       orthographic, kProjections)) {
    camera = scene::toggle_projection(camera);
  }
  if (!camera.orthographic()) {
    number_row(NumberRow<float>{.row = {"settings.camera.fov", "Field of view",
                                        "Vertical angle between the picture's lowest and highest "
                                        "rays, in degrees; the thesis has 90."},
                                .low = 1.0F,
                                .high = 170.0F,
                                .format = "%.1f°",
                                .commit = Commit::at_once},
               camera.vertical_fov_degrees);
    return;
  }
  const float height = camera.orthographic_height;
  const bool usable = std::isfinite(height) && height > 0.0F;
  number_row(NumberRow<float>{.row = {"settings.camera.height", "Height",
                                      "World units that the picture's height spans; Enter takes "
                                      "what is typed."},
                              .low = usable ? std::min(height, 1e-6F) : 1e-6F,
                              .high = usable ? std::max(height, 1e6F) : 1e6F,
                              .format = "%.5g",
                              .typed = true},
             camera.orthographic_height);
}

void draw_up_axis(Preferences& preferences) {
  constexpr std::array<ValueChoice<int>, 3> kAxes{{{0, "x"}, {1, "y"}, {2, "z"}}};
  value_choice_row({"settings.camera.up", "Up axis",
                    "Around which the mouse turns the camera, and what is up in views along an "
                    "axis."},
                   preferences.up_axis, kAxes);
}

void draw_views(UiState& state) {
  struct View6 {
    const char* label;
    ViewAxis axis;
  };
  constexpr std::array<View6, 6> kViews{{{"+x", ViewAxis::plus_x},
                                         {"−x", ViewAxis::minus_x},
                                         {"+y", ViewAxis::plus_y},
                                         {"−y", ViewAxis::minus_y},
                                         {"+z", ViewAxis::plus_z},
                                         {"−z", ViewAxis::minus_z}}};
  constexpr std::array<const char*, 6> kNames{"plus_x",  "minus_x", "plus_y",
                                              "minus_y", "plus_z",  "minus_z"};
  hint_line("Look along");
  for (std::size_t i = 0; i < kViews.size(); ++i) {
    const Row row{fmt::format("settings.camera.{}", kNames[i]), kViews[i].label,
                  fmt::format("Looks at the same target, from the same distance, along {}.",
                              kViews[i].label)};
    if (i == 0 ? text_button(row) : text_button_beside(row)) {
      state.camera =
          scene::view_along_axis(state.camera, kViews[i].axis, up_axis_of(state.preferences));
    }
  }
}

void draw_bookmarks(const ColumnContext& context) {
  if (!context.view.scene.scene) return;
  hint_line("Stored cameras of this scene");
  const ImVec4 filled = ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive);
  for (int number = 1; number <= 9; ++number) {
    const bool stored = available(Action::recall_camera, context.view, context.state, number);
    const std::string label = fmt::format("{}", number);
    const Row row{fmt::format("settings.camera.bookmark.{}", number), label.c_str(),
                  stored
                      ? fmt::format("Recalls camera {0} ({0}). Right click or Ctrl+{0}: stores "
                                    "the present one in its place.",
                                    number)
                      : fmt::format("Empty: a click stores the present camera (Ctrl+{}).", number)};
    if (stored) ImGui::PushStyleColor(ImGuiCol_Button, filled);
    const bool pressed = number == 1 ? text_button(row) : text_button_beside(row);
    const bool again = ImGui::IsItemClicked(ImGuiMouseButton_Right);
    if (stored) ImGui::PopStyleColor();
    if (pressed || again) {
      perform(stored && !again ? Action::recall_camera : Action::store_camera, context.view,
              context.state, context.commands, number);
    }
  }
}

std::string place_text(const glm::vec3& place) {
  return fmt::format("{:.4g}, {:.4g}, {:.4g}", place.x, place.y, place.z);
}

void draw_place(const scene::Camera& camera) {
  const auto away = glm::dvec3(camera.eye) - glm::dvec3(camera.target);
  const double distance = std::sqrt(away.x * away.x + away.y * away.y + away.z * away.z);
  figure_row({"settings.camera.eye", "Eye", "Where the camera is: x, y, z in world units."},
             place_text(camera.eye));
  figure_row({"settings.camera.target", "Target",
              fmt::format("What the camera looks at, {:.5g} world units away: x, y, z.", distance)},
             place_text(camera.target));
}

}  // namespace

void draw_camera_section(const ColumnContext& context) {
  if (!section("settings.camera", "Camera", "Of both panes; the 3D view has its own.", false)) {
    return;
  }
  draw_projection(context);
  draw_up_axis(context.state.preferences);
  draw_place(context.state.camera);
  draw_action(context,
              {"settings.camera.focus", "Focus", Action::focus,
               "Brings all of the scene, or of the selected node, into the picture"},
              false);
  draw_action(context,
              {"settings.camera.reset", "Reset", Action::reset_camera, "The scene's own camera"},
              true);
  draw_action(context,
              {"settings.camera.copy", "Copy", Action::copy_camera,
               "As a line of text, which scene files and the command line take"},
              true);
  draw_action(
      context,
      {"settings.camera.paste", "Paste", Action::paste_camera, "Takes the camera from such a line"},
      true);
  draw_views(context.state);
  draw_bookmarks(context);
}

}  // namespace encore::ui
