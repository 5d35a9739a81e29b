#include "scene/sample_scenes.h"
#include "scene/shipped_files.h"
#include "ui/panels/menu_parts.h"
#include "ui/panels/panels.h"
#include "ui/panels/shell_parts.h"
#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>

namespace encore::ui {

namespace {

void open_scene(const MenuContext& context, const std::string& name) {
  context.commands.push_back(OpenScene{name});
}

void draw_samples(const MenuContext& context) {
  for (const scene::SampleScene& sample : scene::sample_scenes()) {
    const std::string tip = fmt::format("{}\n{} triangles, {}; {}", sample.description,
                                        sample.triangles, sample.animation, sample.thesis_name);
    if (menu_entry({.name = "menu.file.sample." + sample.name, .label = sample.name, .tip = tip})) {
      open_scene(context, sample.name);
    }
  }
  auto& shipped = context.state.shell.shipped_scenes;
  if (!shipped) shipped = scene::shipped_names("scenes");
  if (!shipped->empty()) ImGui::Separator();
  for (const std::string& name : *shipped) {
    if (menu_entry({.name = "menu.file.sample." + name,
                    .label = name,
                    .tip = "A scene file that ships with the program."})) {
      open_scene(context, name);
    }
  }
}

void draw_recent_scenes(const MenuContext& context) {
  auto& recent = context.state.preferences.recent_scenes;
  const std::vector<std::string> names = recent;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string label = fmt::format("{}##{}", fitted(names[i], ImGui::GetFontSize() * 30), i);
    if (menu_entry(
            {.name = fmt::format("menu.file.recent.{}", i), .label = label, .tip = names[i]})) {
      open_scene(context, names[i]);
    }
  }
  ImGui::Separator();
  if (menu_entry({.name = "menu.file.recent.clear",
                  .label = "Forget these",
                  .tip = "Empties this list; the files stay."})) {
    recent.clear();
  }
}

void draw_pictures(const MenuContext& context) {
  struct Picture {
    PictureOf what;
    const char* name;
    const char* label;
    bool enabled;
  };
  const auto& view = context.view;
  const std::array<Picture, 5> pictures{
      {{PictureOf::pane_0, "left_pane", "Left pane", view.panes[0].texture != 0},
       {PictureOf::pane_1, "right_pane", "Right pane", view.panes[1].texture != 0},
       {PictureOf::structure_view, "structure_view", "3D view",
        context.state.structure_view && view.structure_view.texture != 0},
       {PictureOf::plots, "plots", "Plots", context.state.preferences.layout.plots},
       {PictureOf::window, "window", "Window", true}}};
  for (const Picture& picture : pictures) {
    const bool window = picture.what == PictureOf::window;
    if (menu_entry({.name = std::string("menu.file.picture.") + picture.name,
                    .label = picture.label,
                    .tip = "Saves it as a PNG in the pictures' folder; a notice names the file.",
                    .enabled = picture.enabled,
                    .keys = window ? shortcut_text(Action::save_window) : ""})) {
      context.commands.push_back(SavePicture{picture.what, {}});
    }
  }
}

void dialog_entry(const MenuContext& context, Dialog dialog, const MenuEntry& entry) {
  if (menu_entry(entry)) context.state.dialog = dialog;
}

void draw_session_entries(const MenuContext& context) {
  const SessionView& session = context.view.session;
  const bool open = !session.folder.empty();
  dialog_entry(context, Dialog::open_session,
               {.name = "menu.file.open_session",
                .label = "Open session…",
                .tip = "Shows a recorded session in the plots."});
  auto& recent = context.state.preferences.recent_sessions;
  if (begin_menu("Recent sessions", "menu.file.recent_sessions", !recent.empty())) {
    for (std::size_t i = 0; i < recent.size(); ++i) {
      const std::string shown = fitted(recent[i], ImGui::GetFontSize() * 30);
      if (menu_entry({.name = fmt::format("menu.file.recent_session.{}", i),
                      .label = fmt::format("{}##{}", shown, i),
                      .tip = recent[i]})) {
        context.commands.push_back(OpenSession{recent[i]});
      }
    }
    ImGui::EndMenu();
  }
  dialog_entry(context, Dialog::compare_session,
               {.name = "menu.file.compare",
                .label = "Compare with…",
                .tip = "Holds a second session to the one that is open.",
                .enabled = open});
  dialog_entry(context, Dialog::export_session,
               {.name = "menu.file.export",
                .label = "Export session…",
                .tip = "Copies the session that is open to a new folder.",
                .enabled = open});
  if (menu_entry({.name = "menu.file.close_session",
                  .label = "Close session",
                  .tip = "The plots show the present again.",
                  .enabled = open})) {
    context.commands.push_back(CloseSession{});
  }
}

}  // namespace

bool menu_entry(const MenuEntry& entry) {
  const std::string keys(entry.keys);
  const bool chosen =
      ImGui::MenuItem(entry.label.c_str(), keys.c_str(), entry.selected, entry.enabled);
  note_widget(entry.name, !entry.enabled ? "disabled" : entry.selected ? "on" : "");
  hint(entry.tip);
  return chosen;
}

void action_entry(const MenuContext& context, Action action, const MenuEntry& entry, int number) {
  MenuEntry shown = entry;
  shown.enabled = entry.enabled && available(action, context.view, context.state, number);
  shown.keys = shortcut_text(action, number);
  if (menu_entry(shown)) {
    perform(action, context.view, context.state, context.commands, number);
  }
}

void toggle_entry(const MenuEntry& entry, bool& value) {
  MenuEntry shown = entry;
  shown.selected = value;
  if (menu_entry(shown)) value = !value;
}

bool begin_menu(const char* label, const char* name, bool enabled) {
  const bool open = ImGui::BeginMenu(label, enabled);
  // Inside the open menu, the last item is the menu's own no longer.
  if (!open) note_widget(name, enabled ? "" : "disabled");
  return open;
}

void draw_file_menu(const MenuContext& context) {
  action_entry(context, Action::open_scene,
               {.name = "menu.file.open",
                .label = "Open scene…",
                .tip = "A scene file (.toml, .txt) or a model (.obj, .ply, .3ds, .gltf, .stl …)."});
  if (begin_menu("Sample scenes", "menu.file.samples")) {
    draw_samples(context);
    ImGui::EndMenu();
  }
  const bool recent = !context.state.preferences.recent_scenes.empty();
  if (begin_menu("Recent scenes", "menu.file.recent", recent)) {
    draw_recent_scenes(context);
    ImGui::EndMenu();
  }
  action_entry(context, Action::reload_scene,
               {.name = "menu.file.reload",
                .label = "Read again",
                .tip = "Reads the scene's files again; camera and settings stay."});
  ImGui::Separator();
  draw_session_entries(context);
  ImGui::Separator();
  if (begin_menu("Save picture of", "menu.file.picture")) {
    draw_pictures(context);
    ImGui::EndMenu();
  }
  ImGui::Separator();
  action_entry(context, Action::quit,
               {.name = "menu.file.quit",
                .label = "Quit",
                .tip = "Ends the program; a recording is closed in good order."});
}

void draw_menu(const View& view, UiState& state, Commands& commands) {
  if (!ImGui::BeginMainMenuBar()) return;
  const MenuContext context{view, state, commands};
  struct Menu {
    const char* label;
    const char* name;
    void (*draw)(const MenuContext&);
  };
  constexpr std::array<Menu, 6> kMenus{{{"File", "menu.file", draw_file_menu},
                                        {"Edit", "menu.edit", draw_edit_menu},
                                        {"View", "menu.view", draw_view_menu},
                                        {"Structure", "menu.structure", draw_structure_menu},
                                        {"Measure", "menu.measure", draw_measure_menu},
                                        {"Help", "menu.help", draw_help_menu}}};
  for (const Menu& menu : kMenus) {
    if (!begin_menu(menu.label, menu.name)) continue;
    menu.draw(context);
    ImGui::EndMenu();
  }
  draw_menu_end(context);
  ImGui::EndMainMenuBar();
}

}  // namespace encore::ui
