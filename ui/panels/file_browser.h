#pragma once

#include "ui/file_list.h"
#include "ui/ui_state.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace encore::ui {

/// What is to be chosen in the browser.
struct FileBrowserWish {
  enum class Kind {
    file,        ///< with one of the extensions
    session,     ///< a folder that holds a session.toml
    new_folder,  ///< a name that is free, for an export
  } kind = Kind::file;
  std::vector<std::string> extensions;
};

/// Opens the browser at the folder that was used last, or at home.
void start_file_browser(UiState& state);

/// The browser inside the window that is open: path, places, entries, and the line where a new
/// folder is named. Returns what was chosen, once. Escape and Cancel are the dialog's own.
std::optional<std::filesystem::path> draw_file_browser(const FileBrowserWish& wish, UiState& state);

}  // namespace encore::ui
