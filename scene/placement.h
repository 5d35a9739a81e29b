#pragma once

#include "scene/bounds.h"
#include "scene/mesh.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <span>

namespace encore::scene {

/// The longest side that the thesis' models are scaled to (section 5.2).
inline constexpr float kThesisSize = 27.0F;

/// Applies an affine matrix in double and rounds once, so that a model far from its origin loses
/// nothing on the way; what does not fit a float becomes infinite.
class PointTransform {
 public:
  explicit PointTransform(const glm::mat4& matrix);

  [[nodiscard]] glm::vec3 operator()(const glm::vec3& p) const;
  /// A normal, by the inverse transpose (up to a positive factor; not normalised).
  [[nodiscard]] glm::vec3 normal(const glm::vec3& n) const;

 private:
  glm::dmat3 linear_;
  glm::dmat3 normal_;
  glm::dvec3 offset_;
};

/// Bounds of the vertices that triangles use, as far as they are finite. `positions` are the
/// mesh's vertices, moved or not.
Bounds bounds_of_used(const Mesh& mesh, std::span<const glm::vec3> positions);

/// Bounds of a mesh's used vertices under a transform.
Bounds bounds_under(const Mesh& mesh, const glm::mat4& transform);

/// Centres a box at the origin and scales its longest side to `size`; an empty box is left alone, a
/// point only centred.
glm::mat4 fit_matrix(const Bounds& bounds, float size);

}  // namespace encore::scene
