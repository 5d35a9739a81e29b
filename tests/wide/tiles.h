#pragma once

#include "accel/wide/wide_bvh.h"
#include "cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace encore::accel::test {

/// A rectangle of rays, row by row.
struct Tile {
  std::string name;
  std::size_t width = 0;
  std::vector<Ray> rays;
};

/// A rectangle of rays; ray_at() takes places in [0, 1].
inline Tile make_tile(const std::string& name, std::size_t width, std::size_t height,
                      const std::function<Ray(float, float)>& ray_at) {
  Tile tile{name + ", " + std::to_string(width) + " x " + std::to_string(height), width, {}};
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      tile.rays.push_back(ray_at((static_cast<float>(x) + 0.5F) / static_cast<float>(width),
                                 (static_cast<float>(y) + 0.5F) / static_cast<float>(height)));
    }
  }
  return tile;
}

struct Look {
  glm::vec3 middle{0.0F}, half{1.0F};
  float size = 1.0F;
};

inline Look look_at(const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return {};
  scene::Bounds all;
  for (const Triangle& t : triangles) all.extend(scene::bounds_of(t));
  Look look;
  look.middle = all.min * 0.5F + all.max * 0.5F;
  look.half = all.max * 0.5F - all.min * 0.5F;
  look.size = std::max({look.half.x, look.half.y, look.half.z, 0x1p-40F});
  return look;
}

/// From a point to another, the direction's largest component of length 1.
inline Ray through(const glm::vec3& eye, const glm::vec3& target) {
  Ray ray;
  ray.origin = eye;
  ray.direction = target - eye;
  const glm::vec3& d = ray.direction;
  const float largest = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
  if (largest > 0.0F) ray.direction = d * (1.0F / largest);
  if (!(largest > 0.0F)) ray.direction = {0.0F, 0.0F, -1.0F};
  return ray;
}

/// Rays go through together and find what they find alone, bit for bit: every intersection mode and
/// instruction set.
inline void expect_same(WideBvh& wide, const std::string& name, const Tile& tile) {
  const std::size_t count = tile.rays.size();
  std::vector<Hit> alone(count), together(count);
  std::vector<std::uint8_t> alone_blocked(count), together_blocked(count);
  for (const IntersectionMode mode : all_intersection_modes()) {
    wide.set_intersection(mode);
    wide.set_isa(Isa::portable);
    wide.intersect(tile.rays, alone);
    wide.occluded(tile.rays, alone_blocked);
    for (const Isa isa : available_isas()) {
      wide.set_isa(isa);
      wide.intersect_tile(tile.rays, tile.width, together);
      wide.occluded_tile(tile.rays, tile.width, together_blocked);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const bool same = std::memcmp(&alone[i], &together[i], sizeof(Hit)) == 0;
        if (same && alone_blocked[i] == together_blocked[i]) continue;
        if (++wrong > 1) continue;
        ADD_FAILURE() << name << ", " << tile.name << ", " << to_string(mode) << ", "
                      << to_string(isa) << ", ray " << i << ": alone " << alone[i].triangle
                      << " at " << alone[i].t << ", blocked " << int{alone_blocked[i]}
                      << ", together " << together[i].triangle << " at " << together[i].t
                      << ", blocked " << int{together_blocked[i]};
      }
      EXPECT_EQ(wrong, 0U) << "of " << count;
    }
  }
}

}  // namespace encore::accel::test
