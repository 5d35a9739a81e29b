#pragma once

#include "scene/mesh.h"
#include "scene/triangle.h"

#include <filesystem>
#include <span>

namespace encore::app::bench {

/// The triangles as a mesh whose equal corners are one vertex.
scene::Mesh indexed_mesh(std::span<const scene::Triangle> triangles);

// What the part loading reads, as other programs write it. These throw std::runtime_error if the
// file cannot be written.
void write_binary_ply(const std::filesystem::path& path, const scene::Mesh& mesh);
void write_ascii_ply(const std::filesystem::path& path, const scene::Mesh& mesh);
void write_obj(const std::filesystem::path& path, const scene::Mesh& mesh);

// What reading takes at least: the whole file, its numbers turned into an array of positions and
// one of indices, nothing checked. For the very files above; returns the number of triangles.
std::size_t parse_binary_ply(const std::filesystem::path& path);
std::size_t parse_ascii_ply(const std::filesystem::path& path);

}  // namespace encore::app::bench
