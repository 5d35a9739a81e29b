#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string_view>

namespace encore::scene {

/// Parses the original system's text scenes: one command a line, `*` starts a comment.
/// Commands: CAMERA, BACKGROUND_COLOR, LIGHT, POINT_LIGHT, RECT_LIGHT, MATERIAL, SPHERE, MODEL,
/// DYNAMIC; details and what has no counterpart (a warning with its line): docs/scene-format.md.
/// Models are looked up at their path relative to `folder`, then by path and by bare file name
/// below each entry of the search path. Throws InputError with file:line.
Scene parse_classic_scene(std::string_view text, const std::string& file_name,
                          const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& search_path = {});

}  // namespace encore::scene
