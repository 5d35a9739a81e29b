#pragma once

#include "ui/file_list.h"
#include "ui/layout.h"
#include "ui/manual.h"
#include "ui/undo.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace encore::ui {

/// What the file browser shows.
struct FileBrowserState {
  std::filesystem::path folder;
  std::string typed;   ///< in the path's field
  std::string part;    ///< only names with this
  std::string chosen;  ///< name of the selected entry
  std::string name;    ///< of the folder that an export makes
  bool hidden = false;
  FolderReader reader;
  std::vector<std::filesystem::path> recent;  ///< folders, the latest first
};

/// What the shown manual looks like.
struct ManualState {
  Manual manual;
  std::string words;                     ///< that are searched
  std::vector<std::size_t> found;        ///< blocks
  std::size_t at = 0;                    ///< of `found`
  std::optional<std::size_t> scroll_to;  ///< a block
};

/// What the window's own parts (menu, dialogs, splitters) keep between frames.
struct ShellState {
  History history;
  FileBrowserState browser;
  ManualState manual;
  std::string annotation;
  std::optional<std::vector<std::string>> shipped_scenes;  ///< looked for when first shown
  bool power_line_dismissed = false;
  /// The division when the mouse took hold of a splitter.
  std::optional<LayoutSettings> grabbed;
};

}  // namespace encore::ui
