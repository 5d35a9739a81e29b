#pragma once

#include "scene/model.h"
#include "scene/model_cleanup.h"

#include <string>
#include <string_view>

namespace encore::scene {

/// What one process hands to another on the same machine: a model before finish_model, what was
/// dropped from it, and, if it could not be read at all, why.
struct PackedModel {
  Model model;
  Dropped dropped;
  std::string error;
};

std::string pack_model(const PackedModel& packed);

/// The reverse. Returns false if the bytes are no whole packed model. Sizes are checked, values are
/// not: indices may be out of range.
bool unpack_model(std::string_view bytes, PackedModel& packed);

}  // namespace encore::scene
