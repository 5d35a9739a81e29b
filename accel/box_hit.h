#pragma once

#include "accel/tolerance.h"
#include "scene/ray.h"

#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

namespace encore::accel {

/// 1 / component of a direction, for the distances of planes: +-inf for a zero of that sign. NaN
/// for a component that is not zero but so small or large that its reciprocal leaves the normal
/// range, so that its planes have no distances and never exclude anything.
inline float plane_inverse(float component) {
  const float inverse = 1.0F / component;
  return component == 0.0F || std::isnormal(inverse) ? inverse
                                                     : std::numeric_limits<float>::quiet_NaN();
}

/// A ray prepared for plane and box tests.
struct BoxRay {
  glm::vec3 origin;
  glm::vec3 inverse;  ///< plane_inverse() of the direction
  /// 1 where the direction (its sign bit) is negative: the upper plane is then met first.
  int negative[3];

  explicit BoxRay(const scene::Ray& ray)
      : origin(ray.origin),
        inverse(plane_inverse(ray.direction.x), plane_inverse(ray.direction.y),
                plane_inverse(ray.direction.z)),
        negative{std::signbit(ray.direction.x), std::signbit(ray.direction.y),
                 std::signbit(ray.direction.z)} {}
};

/// The stretch of a ray inside a closed box, conservatively: widened so that rounding can never
/// turn a box that the exact ray meets into a miss (Ize 2013).
struct BoxStretch {
  float enter;  ///< >= t_min of the caller
  float leave;  ///< <= t_max of the caller
  [[nodiscard]] bool hit() const { return enter * kNarrow <= leave * kWiden; }
};

/// Slab test of a closed box over t in [t_min, t_max], both >= 0. A ray that runs inside a face
/// (direction 0, origin on the plane) gives 0 * inf = NaN there, which the comparisons drop: it
/// counts as inside; so does every plane of an axis whose component has no plane_inverse().
/// Monotone: a box that contains another never gives a shorter stretch.
inline BoxStretch box_stretch(const glm::vec3& min, const glm::vec3& max, const BoxRay& ray,
                              float t_min, float t_max) {
  float enter = t_min;
  float leave = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const float near_plane = ray.negative[axis] ? max[axis] : min[axis];
    const float far_plane = ray.negative[axis] ? min[axis] : max[axis];
    const float near_t = (near_plane - ray.origin[axis]) * ray.inverse[axis];
    const float far_t = (far_plane - ray.origin[axis]) * ray.inverse[axis];
    enter = near_t > enter ? near_t : enter;
    leave = far_t < leave ? far_t : leave;
  }
  return {enter, leave};
}

}  // namespace encore::accel
