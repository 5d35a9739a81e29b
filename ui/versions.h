#pragma once

#include <string>
#include <utility>
#include <vector>

namespace encore::ui {

/// What the program is made of and on: a name and a version each.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace encore::ui
