#pragma once

#include "accel/acceleration_structure.h"
#include "accel/simd/isa.h"
#include "accel/test_rays.h"
#include "tests/support/random_triangles.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace encore::accel::test {

/// A rectangle of rays, row by row.
struct RayTile {
  std::string name;
  std::size_t width;
  std::vector<Ray> rays;
};

inline Bounds bounds_around(const std::vector<Triangle>& triangles) {
  Bounds bounds;
  for (const Triangle& t : triangles) bounds.extend(scene::bounds_of(t));
  return bounds;
}

/// Through the pixels of a square around the box, seen from `distance` boxes away along
/// `direction`; parallel to it if `parallel`.
inline RayTile camera_tile(const Bounds& bounds, const glm::vec3& direction, float distance,
                           bool parallel, std::size_t width, std::size_t height) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(direction));
  const glm::dvec3 helper = std::fabs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, helper));
  const glm::dvec3 up = glm::cross(right, forward);
  const double size = glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
  const glm::dvec3 center = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
  const glm::dvec3 eye = center - forward * (size * double(distance));
  RayTile tile{"camera", width, {}};
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const double u = (double(x) + 0.5) / double(width) - 0.5;
      const double v = 0.5 - (double(y) + 0.5) / double(height);
      const glm::dvec3 at = center + (right * u + up * v) * size;
      Ray ray;
      ray.origin = glm::vec3(parallel ? at - forward * (size * double(distance)) : eye);
      ray.direction = glm::vec3(parallel ? forward : glm::normalize(at - eye));
      tile.rays.push_back(ray);
    }
  }
  return tile;
}

/// Pictures of many sizes and views, rays that end, rays along axes, and rays that have nothing in
/// common.
inline std::vector<RayTile> ray_tiles(const std::vector<Triangle>& triangles,
                                      const AccelerationStructure& structure) {
  const Bounds bounds = bounds_around(triangles);
  std::vector<RayTile> tiles;
  tiles.push_back(camera_tile(bounds, {0.1F, -0.2F, -1}, 1.5F, false, 40, 40));
  tiles.push_back(camera_tile(bounds, {-1, 0.3F, 0.2F}, 1.2F, false, 37, 23));
  tiles.push_back(camera_tile(bounds, {0.2F, 1, 0.4F}, 0.1F, false, 16, 16));
  tiles.push_back(camera_tile(bounds, {1, 1, 1}, 3.0F, false, 1, 13));
  tiles.push_back(camera_tile(bounds, {1, -1, 1}, 3.0F, false, 29, 1));
  tiles.push_back(camera_tile(bounds, {0, 0, -1}, 2.0F, true, 19, 24));
  tiles.push_back(camera_tile(bounds, {0, 1, 0}, 2.0F, true, 24, 9));
  tiles.push_back(camera_tile(bounds, {-0.3F, -1, 0.4F}, 2.0F, true, 8, 8));
  RayTile limited = camera_tile(bounds, {0.1F, -0.2F, -1}, 1.5F, false, 32, 32);
  const auto size =
      static_cast<float>(glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min)));
  for (std::size_t i = 0; i < limited.rays.size(); ++i) {
    limited.rays[i].t_min = size * 0.01F * static_cast<float>(i % 200);
    limited.rays[i].t_max = size * 0.01F * static_cast<float>(100 + i % 77);
  }
  tiles.push_back(limited);
  for (const RayKind kind : all_ray_kinds()) {
    tiles.push_back(
        {std::string(to_string(kind)), 12, test_rays(kind, 12 * 7, 5, triangles, structure)});
  }
  return tiles;
}

/// Holds tiles to single rays, bit for bit, for every instruction set. `any_shape`: triangles for
/// which Möller-Trumbore may find what it happens to test.
template <class Structure>
void expect_tiles_as_single_rays(Structure& structure, const std::vector<Triangle>& triangles,
                                 bool any_shape) {
  structure.build(triangles);
  const std::vector<RayTile> tiles = ray_tiles(triangles, structure);
  for (const Isa isa : available_isas()) {
    structure.set_isa(isa);
    for (const IntersectionMode mode : all_intersection_modes()) {
      if (any_shape && mode == IntersectionMode::moller_trumbore) continue;
      structure.set_intersection(mode);
      for (const RayTile& tile : tiles) {
        SCOPED_TRACE(std::string(to_string(isa)) + " " + std::string(to_string(mode)) + " " +
                     tile.name);
        std::vector<Hit> alone(tile.rays.size()), together(tile.rays.size());
        std::vector<std::uint8_t> blocked_alone(tile.rays.size()), blocked(tile.rays.size(), 7);
        structure.intersect(tile.rays, alone);
        structure.occluded(tile.rays, blocked_alone);
        structure.intersect_tile(tile.rays, tile.width, together);
        structure.occluded_tile(tile.rays, tile.width, blocked);
        std::size_t different = 0;
        for (std::size_t i = 0; i < tile.rays.size(); ++i) {
          different += std::memcmp(&alone[i], &together[i], sizeof(Hit)) != 0 ? 1 : 0;
        }
        EXPECT_EQ(different, 0U);
        EXPECT_EQ(blocked, blocked_alone);
      }
    }
  }
}

}  // namespace encore::accel::test
