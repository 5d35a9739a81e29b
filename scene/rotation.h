#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace encore::scene {

/// A rotation as a unit quaternion, in double and from portable_math only, so that poses are the
/// same bit for bit on every machine.
struct Rotation {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// Right-handed rotation around `axis` (any length; a zero axis gives no rotation).
Rotation rotation_around(const glm::vec3& axis, double degrees);

/// Spherical interpolation along the shorter arc; `u` in [0, 1].
Rotation slerp(const Rotation& a, const Rotation& b, double u);

glm::dmat3 rotation_matrix(const Rotation& q);

/// The matrix of rotation_around; exact for multiples of 90 degrees around a coordinate axis.
glm::dmat3 axis_angle_matrix(const glm::vec3& axis, double degrees);

/// `v` at length 1, or zero if it has no usable length; in double, so tiny and huge vectors work.
glm::dvec3 unit_or_zero(const glm::vec3& v);

}  // namespace encore::scene
