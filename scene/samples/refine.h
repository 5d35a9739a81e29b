#pragma once

#include "scene/mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Refinement of meshes, which is how a sample scene comes to its exact number of triangles.
namespace encore::scene::samples {

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFU;

/// An edge between two vertices (a < b) and the triangles on its two sides; on a boundary the
/// second one is kNoTriangle. Surfaces with more than two triangles at an edge are not for this.
struct Edge {
  std::uint32_t a;
  std::uint32_t b;
  std::uint32_t triangle[2];
};

/// All edges of a mesh, and the three of each triangle: edge k joins corners k and (k + 1) % 3.
struct EdgeTable {
  std::vector<Edge> edges;
  std::vector<glm::uvec3> of_triangle;
};
EdgeTable find_edges(const Mesh& mesh);

/// Splits the longest edges in the middle until the mesh has exactly `target` triangles. An edge
/// inside adds two and keeps a closed mesh closed; an edge at a boundary adds one, which a mesh
/// with an odd remainder needs. Materials are inherited; normals and colours dropped. Throws
/// std::logic_error if the mesh already has more, or the remainder is odd and nothing is open.
void split_to(Mesh& mesh, std::size_t target);

/// One step of Loop's subdivision (with Warren's weights): every triangle becomes four and the
/// surface smoother; open boundaries become smooth curves. Normals and colours are dropped.
Mesh subdivide(const Mesh& mesh);

}  // namespace encore::scene::samples
