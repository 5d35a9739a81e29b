#include "app/window/settings_file.h"

#include "app/window/settings_fields.h"
#include "app/xdg_folders.h"
#include "scene/toml_reading.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <system_error>

namespace encore::app {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 4U << 20U;

std::string text_of(const toml::table& table, std::string_view heading) {
  std::ostringstream out;
  out << "# " << heading << "\n" << table << "\n";
  return out.str();
}

toml::array bookmarks_of(const ui::Preferences& preferences) {
  toml::array all;
  for (const auto& [scene, cameras] : preferences.bookmarks) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      if (!cameras[i]) continue;
      toml::table bookmark;
      bookmark.insert("scene", scene);
      bookmark.insert("number", static_cast<std::int64_t>(i + 1));
      SettingsWriter writer(bookmark);
      scene::Camera camera = *cameras[i];
      visit_camera(writer, camera);
      all.push_back(bookmark);
    }
  }
  return all;
}

void read_bookmark(const toml::table& table, const std::string& file, KeptStateRead& read) {
  // A camera that is half read would show something nobody stored: all of it or nothing.
  const std::size_t before = read.warnings.size();
  SettingsReader reader(table, "camera.", file, read.warnings);
  std::string scene;
  int number = 0;
  scene::Camera camera;
  reader.text("scene", scene);
  reader.integer("number", number, {1, 9});
  visit_camera(reader, camera);
  if (read.warnings.size() > before) return;
  if (scene.empty() || number == 0 || camera.eye == camera.target) {
    reader.warn("scene", "a stored camera needs scene, number, eye and target");
    return;
  }
  read.kept.preferences.bookmarks[scene][static_cast<std::size_t>(number - 1)] = camera;
}

/// The table of a text; on errors an empty one and a warning.
toml::table parse(std::string_view text, const std::string& file, KeptStateRead& read) {
  try {
    return scene::parse_toml(text, file);
  } catch (const scene::InputError& error) {
    read.warnings.push_back(fmt::format("{}; the defaults are used", error.what()));
  } catch (const std::exception& error) {
    read.warnings.push_back(fmt::format("{}: {}; the defaults are used", file, error.what()));
  }
  return {};
}

std::optional<std::string> file_text(const fs::path& path, KeptStateRead& read) {
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) return std::nullopt;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > kMostBytes || error) {
    read.warnings.push_back(
        fmt::format("{}: no file of settings; the defaults are used", path.string()));
    return std::nullopt;
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) {
    read.warnings.push_back(
        fmt::format("{}: cannot be read; the defaults are used", path.string()));
    return std::nullopt;
  }
  return text.str();
}

/// Writes beside the file and renames; what went wrong in one line, or nothing.
std::string write_whole(const fs::path& path, const std::string& text) {
  if (path.empty()) return {};
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  const fs::path partial = path.string() + fmt::format(".{}.partial", ::getpid());
  {
    std::ofstream out(partial, std::ios::binary | std::ios::trunc);
    out << text;
    out.flush();
    if (!out) {
      fs::remove(partial, error);
      return fmt::format("{} cannot be written; settings are not kept", path.string());
    }
  }
  fs::rename(partial, path, error);
  if (!error) return {};
  const std::string why = error.message();
  fs::remove(partial, error);
  return fmt::format("{} cannot be written: {}; settings are not kept", path.string(), why);
}

}  // namespace

SettingsFiles settings_files() {
  SettingsFiles files;
  if (const auto home = config_home()) files.settings = *home / "encore" / "window.toml";
  if (const auto home = state_home()) files.state = *home / "encore" / "window-state.toml";
  return files;
}

std::string settings_text(const KeptState& kept) {
  KeptState copy = kept;
  toml::table table;
  SettingsWriter writer(table);
  visit_preferences(writer, copy.preferences);
  visit_settings(writer, copy.settings);
  return text_of(table, "Settings of ENCORE's window. Written when it closes.");
}

std::string state_text(const KeptState& kept) {
  KeptState copy = kept;
  toml::table table;
  SettingsWriter writer(table);
  visit_state(writer, copy.preferences);
  table.insert("camera", bookmarks_of(kept.preferences));
  return text_of(table, "Layout, recent files and stored cameras of ENCORE's window.");
}

void read_settings_text(std::string_view text, const std::string& file, KeptStateRead& read) {
  const toml::table table = parse(text, file, read);
  SettingsReader reader(table, "", file, read.warnings);
  visit_preferences(reader, read.kept.preferences);
  visit_settings(reader, read.kept.settings);
}

void read_state_text(std::string_view text, const std::string& file, KeptStateRead& read) {
  const toml::table table = parse(text, file, read);
  SettingsReader reader(table, "", file, read.warnings);
  visit_state(reader, read.kept.preferences);
  const toml::node* cameras = table.get("camera");
  if (cameras == nullptr) return;
  const toml::array* all = cameras->as_array();
  if (all == nullptr) return reader.warn("camera", "it takes a list of cameras");
  for (const toml::node& bookmark : *all) {
    if (const toml::table* inner = bookmark.as_table()) {
      read_bookmark(*inner, file, read);
    } else {
      reader.warn("camera", "it takes a list of cameras");
    }
  }
}

KeptStateRead read_kept_state(const SettingsFiles& files) {
  KeptStateRead read;
  if (const auto text = file_text(files.settings, read)) {
    read_settings_text(*text, files.settings.string(), read);
  }
  if (const auto text = file_text(files.state, read)) {
    read_state_text(*text, files.state.string(), read);
  }
  return read;
}

std::vector<std::string> write_kept_state(const SettingsFiles& files, const KeptState& kept) {
  std::vector<std::string> problems;
  for (const auto& [path, text] :
       {std::pair(files.settings, settings_text(kept)), std::pair(files.state, state_text(kept))}) {
    if (std::string problem = write_whole(path, text); !problem.empty()) {
      problems.push_back(std::move(problem));
    }
  }
  return problems;
}

void forget_kept_state(const SettingsFiles& files) {
  std::error_code error;
  if (!files.settings.empty()) fs::remove(files.settings, error);
  if (!files.state.empty()) fs::remove(files.state, error);
}

}  // namespace encore::app
