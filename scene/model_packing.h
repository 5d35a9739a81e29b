#pragma once

#include "scene/model.h"
#include "scene/model_cleanup.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace encore::scene {

/// What one process hands to another on the same machine: a model before finish_model, what was
/// dropped from it, and, if it could not be read at all, why. Textures travel by name only: each is
/// decoded in a process of its own (texture_reader.h).
struct PackedModel {
  Model model;
  Dropped dropped;
  std::string error;
  std::vector<std::string> textures{};  ///< one a material, as stated; empty: none
  std::uint64_t embedded_textures = 0;  ///< that lie within the file and are left out
};

std::string pack_model(const PackedModel& packed);

/// The reverse. Returns false if the bytes are no whole packed model. Sizes are checked, values are
/// not: indices may be out of range.
bool unpack_model(std::string_view bytes, PackedModel& packed);

}  // namespace encore::scene
