#pragma once

#include <glm/vec3.hpp>

namespace encore::scene {

/// A pinhole camera. The default is the thesis' (section 5.2): at (0, 0, 25), looking along -z with
/// a full vertical field of view of 90 degrees.
struct Camera {
  glm::vec3 eye{0.0F, 0.0F, 25.0F};
  glm::vec3 target{0.0F, 0.0F, 0.0F};
  glm::vec3 up{0.0F, 1.0F, 0.0F};
  float vertical_fov_degrees = 90.0F;  ///< in (0, 180)
};

}  // namespace encore::scene
