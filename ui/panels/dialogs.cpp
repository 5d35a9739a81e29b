#include "scene/mesh_reader.h"
#include "ui/panels/file_browser.h"
#include "ui/panels/manual_view.h"
#include "ui/panels/panels.h"
#include "ui/panels/shell_parts.h"
#include "ui/shortcuts.h"
#include "ui/style.h"
#include "ui/versions.h"
#include "ui/widget_map.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <string>
#include <vector>

namespace encore::ui {

namespace {

using Kind = FileBrowserWish::Kind;

std::vector<std::string> scene_extensions() {
  std::vector<std::string> all = scene::supported_extensions();
  all.insert(all.begin(), {".toml", ".txt"});
  return all;
}

void note_dialog(const char* name) {
  const ImVec2 at = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  note_area(name, at.x, at.y, size.x, size.y);
}

/// A dialog with the file browser; `chosen` turns what was chosen into a command.
template <class Chosen>
void draw_browser_dialog(const char* title, const FileBrowserWish& wish, UiState& state,
                         const Chosen& chosen) {
  bool open = true;
  if (begin_dialog(title, 46.0F, 30.0F, open)) {
    note_dialog("dialog.browser");
    if (ImGui::IsWindowAppearing()) start_file_browser(state);
    if (const auto path = draw_file_browser(wish, state)) {
      chosen(*path);
      open = false;
    }
  }
  ImGui::End();
  if (!open) state.dialog = Dialog::none;
}

void draw_shortcut_row(std::string_view keys, std::string_view meaning) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(keys.data(), keys.data() + keys.size());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(meaning.data(), meaning.data() + meaning.size());
}

void draw_group_row(std::string_view group, const ThemeColors& colors) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::TableNextColumn();
  colored_text(colors.accent, group);
}

void draw_shortcut_sheet(UiState& state) {
  bool open = true;
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  if (begin_dialog("Shortcuts", 40.0F, 36.0F, open)) {
    note_dialog("dialog.shortcuts");
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_ScrollY)) {
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.0F);
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.6F);
      std::string_view group;
      for (const Shortcut& shortcut : shortcuts()) {
        if (shortcut.meaning.empty()) continue;
        if (shortcut.group != group) draw_group_row(shortcut.group, colors);
        group = shortcut.group;
        draw_shortcut_row(shortcut.text, shortcut.meaning);
      }
      draw_group_row("Mouse and keys in a pane", colors);
      for (const MouseHelp& help : mouse_help()) draw_shortcut_row(help.text, help.meaning);
      ImGui::EndTable();
    }
  }
  ImGui::End();
  if (!open) state.dialog = Dialog::none;
}

void draw_manual_dialog(UiState& state) {
  bool open = true;
  if (begin_dialog("Manual", 66.0F, 44.0F, open)) {
    note_dialog("dialog.manual");
    draw_manual(state);
  }
  ImGui::End();
  if (!open) state.dialog = Dialog::none;
}

void draw_about(const View& view, UiState& state) {
  bool open = true;
  if (begin_dialog("About ENCORE", 34.0F, 21.0F, open)) {
    note_dialog("dialog.about");
    ImGui::PushFont(heading_font());
    ImGui::TextUnformatted("ENCORE");
    ImGui::PopFont();
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(
        "What acceleration structures of ray tracing cost in time and energy: to build, to update, "
        "to send and to trace.");
    ImGui::Spacing();
    if (ImGui::BeginTable("versions", 2, ImGuiTableFlags_SizingFixedFit)) {
      for (const auto& [what, version] : library_versions()) draw_shortcut_row(what, version);
      draw_shortcut_row("drawn by", view.window.opengl);
      for (const PaneView& pane : view.panes) {
        if (!pane.device.empty()) draw_shortcut_row("traced by", pane.device);
      }
      ImGui::EndTable();
    }
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  if (!open) state.dialog = Dialog::none;
}

void draw_annotate(UiState& state, Commands& commands) {
  bool open = true;
  if (begin_dialog("Annotate this moment", 28.0F, 7.0F, open)) {
    note_dialog("dialog.annotate");
    std::string& text = state.shell.annotation;
    if (ImGui::IsWindowAppearing()) {
      text.clear();
      ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-1.0F);
    bool done = ImGui::InputTextWithHint("##text", "what happens now", &text,
                                         ImGuiInputTextFlags_EnterReturnsTrue);
    note_widget("annotate.text", text);
    hint("One line; it stands in the plots and in the session.");
    ImGui::BeginDisabled(text.empty());
    done = ImGui::Button("Annotate") || done;
    ImGui::EndDisabled();
    note_widget("annotate.done", text.empty() ? "disabled" : "");
    if (done && !text.empty()) {
      commands.push_back(Annotate{text});
      open = false;
    }
  }
  ImGui::End();
  if (!open) state.dialog = Dialog::none;
}

void draw_session_dialogs(const View& view, UiState& state, Commands& commands) {
  const FileBrowserWish session{Kind::session, {}};
  if (state.dialog == Dialog::open_session) {
    draw_browser_dialog("Open a session", session, state,
                        [&](const auto& path) { commands.push_back(OpenSession{path}); });
  } else if (state.dialog == Dialog::compare_session) {
    draw_browser_dialog("Compare with a session", session, state,
                        [&](const auto& path) { commands.push_back(CompareSession{path}); });
  } else if (state.dialog == Dialog::export_session) {
    draw_browser_dialog("Export the session", {Kind::new_folder, {}}, state, [&](const auto& path) {
      commands.push_back(ExportSession{view.session.folder, path});
    });
  }
}

}  // namespace

void draw_dialogs(const View& view, UiState& state, Commands& commands) {
  switch (state.dialog) {
    case Dialog::none:
      return;
    case Dialog::shortcuts:
      return draw_shortcut_sheet(state);
    case Dialog::manual:
      return draw_manual_dialog(state);
    case Dialog::about:
      return draw_about(view, state);
    case Dialog::open_scene:
      return draw_browser_dialog(
          "Open a scene", {Kind::file, scene_extensions()}, state,
          [&](const auto& path) { commands.push_back(OpenScene{path.string()}); });
    case Dialog::annotate:
      return draw_annotate(state, commands);
    case Dialog::energy:
      return draw_energy_dialog(view, state, commands);
    default:
      return draw_session_dialogs(view, state, commands);
  }
}

}  // namespace encore::ui
