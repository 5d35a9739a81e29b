#pragma once

#include "scene/camera.h"

#include <glm/vec3.hpp>

namespace encore::scene {

/// The directions of a camera's picture, each of unit length and at right angles to the others. In
/// double precision: squares of float coordinates neither overflow nor vanish.
struct CameraBasis {
  glm::dvec3 forward{0.0, 0.0, -1.0};
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
};

/// If `camera.up` is zero or parallel to the view (to within 1e-6 rad), the coordinate axis that is
/// most nearly at right angles to the view takes its place; of equal ones y before z before x.
/// Eye and target must differ and all coordinates be finite.
CameraBasis camera_basis(const Camera& camera);

/// tan(fov / 2): half the height of a perspective picture at distance 1.
double half_height_at_one(const Camera& camera);

/// How many world units the picture's height spans at the target's depth, in either projection.
double picture_height_at_target(const Camera& camera);

}  // namespace encore::scene
