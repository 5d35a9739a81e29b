#include "ui/panels/menu_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>

namespace encore::ui {

namespace {

std::string origin_word(const View& view) {
  return view.power_opening ? "opening…" : std::string(energy::to_string(view.power.origin));
}

std::string origin_tip(const View& view) {
  std::string tip;
  switch (view.power.origin) {
    case energy::Origin::measured:
      tip = "Watts come from a sensor of this machine: ";
      break;
    case energy::Origin::modelled:
      tip = "Watts are computed from times and given constants: ";
      break;
    case energy::Origin::simulated:
      tip = "Watts come from an imitation of a sensor: ";
      break;
    case energy::Origin::unavailable:
      tip = "There are no watts, and so no joules: ";
      break;
  }
  tip += view.power.detail.empty() ? "nothing more is known" : view.power.detail;
  if (!view.power_problem.empty()) tip += "\n" + view.power_problem;
  if (view.power.origin == energy::Origin::unavailable) {
    tip +=
        "\nWay out: see what is in the way of the sensors, or enter idle and busy watts "
        "(Measure > Source of watts).";
  }
  return tip + "\nClick for the sensors.";
}

std::string frames_text(const WindowView& window) {
  return fmt::format("{:.0f} fps · {:.1f} ms", window.frames_per_s, window.frame_median_ms);
}

std::string frames_tip(const WindowView& window) {
  return fmt::format(
      "The window's own cost: {:.2f} ms a frame in the median, {:.2f} ms at the 99th percentile, "
      "{:.1f} % of one core, {:.0f} MiB of memory. Frames a second of the window, not of the "
      "tracers.\nDrawn by {}{}.",
      window.frame_median_ms, window.frame_99_ms, window.processor_share * 100.0,
      double(window.memory_bytes) / (1024.0 * 1024.0),
      window.opengl.empty() ? "OpenGL" : window.opengl,
      window.opengl_software ? " (a rasteriser in software)" : "");
}

std::string scene_tip(const SceneView& scene) {
  if (!scene.scene) return scene.problem;
  std::string tip = scene.scene->source;
  if (scene.info) tip += fmt::format("\n{} triangles", scene.info->triangles);
  return tip;
}

}  // namespace

void draw_menu_end(const MenuContext& context) {
  const View& view = context.view;
  const ThemeColors& colors = theme_colors(context.state.preferences.theme);
  const float em = ImGui::GetFontSize();
  const auto width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };

  const std::string word = origin_word(view);
  const std::string frames = frames_text(view.window);
  // Counted as if it were long, so that nothing to its left jumps about.
  const float frames_width = width("000 fps · 00.0 ms");
  const float badge_width = width(word) + em * 1.5F;
  const float right = ImGui::GetWindowWidth() - em * 0.5F;
  const float free_from = ImGui::GetCursorPosX() + em;

  // What there is no room for goes: first the scene's name, then the frames.
  const bool with_frames = right - frames_width - badge_width - em > free_from;
  const float badge_x = right - badge_width - (with_frames ? frames_width + em * 0.8F : 0.0F);
  const float name_room = badge_x - em * 0.8F - free_from;
  if (view.scene.scene && name_room > em * 4.0F) {
    const std::string name = fitted(view.scene.scene->name, name_room);
    ImGui::SetCursorPosX(badge_x - em * 0.8F - width(name));
    ImGui::TextUnformatted(name.c_str());
    note_widget("menu.scene", view.scene.scene->name);
    hint(scene_tip(view.scene));
  }
  if (badge_x > free_from - em) {
    ImGui::SetCursorPosX(badge_x);
    if (badge("##provenance", word,
              origin_color(context.state.preferences.theme, view.power.origin))) {
      context.state.doctor_open = true;
    }
    note_widget("menu.provenance", word);
    hint(origin_tip(view));
  }
  if (with_frames) {
    ImGui::SetCursorPosX(right - frames_width);
    colored_text(colors.dim_text, frames);
    note_widget("menu.frames", frames);
    hint(frames_tip(view.window));
  }
}

}  // namespace encore::ui
