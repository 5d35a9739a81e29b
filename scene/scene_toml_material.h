#pragma once

#include "scene/assets.h"
#include "scene/material.h"
#include "scene/toml_reading.h"

#include <map>
#include <string>

namespace encore::scene {

/// The materials of a scene file by name.
using NamedMaterials = std::map<std::string, Material, std::less<>>;

/// Reads the keys of a material that stand in `table`, and warns about unknown ones; what is absent
/// keeps its default. `texture` is a picture file or "checker", which `texture_colors` (two) and
/// `texture_cells` describe. Throws InputError at the key that is wrong.
Material read_material(TomlTable& table, Assets& assets, Warnings& warnings);

}  // namespace encore::scene
