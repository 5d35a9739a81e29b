#pragma once

#include "scene/mesh.h"
#include "scene/model_cleanup.h"

#include <cstdint>
#include <span>
#include <vector>

namespace encore::scene {

/// The faces of a PLY file, gathered before it is known which vertices there are: faces may stand
/// before them.
class PlyFaces {
 public:
  /// A face with corners of any value and number.
  void add(std::span<const std::uint32_t> corners);
  /// Every second triangle of a strip turns the other way. Triangles with a repeated corner only
  /// stitch strips together.
  void add_strip(std::span<const std::uint32_t> strip);
  [[nodiscard]] bool empty() const { return triangles_.empty() && sizes_.empty(); }

  /// While all faces so far have three corners: where further ones may be put. Null after that.
  std::vector<glm::uvec3>* triangles_only() { return sizes_.empty() ? &triangles_ : nullptr; }

  /// Makes them triangles of `mesh`, which has its vertices already; what cannot be used is dropped
  /// and counted, its place as ": face 12". The faces are used up. Reports to load_watch.h.
  Dropped assemble(Mesh& mesh);

 private:
  std::vector<glm::uvec3> triangles_;   // the first faces, up to one that is no triangle
  std::vector<std::uint32_t> corners_;  // of those that follow
  std::vector<std::uint32_t> sizes_;    // number of corners of each
};

}  // namespace encore::scene
