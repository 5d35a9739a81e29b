#pragma once

#include "scene/bounds.h"
#include "shaders/shared/gpu_types.h"

#include <cmath>

namespace encore::scene {

/// The one triangle type of the project: what the CPU intersects is what the GPU reads.
using gpu::Triangle;

inline Triangle make_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                              std::uint32_t material = 0) {
  return Triangle{a, material, b, 0, c, 0};
}

inline Bounds bounds_of(const Triangle& t) {
  return Bounds{glm::min(glm::min(t.v0, t.v1), t.v2), glm::max(glm::max(t.v0, t.v1), t.v2)};
}

inline bool is_finite(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

inline bool is_finite(const Triangle& t) {
  return is_finite(t.v0) && is_finite(t.v1) && is_finite(t.v2);
}

/// Coordinates that rays can be traced among: beyond this the differences that plane tests take
/// leave single precision (accel/triangle_hit.h).
inline constexpr float kLargestCoordinate = 0x1p126F;

/// Whether every coordinate is a number (no NaN) and within kLargestCoordinate.
inline bool is_traceable(const Triangle& t) {
  const auto inside = [](const glm::vec3& p) {
    return std::fabs(p.x) <= kLargestCoordinate && std::fabs(p.y) <= kLargestCoordinate &&
           std::fabs(p.z) <= kLargestCoordinate;
  };
  return inside(t.v0) && inside(t.v1) && inside(t.v2);
}

}  // namespace encore::scene
