#pragma once

#include "scene/assets.h"
#include "scene/scene.h"
#include "scene/toml_reading.h"

#include <map>
#include <string>

namespace encore::scene {

/// The materials of a scene file by name.
using NamedMaterials = std::map<std::string, Material, std::less<>>;

/// Reads the keys of a material that stand in `table`, and warns about unknown ones; what is absent
/// keeps `material`'s value.
Material read_material(TomlTable& table, Material material, Warnings& warnings);

/// Adds what one [[model]] table describes. Throws InputError at the key that is wrong.
void read_model_table(TomlTable& table, const NamedMaterials& materials, Assets& assets,
                      Scene& scene);

}  // namespace encore::scene
