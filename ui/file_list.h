#pragma once

#include <cstddef>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace encore::ui {

/// One file or folder of a folder.
struct FileEntry {
  std::string name;
  bool folder = false;
  bool session = false;  ///< a folder with a session.toml

  [[nodiscard]] bool hidden() const { return name.starts_with('.'); }
};

struct FileList {
  std::filesystem::path folder;
  std::vector<FileEntry> entries;  ///< folders first, each kind by name, capitals or not
  std::string problem;             ///< one line; empty if the folder could be read
  bool cut = false;                ///< there are more than were read
  bool session = false;            ///< it holds a session.toml itself
};

/// Reads a folder; at most `most` entries. Never throws.
FileList read_folder(const std::filesystem::path& folder, std::size_t most = 20'000);

/// Which entries are shown.
struct FileFilter {
  std::vector<std::string> extensions{};  ///< of files, with dots, in lower case; empty: all files
  bool folders_only = false;
  bool hidden = false;
  std::string part{};  ///< of the name, capitals or not
};
/// Places of the entries that pass, in order. Folders pass whatever their name ends in.
std::vector<std::size_t> shown_entries(const FileList& list, const FileFilter& filter);

/// Reads folders on threads of their own: a network folder that does not answer stops nobody.
class FolderReader {
 public:
  /// Begins to read, if it is another folder than that of the last call or `again`.
  void want(const std::filesystem::path& folder, bool again = false);
  /// The wanted folder's list; null while it is read.
  std::shared_ptr<const FileList> list();
  [[nodiscard]] const std::filesystem::path& wanted() const { return wanted_; }

 private:
  std::filesystem::path wanted_;
  std::shared_future<std::shared_ptr<const FileList>> coming_;
  std::shared_ptr<const FileList> list_;
};

/// A path as a person types it: "~" is the home folder, relative ones start at `folder`.
std::filesystem::path typed_path(const std::string& text, const std::filesystem::path& folder);

/// $HOME, else the root.
std::filesystem::path home_folder();

/// Why no new folder of this name can be made in a folder, in one line with the way out; empty if
/// one can.
std::string name_obstacle(const FileList& list, const std::string& name);

}  // namespace encore::ui
