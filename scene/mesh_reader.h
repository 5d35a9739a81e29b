#pragma once

#include "scene/model.h"
#include "scene/texture_reader.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace encore::scene {

/// Reads any supported model file by its content and, where that does not tell, its extension: OBJ
/// through read_obj; PLY (ASCII, little and big endian, n-gons, triangle strips, normals, colours)
/// through read_ply; 3DS, glTF, STL and whatever else supported_extensions() names through Assimp.
/// Node transforms are applied, meshes merged, n-gons triangulated. Triangles with non-finite
/// coordinates or bad indices are dropped and counted in a warning.
/// Diffuse textures are read where a mesh has texture coordinates, and shared through `textures`,
/// if one is given; one that cannot be had, and those within the model file, are warnings.
/// Throws InputError for a missing, empty (zero bytes), truncated or unrecognised file.
Model read_model(const std::filesystem::path& path, TextureSet* textures = nullptr);

/// The part of read_model for what is not OBJ, from memory; `extension` as in ".3ds", `name` starts
/// the messages. Assimp runs in a child process with limits on memory and time, because it crashes
/// on broken files; such a crash is an InputError here. ".ply" goes to read_ply (which says why)
/// and
/// ".obj" to read_obj without material files. Textures are not looked up.
Model read_with_assimp(std::span<const std::byte> bytes, const std::string& extension,
                       const std::string& name);

/// Extensions that read_model accepts, for messages and file dialogs, each with its dot and in
/// lower case. These are the formats of surfaces that load without a crash from the test models of
/// Assimp 5.2.5 as Debian packages them. Left out on purpose: motion capture and terrain (no
/// meshes), formats that nothing proves, and extensions with many meanings (raw, xml, mdl, scn).
std::vector<std::string> supported_extensions();

}  // namespace encore::scene
