#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string_view>

namespace encore::scene {

/// Loads a scene by what the argument is: the name of a sample scene, a scene file (*.toml), the
/// original system's text scene (*.txt, see classic_scene_file.h), a bare model file, which is
/// placed as the thesis did (see place_model), or else the name of a scene file that ships with the
/// program (assets/scenes, see shipped_files.h). Throws InputError. A LoadScope (load_watch.h)
/// shows how far it is and may end it by LoadCancelled.
Scene load_scene(const std::string& name_or_path,
                 const std::vector<std::filesystem::path>& search_path = {});

/// Parses a scene file; relative paths in it start at `folder`, then go through the search path.
/// Format: docs/scene-format.md.
Scene parse_scene_toml(std::string_view text, const std::string& file_name,
                       const std::filesystem::path& folder,
                       const std::vector<std::filesystem::path>& search_path = {});

/// A scene around one bare model: centred at the origin, its longest side scaled to 27 units, which
/// fills about 70 % of the window for the default camera (the thesis' section 5.2), one white point
/// light at the camera.
Scene place_model(Model model);

}  // namespace encore::scene
