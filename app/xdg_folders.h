#pragma once

#include <filesystem>
#include <optional>

namespace encore::app {

// Folders by the XDG rules (Base Directory Specification 0.8): $XDG_…_HOME if it is an absolute
// path, else its usual place below $HOME; nothing where there is no home either.

std::optional<std::filesystem::path> data_home();    ///< ~/.local/share
std::optional<std::filesystem::path> config_home();  ///< ~/.config
std::optional<std::filesystem::path> state_home();   ///< ~/.local/state

}  // namespace encore::app
