#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace encore::scene {

/// Scale, then rotate (right-handed, around an axis through the origin), then move.
struct Transform {
  glm::vec3 translation{0.0F};
  glm::vec3 rotation_axis{0.0F, 1.0F, 0.0F};  ///< need not be normalised
  float rotation_degrees = 0.0F;
  glm::vec3 scale{1.0F};

  [[nodiscard]] glm::mat4 matrix() const;
};

}  // namespace encore::scene
