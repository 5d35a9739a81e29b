#pragma once

#include "scene/ray.h"
#include "scene/triangle.h"
#include "tests/support/random_triangles.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace encore::accel::test {

using encore::test::bounds_of_all;
using encore::test::Random;
using encore::test::scaled;
using glm::vec3;
using scene::Hit;
using scene::Ray;
using scene::Triangle;

/// Triangles of about `size` in the cube [-1, 1]^3.
inline std::vector<Triangle> soup(std::size_t count, float size, std::uint32_t seed) {
  return encore::test::triangle_soup(count, size, 1.0F, seed);
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

/// Rays that start `distance` (in box sizes) from the middle and aim into the box.
inline std::vector<Ray> rays_at(const scene::Bounds& box, float distance, std::size_t count,
                                std::uint32_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  const vec3 half = box.size() * 0.5F;
  const float reach = std::max(half.x, std::max(half.y, half.z));
  while (rays.size() < count) {
    const vec3 origin = box.center() + random.point(1.0F) * (reach * distance);
    const vec3 target = box.center() + random.point(1.0F) * half;
    const vec3 direction = target - origin;
    if (direction == vec3(0.0F)) continue;
    rays.push_back(Ray{.origin = origin, .direction = direction});
  }
  return rays;
}

}  // namespace encore::accel::test
