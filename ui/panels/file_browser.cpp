#include "ui/panels/file_browser.h"

#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

namespace encore::ui {

namespace {

namespace fs = std::filesystem;
using Kind = FileBrowserWish::Kind;

void go_to(FileBrowserState& browser, const fs::path& folder) {
  browser.folder = folder;
  browser.typed = folder.string();
  browser.chosen.clear();
  browser.part.clear();
  browser.reader.want(folder);
}

/// The folder of what was chosen is where the next search begins.
fs::path chosen_path(UiState& state, const fs::path& path) {
  FileBrowserState& browser = state.shell.browser;
  std::erase(browser.recent, browser.folder);
  browser.recent.insert(browser.recent.begin(), browser.folder);
  if (browser.recent.size() > 8) browser.recent.resize(8);
  state.preferences.last_folder = browser.folder.string();
  return path;
}

/// A typed path: a folder is gone to, anything else is chosen where that fits.
std::optional<fs::path> enter_typed(const FileBrowserWish& wish, UiState& state) {
  FileBrowserState& browser = state.shell.browser;
  const fs::path path = typed_path(browser.typed, browser.folder);
  std::error_code error;
  if (wish.kind == Kind::session && fs::exists(path / "session.toml", error)) {
    browser.folder = path.parent_path();
    return chosen_path(state, path);
  }
  if (fs::is_directory(path, error)) {
    go_to(browser, path.has_filename() || path == path.root_path() ? path : path.parent_path());
  } else if (wish.kind == Kind::file && fs::exists(path, error)) {
    browser.folder = path.parent_path();
    return chosen_path(state, path);
  } else {
    tell(state, fmt::format("{} is not there; type another path", path.string()), true);
  }
  return std::nullopt;
}

std::optional<fs::path> draw_path_line(const FileBrowserWish& wish, UiState& state) {
  FileBrowserState& browser = state.shell.browser;
  if (ImGui::Button("↑")) go_to(browser, browser.folder.parent_path());
  note_widget("browser.up");
  hint("The folder above.");
  ImGui::SameLine();
  if (ImGui::Button("Home")) go_to(browser, home_folder());
  note_widget("browser.home");
  hint("Your home folder.");
  ImGui::SameLine();
  if (ImGui::Button("Again")) browser.reader.want(browser.folder, true);
  note_widget("browser.again");
  hint("Reads the folder again.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0F);
  const bool entered =
      ImGui::InputText("##path", &browser.typed,
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  note_widget("browser.path", browser.typed);
  hint("Type a path and press Enter; ~ is your home folder.");
  if (entered) return enter_typed(wish, state);
  return std::nullopt;
}

void draw_filter_line(FileBrowserState& browser) {
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(em * 12.0F);
  ImGui::InputTextWithHint("##part", "part of a name", &browser.part);
  note_widget("browser.part", browser.part);
  hint("Only names that hold this.");
  ImGui::SameLine();
  ImGui::Checkbox("Hidden", &browser.hidden);
  note_widget("browser.hidden", browser.hidden ? "on" : "off");
  hint("Names that begin with a dot, too.");
  if (browser.recent.empty()) return;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(em * 10.0F);
  if (ImGui::BeginCombo("##recent", "Recent folders")) {
    const std::vector<fs::path> recent = browser.recent;
    for (const fs::path& folder : recent) {
      if (ImGui::Selectable(folder.string().c_str())) go_to(browser, folder);
    }
    ImGui::EndCombo();
  }
  note_widget("browser.recent");
  hint("Folders that were used before.");
}

bool fits(const FileEntry& entry, Kind kind) {
  return kind == Kind::file ? !entry.folder : kind == Kind::session && entry.session;
}

/// One row; a double click goes into folders and chooses what fits.
std::optional<fs::path> draw_entry(const FileEntry& entry, Kind kind, UiState& state) {
  FileBrowserState& browser = state.shell.browser;
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  const bool chosen = browser.chosen == entry.name;
  ImGui::PushStyleColor(ImGuiCol_Text, entry.session  ? colors.good
                                       : entry.folder ? colors.accent
                                                      : colors.text);
  const std::string label = entry.folder ? entry.name + "/" : entry.name;
  const bool clicked = ImGui::Selectable(
      label.c_str(), chosen,
      ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_SpanAllColumns);
  ImGui::PopStyleColor();
  note_widget("browser.entry." + entry.name, entry.session ? "session" : chosen ? "chosen" : "");
  if (entry.session) {
    ImGui::SameLine();
    colored_text(colors.dim_text, "session");
  }
  if (!clicked) return std::nullopt;
  browser.chosen = entry.name;
  if (!ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return std::nullopt;
  if (fits(entry, kind)) return chosen_path(state, browser.folder / entry.name);
  if (entry.folder) go_to(browser, browser.folder / entry.name);
  return std::nullopt;
}

std::optional<fs::path> draw_entries(const FileBrowserWish& wish, const FileList& list,
                                     UiState& state) {
  const FileFilter filter{wish.extensions, wish.kind != Kind::file, state.shell.browser.hidden,
                          state.shell.browser.part};
  const std::vector<std::size_t> shown = shown_entries(list, filter);
  std::optional<fs::path> chosen;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      // A row that is gone into changes the list only with the next frame.
      const FileEntry entry = list.entries[shown[static_cast<std::size_t>(i)]];
      ImGui::PushID(i);
      if (auto path = draw_entry(entry, wish.kind, state)) chosen = std::move(path);
      ImGui::PopID();
      if (state.shell.browser.folder != list.folder) return chosen;
    }
  }
  if (shown.empty()) {
    ImGui::TextDisabled("%s", list.entries.empty() ? "This folder is empty."
                                                   : "Nothing here fits; look in other folders.");
  }
  if (list.cut) ImGui::TextDisabled("There is more; type the path of what is missing.");
  return chosen;
}

std::optional<fs::path> draw_list(const FileBrowserWish& wish, float below, UiState& state) {
  FileBrowserState& browser = state.shell.browser;
  std::optional<fs::path> chosen;
  ImGui::BeginChild("entries", {0.0F, -below}, true);
  // Held on to: going elsewhere while it is drawn lets go of it.
  if (const auto list = browser.reader.list(); list == nullptr) {
    ImGui::TextDisabled("reading…");
  } else if (!list->problem.empty()) {
    ImGui::PushTextWrapPos(0.0F);
    colored_text(theme_colors(state.preferences.theme).problem, list->problem);
    ImGui::PopTextWrapPos();
  } else {
    chosen = draw_entries(wish, *list, state);
  }
  ImGui::EndChild();
  return chosen;
}

const FileEntry* chosen_entry(const FileList& list, const std::string& name) {
  const auto found = std::find_if(list.entries.begin(), list.entries.end(),
                                  [&](const FileEntry& entry) { return entry.name == name; });
  return found == list.entries.end() ? nullptr : &*found;
}

/// What the button would choose, or why nothing.
struct Choice {
  fs::path path;
  std::string obstacle;
};
Choice choice_of(const FileBrowserWish& wish, const FileBrowserState& browser,
                 const FileList* list) {
  if (list == nullptr) return {{}, "reading…"};
  if (wish.kind == Kind::new_folder) {
    return {browser.folder / browser.name, name_obstacle(*list, browser.name)};
  }
  const FileEntry* entry = chosen_entry(*list, browser.chosen);
  if (entry != nullptr && fits(*entry, wish.kind)) return {browser.folder / entry->name, {}};
  // The folder that is shown may be a session itself.
  if (wish.kind == Kind::session && entry == nullptr && list->session) return {browser.folder, {}};
  return {{}, wish.kind == Kind::file ? "choose a file" : "choose a folder marked as session"};
}

/// The line below the list: the button that chooses, and what is in its way.
std::optional<fs::path> draw_choice(const FileBrowserWish& wish, UiState& state) {
  FileBrowserState& browser = state.shell.browser;
  if (wish.kind == Kind::new_folder) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 16.0F);
    ImGui::InputTextWithHint("##name", "name of the new folder", &browser.name);
    note_widget("browser.name", browser.name);
    hint("It is made inside of the folder above; nothing is ever overwritten.");
    ImGui::SameLine();
  }
  const auto list = browser.reader.list();
  const auto [path, obstacle] = choice_of(wish, browser, list.get());
  ImGui::BeginDisabled(!obstacle.empty());
  const bool pressed = ImGui::Button(wish.kind == Kind::new_folder ? "Export" : "Open");
  ImGui::EndDisabled();
  note_widget("browser.choose", obstacle.empty() ? "" : "disabled");
  ImGui::SameLine();
  ImGui::TextDisabled("%s", obstacle.empty() ? path.filename().string().c_str() : obstacle.c_str());
  if (pressed && obstacle.empty()) return chosen_path(state, path);
  return std::nullopt;
}

}  // namespace

void start_file_browser(UiState& state) {
  FileBrowserState& browser = state.shell.browser;
  fs::path folder =
      browser.folder.empty() ? fs::path(state.preferences.last_folder) : browser.folder;
  if (!folder.is_absolute()) folder = home_folder();
  go_to(browser, folder);
  browser.reader.want(folder, true);
}

std::optional<fs::path> draw_file_browser(const FileBrowserWish& wish, UiState& state) {
  const float below = ImGui::GetFrameHeightWithSpacing() * 2.0F + ImGui::GetStyle().ItemSpacing.y;
  std::optional<fs::path> chosen = draw_path_line(wish, state);
  if (auto path = draw_list(wish, below, state)) chosen = std::move(path);
  draw_filter_line(state.shell.browser);
  if (auto path = draw_choice(wish, state)) chosen = std::move(path);
  return chosen;
}

}  // namespace encore::ui
