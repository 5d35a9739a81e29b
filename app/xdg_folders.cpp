#include "app/xdg_folders.h"

#include <cstdlib>

namespace encore::app {

namespace {

namespace fs = std::filesystem;

std::optional<fs::path> folder(const char* variable, const char* below_home) {
  // A relative path is as good as none.
  if (const char* xdg = std::getenv(variable); xdg != nullptr && xdg[0] == '/') return xdg;
  if (const char* home = std::getenv("HOME"); home != nullptr && home[0] == '/') {
    return fs::path(home) / below_home;
  }
  return std::nullopt;
}

}  // namespace

std::optional<fs::path> data_home() {
  return folder("XDG_DATA_HOME", ".local/share");
}
std::optional<fs::path> config_home() {
  return folder("XDG_CONFIG_HOME", ".config");
}
std::optional<fs::path> state_home() {
  return folder("XDG_STATE_HOME", ".local/state");
}

}  // namespace encore::app
