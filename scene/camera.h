#pragma once

#include <glm/vec3.hpp>

namespace encore::scene {

/// A pinhole camera, or with `orthographic_height` one whose rays all run along the view. The
/// default is the thesis' (section 5.2): at (0, 0, 25), looking along -z with a full vertical field
/// of view of 90 degrees.
struct Camera {
  glm::vec3 eye{0.0F, 0.0F, 25.0F};
  glm::vec3 target{0.0F, 0.0F, 0.0F};
  glm::vec3 up{0.0F, 1.0F, 0.0F};
  float vertical_fov_degrees = 90.0F;  ///< in (0, 180); not looked at in orthographic views
  /// 0: perspective; else the world units that the picture's height spans, and all rays run along
  /// the view. They start on the plane through the eye at right angles to it, so that what lies
  /// behind the eye is not seen, as in perspective.
  float orthographic_height = 0.0F;

  [[nodiscard]] bool orthographic() const { return orthographic_height != 0.0F; }

  /// Value by value.
  friend bool operator==(const Camera&, const Camera&) = default;
};

}  // namespace encore::scene
