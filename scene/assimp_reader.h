#pragma once

#include "scene/model_packing.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace encore::scene {

/// Reads a file with Assimp in this process: node transforms applied, meshes merged in the order of
/// the node tree, polygons triangulated by us, equal vertices joined. Crashes where Assimp crashes,
/// which it does on broken files: call it in a child process only. Problems go to `error` without
/// the file's name. Not yet finished by finish_model.
PackedModel import_with_assimp(const std::filesystem::path& path);

/// The same from memory; `extension` (as in ".3ds") picks the importer. Files that the model refers
/// to (separate glTF buffers) cannot be found this way.
PackedModel import_with_assimp(std::string_view bytes, const std::string& extension);

}  // namespace encore::scene
