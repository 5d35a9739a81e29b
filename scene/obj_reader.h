#pragma once

#include "scene/model.h"
#include "scene/texture_reader.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace encore::scene {

/// Reads a Wavefront OBJ file and its MTL files with tinyobjloader. N-gons (also concave ones) are
/// triangulated, negative indices resolved, and vertices that share position, normal and texture
/// coordinate merged. A missing or broken MTL or texture is a warning; textures are read if there
/// are texture coordinates to go with them, and shared through `textures`, if one is given.
/// Triangles with indices out of range or non-finite coordinates are dropped and counted in a
/// warning. An OBJ without faces is a valid, empty model. Throws InputError ("path: ...") if the
/// file cannot be read or is not OBJ at all.
Model read_obj(const std::filesystem::path& path, TextureSet* textures = nullptr);

/// The same from memory; `mtl_folder` may be empty (no material files are then looked up).
Model read_obj(std::string_view text, const std::string& name,
               const std::filesystem::path& mtl_folder, TextureSet* textures = nullptr);

}  // namespace encore::scene
