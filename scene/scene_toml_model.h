#pragma once

#include "scene/assets.h"
#include "scene/scene.h"
#include "scene/scene_toml_material.h"
#include "scene/toml_reading.h"

namespace encore::scene {

/// Adds what one [[model]] table describes. Throws InputError at the key that is wrong.
void read_model_table(TomlTable& table, const NamedMaterials& materials, Assets& assets,
                      Scene& scene);

}  // namespace encore::scene
