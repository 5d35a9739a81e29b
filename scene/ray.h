#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>

namespace encore::scene {

/// A ray: points origin + t * direction with t_min < t <= t_max. The direction need not be
/// normalised (t counts in its lengths) but must be finite and not all zero.
struct Ray {
  glm::vec3 origin{0.0F};
  float t_min = 0.0F;
  glm::vec3 direction{0.0F, 0.0F, -1.0F};
  float t_max = std::numeric_limits<float>::infinity();
};

inline constexpr std::uint32_t kNoHit = 0xFFFFFFFFU;

/// The nearest hit of a ray. `u` and `v` are the barycentric weights of the triangle's second and
/// third vertex. A miss has triangle == kNoHit and t equal to the ray's t_max.
struct Hit {
  float t = std::numeric_limits<float>::infinity();
  std::uint32_t triangle = kNoHit;
  float u = 0.0F;
  float v = 0.0F;

  [[nodiscard]] bool found() const { return triangle != kNoHit; }
};

}  // namespace encore::scene
