#pragma once

#include "scene/model.h"

#include <string>
#include <string_view>

namespace encore::scene {

/// Reads a PLY file (ASCII, binary of either byte order, format 1.0) from memory: vertices with
/// normals, colours and texture coordinates, faces of any number of corners, triangle strips.
/// Elements may come in any order, other elements and properties are skipped. Coordinates are
/// exact. Vertices that no triangle uses are left out. Data behind the last element is a warning.
///
/// This reader is ours because Assimp 5.2.5 could not be guarded: on truncated binary files it
/// crashes or makes triangles up, it reads triangle strips as one face, turns NaN and bad indices
/// into vertex 0 without a word and stores what the header declares before looking at the data.
/// Here nothing is stored that the rest of the file could not hold.
///
/// Throws InputError ("name:line: ...") for what is no PLY, broken or truncated.
Model read_ply(std::string_view file, const std::string& name);

/// Whether the bytes start as a PLY file must.
bool is_ply(std::string_view file);

}  // namespace encore::scene
