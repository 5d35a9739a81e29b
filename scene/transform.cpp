#include "scene/transform.h"

#include "scene/rotation.h"

namespace encore::scene {

glm::mat4 Transform::matrix() const {
  const glm::dmat3 rotation = axis_angle_matrix(rotation_axis, rotation_degrees);
  return {glm::vec4(glm::vec3(rotation[0] * double(scale.x)), 0.0F),
          glm::vec4(glm::vec3(rotation[1] * double(scale.y)), 0.0F),
          glm::vec4(glm::vec3(rotation[2] * double(scale.z)), 0.0F), glm::vec4(translation, 1.0F)};
}

}  // namespace encore::scene
