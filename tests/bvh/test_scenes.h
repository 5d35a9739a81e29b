#pragma once

#include "scene/triangle.h"
#include "tests/support/random_triangles.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace encore::accel::test {

using encore::test::Random;
using encore::test::scaled;
using glm::vec3;
using scene::make_triangle;
using scene::Triangle;
using Triangles = std::vector<Triangle>;

/// Triangles of about `size` in the cube [-10, 10]^3.
inline Triangles soup(std::size_t count, float size, std::uint32_t seed) {
  return encore::test::triangle_soup(count, size, 10.0F, seed);
}

inline Triangles identical(std::size_t count) {
  return Triangles(count, make_triangle({0, 0, 0}, {1, 0, 0.5F}, {0, 1, 0.25F}));
}

/// Flat squares of two triangles on whole numbers: all planes shared, all boxes without height.
inline Triangles floor_tiles(int side) {
  Triangles triangles;
  for (int i = 0; i < side * side; ++i) {
    const vec3 at(static_cast<float>(i % side), 0, static_cast<float>(i / side));
    triangles.push_back(make_triangle(at, at + vec3(1, 0, 0), at + vec3(1, 0, 1)));
    triangles.push_back(make_triangle(at, at + vec3(1, 0, 1), at + vec3(0, 0, 1)));
  }
  return triangles;
}

/// Long thin triangles in all directions.
inline Triangles needles(std::size_t count, std::uint32_t seed) {
  Random random(seed);
  Triangles triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const vec3 a = random.point(10.0F);
    triangles.push_back(make_triangle(a, random.point(10.0F), a + random.point(0.001F)));
  }
  return triangles;
}

/// Triangle k stands at 2^-k and is about as large, on the axes in turn.
inline Triangles geometric_series(int count) {
  Triangles triangles;
  for (int k = 0; k < count; ++k) {
    const float s = std::ldexp(1.0F, -k / 3);
    vec3 at(0.0F);
    at[k % 3] = s;
    triangles.push_back(
        make_triangle(at, at + s * vec3(0.5F, 0.25F, 0.125F), at + s * vec3(0.125F, 0.5F, 0.25F)));
  }
  return triangles;
}

/// Triangle k begins exactly where the median falls once those before it are gone: each spatial
/// split takes a single triangle away, so nothing but a limit keeps the tree from `count` levels.
inline Triangles one_a_level(int count) {
  Triangles triangles;
  const float step = 0x1p-10F;
  for (int k = 0; k < count; ++k) {
    const float end = 1.0F - static_cast<float>(k) * step;
    triangles.push_back(make_triangle({end / 2, 0, 0}, {end, 0, 1}, {end, 1, 0}));
  }
  triangles.push_back(make_triangle({0, 0, 0}, {step, 0, 1}, {step, 1, 0}));
  return triangles;
}

/// Small triangles inside a few that span everything.
inline Triangles giants_and_dwarfs(std::size_t count, std::uint32_t seed) {
  Triangles triangles = soup(count, 0.01F, seed);
  for (const float z : {-10.0F, 0.0F, 10.0F}) {
    triangles.push_back(make_triangle({-40, -40, z}, {40, -40, -z}, {0, 60, z}));
  }
  return triangles;
}

/// Every triangle of `base` three times: equal distances everywhere.
inline Triangles thrice(Triangles base) {
  const Triangles once = base;
  for (int i = 0; i < 2; ++i) base.insert(base.end(), once.begin(), once.end());
  return base;
}

struct NamedTriangles {
  std::string name;
  Triangles triangles;
};

inline std::vector<NamedTriangles> all_test_scenes() {
  return {
      {"nothing", {}},
      {"one", soup(1, 1.0F, 1)},
      {"two", soup(2, 1.0F, 2)},
      {"three", soup(3, 1.0F, 3)},
      {"soup", soup(1500, 1.0F, 4)},
      {"large overlapping", soup(300, 10.0F, 5)},
      {"identical", identical(100)},
      {"floor", floor_tiles(16)},
      {"needles", needles(400, 6)},
      {"geometric series", geometric_series(75)},
      {"one a level", one_a_level(500)},
      {"giants and dwarfs", giants_and_dwarfs(600, 7)},
      {"thrice", thrice(soup(200, 2.0F, 8))},
      {"points", scaled(soup(50, 1.0F, 9), 0.0F)},
      {"huge", scaled(soup(400, 1.0F, 10), 0x1p57F)},
      {"tiny", scaled(soup(400, 1.0F, 11), 0x1p-63F)},
  };
}

}  // namespace encore::accel::test
