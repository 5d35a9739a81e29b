#pragma once

#include <glm/vec3.hpp>

namespace encore::scene {

/// A point light without falloff, as the thesis' Phong model uses it.
struct Light {
  glm::vec3 position{0.0F, 0.0F, 30.0F};
  glm::vec3 color{1.0F};
};

}  // namespace encore::scene
