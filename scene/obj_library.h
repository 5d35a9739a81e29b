#pragma once

#include <cstddef>
#include <filesystem>

namespace encore::scene {

/// Reads an OBJ file by tinyobjloader alone, as its manual uses it, and keeps nothing: what a
/// reader that is built on that library is to be measured against. Returns the number of triangles;
/// 0 if the library cannot read it.
std::size_t count_obj_triangles(const std::filesystem::path& path);

}  // namespace encore::scene
