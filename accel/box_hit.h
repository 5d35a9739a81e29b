#pragma once

#include "accel/tolerance.h"
#include "scene/ray.h"

#include <glm/vec3.hpp>

#include <cmath>

namespace encore::accel {

/// A ray prepared for plane and box tests.
struct BoxRay {
  glm::vec3 origin;
  glm::vec3 inverse;  ///< 1 / direction, +-inf where a component is 0 or too small to invert
  /// 1 where the direction (its sign bit) is negative: the upper plane is then met first.
  int negative[3];

  explicit BoxRay(const scene::Ray& ray)
      : origin(ray.origin),
        inverse(1.0F / ray.direction.x, 1.0F / ray.direction.y, 1.0F / ray.direction.z),
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
/// counts as inside. Monotone: a box that contains another never gives a shorter stretch.
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
