#include "accel/stability_shapes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::accel::stability {

using glm::vec3;
using scene::make_triangle;

namespace {

vec3 on_ball(const vec3& a, const vec3& b, const vec3& c, int i, int j, int n) {
  // Sums of whole numbers, so that both faces of an edge come to the same bits.
  const vec3 sum =
      a * static_cast<float>(n - i - j) + b * static_cast<float>(i) + c * static_cast<float>(j);
  const float length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  return sum / length;
}

Triangle small_at(const vec3& at, float size, Random& random) {
  const vec3 a = at + random.point(size);
  const vec3 b = at + random.point(size);
  const vec3 c = at + random.point(size);
  return make_triangle(a, b, c);
}

/// The side of a triangle when `count` of them are strewn over a cube of side 2.
float strewn_size(std::size_t count) {
  return 1.0F / std::cbrt(static_cast<float>(std::max<std::size_t>(count, 1)));
}

}  // namespace

vec3 Random::point(float half) {
  const float x = between(-half, half);
  const float y = between(-half, half);
  const float z = between(-half, half);
  return {x, y, z};
}

Triangles ball(std::size_t count, const vec3& centre, float radius) {
  const int n = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(count) / 8.0)));
  const std::array<vec3, 4> belt{vec3(1, 0, 0), vec3(0, 0, 1), vec3(-1, 0, 0), vec3(0, 0, -1)};
  Triangles triangles;
  for (int face = 0; face < 8; ++face) {
    const vec3 pole(0, face < 4 ? 1.0F : -1.0F, 0);
    const vec3 b = belt[static_cast<std::size_t>(face % 4)];
    const vec3 c = belt[static_cast<std::size_t>((face + 1) % 4)];
    const auto point = [&](int i, int j) { return centre + radius * on_ball(pole, b, c, i, j, n); };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        triangles.push_back(make_triangle(point(i, j), point(i + 1, j), point(i, j + 1)));
        if (i + j + 1 == n) continue;
        triangles.push_back(make_triangle(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)));
      }
    }
  }
  return triangles;
}

Triangles soup(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const float size = strewn_size(count);
  Triangles triangles(count);
  for (Triangle& t : triangles) t = small_at(random.point(1.0F), size, random);
  return triangles;
}

Triangles spanning(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Triangles triangles(count);
  for (Triangle& t : triangles) t = small_at(vec3(0.0F), 1.0F, random);
  return triangles;
}

Triangles needles(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Triangles triangles(count);
  for (Triangle& t : triangles) {
    // Near the origin in one place, so that a width of 10^-8 is there at all.
    const vec3 tip = random.point(1e-3F);
    t = make_triangle(tip, random.point(1.0F), tip + random.point(1e-8F));
  }
  return triangles;
}

Triangles corner_to_corner(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Triangles triangles(count);
  for (Triangle& t : triangles) {
    const vec3 from = vec3(-1.0F) + random.point(0.01F);
    t = make_triangle(from, vec3(1.0F) + random.point(0.01F), from + random.point(1e-4F));
  }
  return triangles;
}

Triangles without_area(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Triangles triangles = soup(count, seed + 1);
  for (std::size_t i = 0; i < count; ++i) {
    Triangle& t = triangles[i];
    if (i % 3 == 0) t.v1 = t.v2 = t.v0;
    if (i % 3 == 1) t.v2 = t.v0 + (t.v1 - t.v0) * (random.unit() < 0.5F ? 2.0F : 1.0F);
  }
  return triangles;
}

Triangles repeated(std::size_t count) {
  Triangles triangles(count, make_triangle({-1, -1, 0}, {1, -0.5F, 0.25F}, {0, 1, 0.5F}));
  if (count > 1) triangles.back() = make_triangle({-1, -1, 0.5F}, {1, -0.5F, 0.5F}, {0, 1, 0.5F});
  return triangles;
}

Triangles same_centroid(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Triangles triangles(count);
  for (Triangle& t : triangles) {
    const float size = std::ldexp(1.0F, -static_cast<int>(12.0F * random.unit()));
    const vec3 a = random.point(size);
    const vec3 b = random.point(size);
    t = make_triangle(a, b, -(a + b));
  }
  return triangles;
}

Triangles coplanar(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const float size = 2.0F / std::sqrt(static_cast<float>(std::max<std::size_t>(count, 1)));
  Triangles triangles(count);
  for (Triangle& t : triangles) {
    t = small_at(random.point(1.0F), size, random);
    t.v0.y = t.v1.y = t.v2.y = 0.0F;
  }
  return triangles;
}

Triangles diagonal(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const float step = 2.0F / static_cast<float>(std::max<std::size_t>(count, 1));
  Triangles triangles(count);
  for (std::size_t i = 0; i < count; ++i) {
    triangles[i] = small_at(vec3(-1.0F + step * static_cast<float>(i)), step, random);
  }
  return triangles;
}

Triangles ball_in_hall(std::size_t count) {
  constexpr float kWall = 1e6F;
  const vec3 low(-kWall);
  const vec3 high(kWall);
  Triangles triangles = ball(count > 12 ? count - 4 : 8, vec3(0.0F), 1.0F);
  triangles.push_back(make_triangle(low, {high.x, low.y, low.z}, {high.x, low.y, high.z}));
  triangles.push_back(make_triangle(low, {high.x, low.y, high.z}, {low.x, low.y, high.z}));
  triangles.push_back(make_triangle({low.x, low.y, high.z}, {high.x, low.y, high.z}, high));
  triangles.push_back(make_triangle({low.x, low.y, high.z}, high, {low.x, high.y, high.z}));
  return triangles;
}

Triangles lattice(std::size_t count) {
  std::size_t side = 1;
  while (6 * side * side * side < count) side *= 2;
  const float step = 2.0F / static_cast<float>(side);
  Triangles triangles;
  for (std::size_t i = 0; triangles.size() < count; ++i) {
    const vec3 at = vec3(-1.0F) + step * vec3(static_cast<float>(i / 3 % side),
                                              static_cast<float>(i / 3 / side % side),
                                              static_cast<float>(i / 3 / side / side));
    vec3 u(0.0F);
    vec3 v(0.0F);
    u[static_cast<int>(i % 3)] = step;
    v[static_cast<int>((i + 1) % 3)] = step;
    triangles.push_back(make_triangle(at, at + u, at + u + v));
    if (triangles.size() < count) triangles.push_back(make_triangle(at, at + u + v, at + v));
  }
  return triangles;
}

Triangles one_a_level(std::size_t count) {
  const float step = 0.5F / static_cast<float>(count + 1);
  Triangles triangles;
  triangles.reserve(count);
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const float end = 1.0F - static_cast<float>(k) * step;
    triangles.push_back(make_triangle({end / 2, 0, 0}, {end, 0, 1}, {end, 1, 0}));
  }
  if (count > 0) triangles.push_back(make_triangle({0, 0, 0}, {step, 0, 1}, {step, 1, 0}));
  return triangles;
}

}  // namespace encore::accel::stability
