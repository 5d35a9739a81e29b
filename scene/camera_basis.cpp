#include "scene/camera_basis.h"

#include "scene/portable_math.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace encore::scene {

namespace {

/// `up` at unit length, or an axis in its place if it cannot tell what is up for this view.
glm::dvec3 usable_up(const glm::dvec3& forward, const glm::dvec3& wanted) {
  constexpr double kSmallestSine = 1e-6;
  const double length = std::sqrt(glm::dot(wanted, wanted));
  if (length > 0.0) {
    const glm::dvec3 up = wanted / length;
    const glm::dvec3 side = glm::cross(forward, up);
    if (std::sqrt(glm::dot(side, side)) > kSmallestSine) return up;
  }
  const glm::dvec3 size = glm::abs(forward);
  if (size.y <= size.x && size.y <= size.z) return {0.0, 1.0, 0.0};
  return size.z <= size.x ? glm::dvec3{0.0, 0.0, 1.0} : glm::dvec3{1.0, 0.0, 0.0};
}

}  // namespace

CameraBasis camera_basis(const Camera& camera) {
  CameraBasis basis;
  const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.eye);
  basis.forward = view / std::sqrt(glm::dot(view, view));
  const glm::dvec3 side =
      glm::cross(basis.forward, usable_up(basis.forward, glm::dvec3(camera.up)));
  basis.right = side / std::sqrt(glm::dot(side, side));
  basis.up = glm::cross(basis.right, basis.forward);
  return basis;
}

double half_height_at_one(const Camera& camera) {
  const double half_angle = 0.5 * static_cast<double>(camera.vertical_fov_degrees);
  return portable_sin_degrees(half_angle) / portable_cos_degrees(half_angle);
}

double picture_height_at_target(const Camera& camera) {
  if (camera.orthographic()) return camera.orthographic_height;
  const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.eye);
  return 2.0 * half_height_at_one(camera) * std::sqrt(glm::dot(view, view));
}

}  // namespace encore::scene
