#include "ui/shortcuts.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <vector>

namespace encore::ui {

namespace {

Shortcut plain(Action action, int key, std::string_view text, std::string_view meaning,
               std::string_view group) {
  return {action, key, 0, false, false, text, meaning, group, 0};
}

Shortcut control(Action action, int key, std::string_view text, std::string_view meaning,
                 std::string_view group) {
  return {action, key, 0, true, false, text, meaning, group, 0};
}

constexpr std::array<std::string_view, 9> kDigits{"1", "2", "3", "4", "5", "6", "7", "8", "9"};
constexpr std::array<std::string_view, 9> kControlDigits{
    "Ctrl+1", "Ctrl+2", "Ctrl+3", "Ctrl+4", "Ctrl+5", "Ctrl+6", "Ctrl+7", "Ctrl+8", "Ctrl+9"};

void add_cameras(std::vector<Shortcut>& all) {
  constexpr std::string_view kGroup = "Camera";
  all.push_back(
      plain(Action::focus, GLFW_KEY_F, "F", "focus the scene, or the selected node", kGroup));
  all.push_back(plain(Action::reset_camera, GLFW_KEY_R, "R", "the scene's own camera", kGroup));
  all.push_back(
      plain(Action::orthographic, GLFW_KEY_O, "O", "orthographic or perspective", kGroup));
  for (int n = 1; n <= 9; ++n) {
    const auto i = static_cast<std::size_t>(n - 1);
    all.push_back({Action::recall_camera, GLFW_KEY_0 + n, 0, false, false, kDigits[i],
                   n == 1 ? "recall a stored camera (1 to 9)" : "", kGroup, n});
    all.push_back({Action::store_camera, GLFW_KEY_0 + n, 0, true, false, kControlDigits[i],
                   n == 1 ? "store the camera (Ctrl+1 to Ctrl+9)" : "", kGroup, n});
  }
  all.push_back(
      control(Action::copy_camera, GLFW_KEY_C, "Ctrl+C", "copy the camera as text", kGroup));
  all.push_back(control(Action::paste_camera, GLFW_KEY_V, "Ctrl+V",
                        "take a camera from copied text", kGroup));
}

void add_window(std::vector<Shortcut>& all) {
  constexpr std::string_view kGroup = "Window";
  all.push_back(plain(Action::full_screen, GLFW_KEY_F11, "F11", "full screen", kGroup));
  all.push_back(control(Action::scale_up, GLFW_KEY_EQUAL, "Ctrl+Plus", "larger text", kGroup));
  all.push_back(control(Action::scale_up, GLFW_KEY_KP_ADD, "Ctrl+Plus", "", kGroup));
  // The same key with Shift is what types the plus sign on many keyboards.
  all.push_back({Action::scale_up, GLFW_KEY_EQUAL, 0, true, true, "Ctrl+Shift+=", "", kGroup, 0});
  all.push_back(control(Action::scale_down, GLFW_KEY_MINUS, "Ctrl+Minus", "smaller text", kGroup));
  all.push_back(control(Action::scale_down, GLFW_KEY_KP_SUBTRACT, "Ctrl+Minus", "", kGroup));
  all.push_back(
      control(Action::scale_reset, GLFW_KEY_0, "Ctrl+0", "text as the monitor asks for", kGroup));
  all.push_back(control(Action::scale_reset, GLFW_KEY_KP_0, "Ctrl+0", "", kGroup));
  all.push_back(plain(Action::manual, GLFW_KEY_F1, "F1", "manual", kGroup));
  all.push_back({Action::shortcuts, 0, '?', false, false, "?", "this list", kGroup, 0});
  all.push_back(plain(Action::escape, GLFW_KEY_ESCAPE, "Escape",
                      "close a dialog; leave the ray; cancel what goes on", kGroup));
}

std::vector<Shortcut> make_table() {
  std::vector<Shortcut> all;
  const std::string_view file = "File";
  all.push_back(control(Action::open_scene, GLFW_KEY_O, "Ctrl+O", "open a scene", file));
  all.push_back(plain(Action::reload_scene, GLFW_KEY_F5, "F5", "read the scene again", file));
  all.push_back(
      control(Action::save_window, GLFW_KEY_S, "Ctrl+S", "save the window as a picture", file));
  all.push_back(control(Action::quit, GLFW_KEY_Q, "Ctrl+Q", "quit", file));
  const std::string_view settings = "Settings";
  all.push_back(control(Action::undo, GLFW_KEY_Z, "Ctrl+Z", "undo settings", settings));
  all.push_back(
      {Action::redo, GLFW_KEY_Z, 0, true, true, "Ctrl+Shift+Z", "redo settings", settings, 0});
  all.push_back(control(Action::redo, GLFW_KEY_Y, "Ctrl+Y", "", settings));
  add_cameras(all);
  const std::string_view scene = "Scene and structure";
  all.push_back(plain(Action::play, GLFW_KEY_SPACE, "Space", "play or pause the animation", scene));
  all.push_back(plain(Action::structure_view, GLFW_KEY_V, "V", "3D view of the structure", scene));
  all.push_back(plain(Action::overlay, GLFW_KEY_B, "B", "overlay of the structure", scene));
  const std::string_view measure = "Measure";
  all.push_back(plain(Action::measure, GLFW_KEY_M, "M", "measure mode", measure));
  all.push_back(control(Action::record, GLFW_KEY_R, "Ctrl+R", "begin or end a recording", measure));
  all.push_back(control(Action::annotate, GLFW_KEY_M, "Ctrl+M", "annotate this moment", measure));
  all.push_back(control(Action::accuracy, GLFW_KEY_E, "Ctrl+E", "error against time", measure));
  add_window(all);
  return all;
}

constexpr std::array<MouseHelp, 8> kMouse{{
    {"left drag", "orbit around the target"},
    {"middle drag, Shift + left drag", "pan"},
    {"wheel", "zoom at the cursor"},
    {"right drag", "look around"},
    {"W A S D Q E, right button held", "fly"},
    {"left click", "follow this pixel's ray"},
    {"Left, Right", "step along the ray, or one frame"},
    {"drop a file", "open it as the scene"},
}};

}  // namespace

std::span<const Shortcut> shortcuts() {
  static const std::vector<Shortcut> table = make_table();
  return table;
}

std::string_view shortcut_text(Action action, int number) {
  for (const Shortcut& shortcut : shortcuts()) {
    if (shortcut.action == action && (number == 0 || shortcut.number == number)) {
      return shortcut.text;
    }
  }
  return {};
}

std::span<const MouseHelp> mouse_help() {
  return kMouse;
}

}  // namespace encore::ui
