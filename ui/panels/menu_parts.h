#pragma once

#include "ui/shortcuts.h"

#include <string>
#include <string_view>

namespace encore::ui {

// What the menus are made of; internal to them.

/// What every menu reads and edits.
struct MenuContext {
  const View& view;
  UiState& state;
  Commands& commands;
};

/// How an entry looks.
struct MenuEntry {
  std::string name{};   ///< in the widget map: "menu.file.open"
  std::string label{};  ///< as shown
  std::string tip{};
  bool enabled = true;
  bool selected = false;
  std::string_view keys{};
};
/// True when it is chosen.
bool menu_entry(const MenuEntry& entry);

/// An entry that does an action, with its keys, grey where it would do nothing.
void action_entry(const MenuContext& context, Action action, const MenuEntry& entry,
                  int number = 0);

/// An entry that turns something on and off.
void toggle_entry(const MenuEntry& entry, bool& value);

/// A menu in the bar or in a menu, noted under its name; to be ended with ImGui::EndMenu() if true.
bool begin_menu(const char* label, const char* name, bool enabled = true);

void draw_file_menu(const MenuContext& context);
void draw_edit_menu(const MenuContext& context);
void draw_view_menu(const MenuContext& context);
void draw_structure_menu(const MenuContext& context);
void draw_measure_menu(const MenuContext& context);
void draw_help_menu(const MenuContext& context);

/// The right end of the menu bar: scene, provenance, frames a second.
void draw_menu_end(const MenuContext& context);

}  // namespace encore::ui
