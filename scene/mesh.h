#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace encore::scene {

/// An indexed triangle mesh in its own (model) space.
/// `normals`, `texcoords` and `colors` are either empty or one a position.
/// `material_of` is either empty (all 0) or one index a triangle into the owning model's materials.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texcoords;
  std::vector<glm::vec3> colors;
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> material_of;
};

}  // namespace encore::scene
