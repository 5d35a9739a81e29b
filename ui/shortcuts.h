#pragma once

#include "ui/command.h"
#include "ui/ui_state.h"
#include "ui/view.h"

#include <span>
#include <string>
#include <string_view>

namespace encore::ui {

/// What keys and menu entries do.
enum class Action {
  manual,
  shortcuts,
  open_scene,
  reload_scene,
  save_window,
  quit,
  undo,
  redo,
  focus,
  reset_camera,
  orthographic,
  recall_camera,  ///< with a number, 1 to 9
  store_camera,   ///< with a number
  copy_camera,
  paste_camera,
  play,
  structure_view,
  overlay,
  measure,
  record,
  annotate,
  accuracy,
  full_screen,
  scale_up,
  scale_down,
  scale_reset,
  escape,
};

/// One key and what it does. Keys are GLFW's codes.
struct Shortcut {
  Action action = Action::manual;
  int key = 0;         ///< 0: the character
  char character = 0;  ///< that is typed, wherever it lies on this keyboard
  bool control = false;
  bool shift = false;
  std::string_view text;     ///< "Ctrl+Shift+Z"
  std::string_view meaning;  ///< "redo settings"; empty for a second key of the same
  std::string_view group;    ///< "Camera"
  int number = 0;            ///< of cameras: 1 to 9; only the first of them has a meaning
};
std::span<const Shortcut> shortcuts();

/// The keys of an action as menus show them; empty if it has none.
std::string_view shortcut_text(Action action, int number = 0);

/// What the mouse and the plain keys do in a pane, for the sheet of shortcuts.
struct MouseHelp {
  std::string_view text;
  std::string_view meaning;
};
std::span<const MouseHelp> mouse_help();

/// Whether an action would do anything now; menus grey what would not.
bool available(Action action, const View& view, const UiState& state, int number = 0);

/// Does it. What cannot be done is told in a notice.
void perform(Action action, const View& view, UiState& state, Commands& commands, int number = 0);

}  // namespace encore::ui
