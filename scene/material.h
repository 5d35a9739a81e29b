#pragma once

#include "scene/texture.h"

#include <glm/vec3.hpp>

#include <memory>
#include <string>

namespace encore::scene {

/// Phong material, and what a Whitted ray tracer (1980) makes of it; the names in brackets are
/// those of Wavefront's MTL. Where reflected and refracted rays are traced, the share
/// `reflectivity` of the light is mirrored, of the rest 1 - `opacity` goes on as in clear glass
/// (renderer/paths/scatter.h), and what remains is Phong's.
struct Material {
  std::string name;
  glm::vec3 diffuse{0.7F};           ///< Kd
  glm::vec3 specular{0.0F};          ///< Ks
  glm::vec3 ambient{0.1F};           ///< Ka, in [0, 1]
  glm::vec3 emission{0.0F};          ///< Ke
  float shininess = 32.0F;           ///< Ns, the Phong exponent
  float opacity = 1.0F;              ///< d, or 1 - Tr
  float index_of_refraction = 1.0F;  ///< Ni
  float reflectivity = 0.0F;         ///< share of light mirrored, in [0, 1]
  int illumination_model = 2;        ///< illum
  /// map_Kd: multiplies the diffuse colour; null: none.
  std::shared_ptr<const Texture> diffuse_texture{};
};

}  // namespace encore::scene
