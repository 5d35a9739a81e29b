#include "ui/shortcuts.h"

#include "ui/panels/panels.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace encore::ui {

namespace {

/// Undo and scale go on while their keys are held.
bool repeats(Action action) {
  return action == Action::undo || action == Action::redo || action == Action::scale_up ||
         action == Action::scale_down;
}

/// What still means something while a text is typed.
bool works_while_typing(Action action) {
  return action == Action::escape || action == Action::manual || action == Action::full_screen ||
         action == Action::quit;
}

bool typed(char character) {
  const auto& queue = ImGui::GetIO().InputQueueCharacters;
  return std::find(queue.begin(), queue.end(), static_cast<ImWchar>(character)) != queue.end();
}

bool pressed(const Shortcut& shortcut) {
  const ImGuiIO& io = ImGui::GetIO();
  if (shortcut.key == 0) return !io.KeyCtrl && !io.KeyAlt && typed(shortcut.character);
  return io.KeyCtrl == shortcut.control && io.KeyShift == shortcut.shift && !io.KeyAlt &&
         !io.KeySuper && ImGui::IsKeyPressed(shortcut.key, repeats(shortcut.action));
}

/// Menus and lists that are open take Escape first.
bool close_popups() {
  const auto any = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;
  if (!ImGui::IsPopupOpen(static_cast<const char*>(nullptr), any)) return false;
  ImGui::ClosePopupToLevel(0, true);
  return true;
}

}  // namespace

void handle_shortcuts(const View& view, UiState& state, Commands& commands) {
  const bool typing = ImGui::GetIO().WantTextInput;
  for (const Shortcut& shortcut : shortcuts()) {
    if (typing && !works_while_typing(shortcut.action)) continue;
    if (!pressed(shortcut)) continue;
    if (shortcut.action == Action::escape && close_popups()) continue;
    perform(shortcut.action, view, state, commands, shortcut.number);
  }
}

}  // namespace encore::ui
