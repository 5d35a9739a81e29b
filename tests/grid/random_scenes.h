#pragma once

#include "scene/ray.h"
#include "scene/triangle.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace encore::accel::test {

using glm::vec3;
using scene::Hit;
using scene::Ray;
using scene::Triangle;

/// Seeded random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  /// In [0, 1), a multiple of 2^-24.
  float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24F; }
  float between(float low, float high) { return low + (high - low) * unit(); }
  std::uint32_t below(std::uint32_t n) { return engine_() % n; }
  vec3 in_box(float half) {
    const float x = between(-half, half);
    const float y = between(-half, half);
    const float z = between(-half, half);
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

/// Triangles of about `size` in the cube [-1, 1]^3.
inline std::vector<Triangle> soup(std::size_t count, float size, std::uint32_t seed) {
  Random random(seed);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const vec3 center = random.in_box(1.0F);
    const vec3 a = center + random.in_box(size);
    const vec3 b = center + random.in_box(size);
    const vec3 c = center + random.in_box(size);
    triangles.push_back(scene::make_triangle(a, b, c));
  }
  return triangles;
}

inline std::vector<Triangle> scaled(std::vector<Triangle> triangles, const vec3& scale,
                                    const vec3& shift = vec3(0.0F)) {
  for (Triangle& t : triangles) {
    t.v0 = t.v0 * scale + shift;
    t.v1 = t.v1 * scale + shift;
    t.v2 = t.v2 * scale + shift;
  }
  return triangles;
}

/// A height field over [-1, 1]^2 with 2 * n * n triangles that share their vertices exactly.
inline std::vector<Triangle> terrain(int n, float height, std::uint32_t seed) {
  Random random(seed);
  std::vector<vec3> points;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      points.emplace_back(2.0F * static_cast<float>(x) / static_cast<float>(n) - 1.0F,
                          2.0F * static_cast<float>(y) / static_cast<float>(n) - 1.0F,
                          height * (random.unit() - 0.5F));
    }
  }
  std::vector<Triangle> triangles;
  const auto at = [&](int x, int y) { return points[static_cast<std::size_t>(y * (n + 1) + x)]; };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      triangles.push_back(scene::make_triangle(at(x, y), at(x + 1, y), at(x, y + 1)));
      triangles.push_back(scene::make_triangle(at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)));
    }
  }
  return triangles;
}

inline scene::Bounds bounds_of_all(const std::vector<Triangle>& triangles) {
  scene::Bounds bounds;
  for (const Triangle& t : triangles) bounds.extend(scene::bounds_of(t));
  return bounds;
}

/// Rays that start `distance` (in box sizes) from the middle and aim into the box.
inline std::vector<Ray> rays_at(const scene::Bounds& box, float distance, std::size_t count,
                                std::uint32_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  const vec3 half = box.size() * 0.5F;
  const float reach = std::max(half.x, std::max(half.y, half.z));
  while (rays.size() < count) {
    const vec3 origin = box.center() + random.in_box(1.0F) * (reach * distance);
    const vec3 target = box.center() + random.in_box(1.0F) * half;
    const vec3 direction = target - origin;
    if (direction == vec3(0.0F)) continue;
    rays.push_back(Ray{.origin = origin, .direction = direction});
  }
  return rays;
}

}  // namespace encore::accel::test
