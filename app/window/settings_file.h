#pragma once

#include "ui/ui_state.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace encore::app {

/// What the window keeps from run to run.
struct KeptState {
  ui::Settings settings = ui::default_settings();
  ui::Preferences preferences;

  friend bool operator==(const KeptState&, const KeptState&) = default;
};

/// Where it is kept. Settings, theme and scale are configuration, the rest (division of the window,
/// recent files, stored cameras) is state. Empty paths: nothing is kept.
struct SettingsFiles {
  std::filesystem::path settings;
  std::filesystem::path state;
};
/// encore/window.toml in config_home() and encore/window-state.toml in state_home().
SettingsFiles settings_files();

/// What was read, and one line for each thing that was wrong: file, key, what takes its place.
struct KeptStateRead {
  KeptState kept;
  std::vector<std::string> warnings;
};

/// Reads both files. A missing one gives defaults without a word; one that is no TOML gives
/// defaults and a warning; a value that does not fit gives the default of that value alone and a
/// warning. Keys that are not known are ignored: a newer version may have written them. Never
/// throws for what is in a file.
KeptStateRead read_kept_state(const SettingsFiles& files);

/// Writes both files, each under another name first and then renamed, so that a crash leaves the
/// old or the new one. Makes their folders. Returns one line a file that could not be written.
std::vector<std::string> write_kept_state(const SettingsFiles& files, const KeptState& kept);

/// The same as texts, for one file each.
std::string settings_text(const KeptState& kept);
std::string state_text(const KeptState& kept);
void read_settings_text(std::string_view text, const std::string& file, KeptStateRead& read);
void read_state_text(std::string_view text, const std::string& file, KeptStateRead& read);

/// Deletes both files, so that the next start is as the first.
void forget_kept_state(const SettingsFiles& files);

}  // namespace encore::app
