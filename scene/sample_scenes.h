#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

/// A procedural scene that ships with the program: one a row of the thesis' Table 2, with exactly
/// its triangle count. Seeded and built from IEEE basic operations only, so bit-identical
/// everywhere.
struct SampleScene {
  std::string name;         ///< what the command line takes
  std::string thesis_name;  ///< the row of Table 2 it stands for
  std::uint64_t triangles;  ///< at time 0
  std::string animation;    ///< "static", "rigid parts", "deforming", "changing count"
  std::string description;
};

/// The default scene of every command (11,141 triangles).
inline constexpr std::string_view kDefaultSceneName = "toys";

const std::vector<SampleScene>& sample_scenes();

/// Builds a sample scene by name; nothing if there is none of that name. Followed by load_watch.h.
std::optional<Scene> make_sample_scene(std::string_view name);

}  // namespace encore::scene
