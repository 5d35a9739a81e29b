#include "ui/file_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <utility>

namespace encore::ui {

namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool before(const FileEntry& a, const FileEntry& b) {
  if (a.folder != b.folder) return a.folder;
  const std::string x = lower(a.name);
  const std::string y = lower(b.name);
  return x == y ? a.name < b.name : x < y;
}

FileEntry entry_of(const fs::directory_entry& found) {
  std::error_code error;
  FileEntry entry;
  entry.name = found.path().filename().string();
  // What cannot be looked at is listed as a file; opening it tells why.
  entry.folder = found.is_directory(error);
  entry.session = entry.folder && fs::exists(found.path() / "session.toml", error);
  return entry;
}

}  // namespace

FileList read_folder(const fs::path& folder, std::size_t most) {
  FileList list;
  list.folder = folder;
  std::error_code error;
  fs::directory_iterator found(folder, error);
  for (; !error && found != fs::directory_iterator(); found.increment(error)) {
    if (list.entries.size() == most) {
      list.cut = true;
      break;
    }
    list.entries.push_back(entry_of(*found));
    if (list.entries.back().name == "session.toml") list.session = true;
  }
  if (error) {
    list.problem = fmt::format("{} cannot be read: {}; choose another folder", folder.string(),
                               error.message());
  }
  std::sort(list.entries.begin(), list.entries.end(), before);
  return list;
}

std::vector<std::size_t> shown_entries(const FileList& list, const FileFilter& filter) {
  const std::string part = lower(filter.part);
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < list.entries.size(); ++i) {
    const FileEntry& entry = list.entries[i];
    if (entry.hidden() && !filter.hidden) continue;
    const std::string name = lower(entry.name);
    if (!part.empty() && name.find(part) == std::string::npos) continue;
    if (!entry.folder) {
      if (filter.folders_only) continue;
      const bool fits = filter.extensions.empty() ||
                        std::any_of(filter.extensions.begin(), filter.extensions.end(),
                                    [&](const std::string& end) { return name.ends_with(end); });
      if (!fits) continue;
    }
    shown.push_back(i);
  }
  return shown;
}

void FolderReader::want(const fs::path& folder, bool again) {
  if (folder == wanted_ && !again) return;
  wanted_ = folder;
  list_.reset();
  std::promise<std::shared_ptr<const FileList>> promise;
  coming_ = promise.get_future().share();
  try {
    // Nobody waits for it: it holds nothing but its promise.
    std::thread([promise = std::move(promise), folder]() mutable {
      promise.set_value(std::make_shared<const FileList>(read_folder(folder)));
    }).detach();
  } catch (const std::system_error& error) {
    FileList none;
    none.folder = folder;
    none.problem = fmt::format("no thread to read folders: {}; try again", error.what());
    list_ = std::make_shared<const FileList>(std::move(none));
  }
}

std::shared_ptr<const FileList> FolderReader::list() {
  if (!list_ && coming_.valid()) {
    // Local folders answer in this time, so that nothing flickers.
    if (coming_.wait_for(std::chrono::milliseconds(2)) == std::future_status::ready) {
      list_ = coming_.get();
      coming_ = {};
    }
  }
  return list_;
}

fs::path home_folder() {
  const char* home = std::getenv("HOME");
  return home != nullptr && home[0] == '/' ? fs::path(home) : fs::path("/");
}

fs::path typed_path(const std::string& text, const fs::path& folder) {
  if (text == "~") return home_folder();
  if (text.starts_with("~/")) return (home_folder() / text.substr(2)).lexically_normal();
  const fs::path path(text);
  return (path.is_absolute() ? path : folder / path).lexically_normal();
}

std::string name_obstacle(const FileList& list, const std::string& name) {
  if (!list.problem.empty()) return list.problem;
  if (name.empty()) return "name the new folder";
  if (name == "." || name == ".." || name.find('/') != std::string::npos) {
    return "a name without /; go to the folder that it shall be in";
  }
  const bool taken = std::any_of(list.entries.begin(), list.entries.end(),
                                 [&](const FileEntry& entry) { return entry.name == name; });
  if (taken) return fmt::format("{} is there already; nothing is overwritten", name);
  return {};
}

}  // namespace encore::ui
