#pragma once

#include "scene/bounds.h"
#include "scene/triangle.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace encore::test {

/// Seeded random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  /// In [0, 1), a multiple of 2^-24.
  float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24F; }
  float between(float low, float high) { return low + (high - low) * unit(); }
  std::uint32_t below(std::uint32_t count) { return engine_() % count; }
  /// In the cube [-half, half)^3.
  glm::vec3 point(float half) {
    const float x = between(-half, half);
    const float y = between(-half, half);
    const float z = between(-half, half);
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

/// Triangles of about `size` around points of the cube [-half, half)^3.
inline std::vector<scene::Triangle> triangle_soup(std::size_t count, float size, float half,
                                                  std::uint32_t seed) {
  Random random(seed);
  std::vector<scene::Triangle> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 center = random.point(half);
    const glm::vec3 a = center + random.point(size);
    const glm::vec3 b = center + random.point(size);
    const glm::vec3 c = center + random.point(size);
    triangles.push_back(scene::make_triangle(a, b, c));
  }
  return triangles;
}

/// Every vertex v moved to v * scale + shift.
inline std::vector<scene::Triangle> scaled(std::vector<scene::Triangle> triangles,
                                           const glm::vec3& scale,
                                           const glm::vec3& shift = glm::vec3(0.0F)) {
  for (scene::Triangle& t : triangles) {
    for (glm::vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v * scale + shift;
  }
  return triangles;
}

inline std::vector<scene::Triangle> scaled(std::vector<scene::Triangle> triangles, float factor) {
  return scaled(std::move(triangles), glm::vec3(factor));
}

inline scene::Bounds bounds_of_all(std::span<const scene::Triangle> triangles) {
  scene::Bounds bounds;
  for (const scene::Triangle& t : triangles) bounds.extend(scene::bounds_of(t));
  return bounds;
}

}  // namespace encore::test
