#include "scene/placement.h"

#include "scene/triangle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace encore::scene {
namespace {

glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

float rounded(double x) {
  // Outside of float's range the conversion would be undefined: say infinity.
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (x > kLargest) return std::numeric_limits<float>::infinity();
  if (x < -kLargest) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(x);
}

glm::vec3 rounded(const glm::dvec3& v) {
  return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

}  // namespace

PointTransform::PointTransform(const glm::mat4& matrix)
    : linear_(glm::dvec3(matrix[0]), glm::dvec3(matrix[1]), glm::dvec3(matrix[2])),
      offset_(matrix[3]) {
  // The cofactor matrix is the inverse transpose times the determinant; it exists for flat scalings
  // too. Its sign is taken back for mirrored ones, its size is of no use and scaled away.
  normal_ = {cross(linear_[1], linear_[2]), cross(linear_[2], linear_[0]),
             cross(linear_[0], linear_[1])};
  const double determinant =
      linear_[0].x * normal_[0].x + linear_[0].y * normal_[0].y + linear_[0].z * normal_[0].z;
  double largest = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      largest = std::max(largest, std::fabs(normal_[column][row]));
    }
  }
  if (largest > 0.0 && std::isfinite(largest))
    normal_ *= (determinant < 0.0 ? -1.0 : 1.0) / largest;
}

glm::vec3 PointTransform::operator()(const glm::vec3& p) const {
  const glm::dvec3 d(p);
  return rounded(linear_[0] * d.x + linear_[1] * d.y + linear_[2] * d.z + offset_);
}

glm::vec3 PointTransform::normal(const glm::vec3& n) const {
  const glm::dvec3 d(n);
  return rounded(normal_[0] * d.x + normal_[1] * d.y + normal_[2] * d.z);
}

Bounds bounds_of_used(const Mesh& mesh, std::span<const glm::vec3> positions) {
  Bounds b;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3& p = positions[t[corner]];
      if (is_finite(p)) b.extend(p);
    }
  }
  return b;
}

Bounds bounds_under(const Mesh& mesh, const glm::mat4& transform) {
  // Once a vertex, not once a corner: there are six corners to a vertex.
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = 1;
  const PointTransform to_world(transform);
  Bounds b;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    const glm::vec3 p = to_world(mesh.positions[i]);
    if (is_finite(p)) b.extend(p);
  }
  return b;
}

glm::mat4 fit_matrix(const Bounds& bounds, float size) {
  if (bounds.empty()) return glm::mat4(1.0F);
  const glm::dvec3 low(bounds.min);
  const glm::dvec3 high(bounds.max);
  const glm::dvec3 sides = high - low;
  const double longest = std::max({sides.x, sides.y, sides.z});
  double scale = longest > 0.0 ? double(size) / longest : 1.0;
  // A model smaller than the smallest normal number would need an infinite scale.
  scale = std::min(scale, double(std::numeric_limits<float>::max()));
  const glm::dvec3 offset = (low + high) * (-0.5 * scale);
  return {glm::vec4(rounded(scale), 0.0F, 0.0F, 0.0F), glm::vec4(0.0F, rounded(scale), 0.0F, 0.0F),
          glm::vec4(0.0F, 0.0F, rounded(scale), 0.0F), glm::vec4(rounded(offset), 1.0F)};
}

}  // namespace encore::scene
