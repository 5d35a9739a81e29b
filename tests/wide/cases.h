#pragma once

#include "accel/acceleration_structure.h"
#include "accel/stability_shapes.h"
#include "accel/test_rays.h"
#include "tests/support/random_triangles.h"

#include <string>
#include <vector>

namespace encore::accel::test {

/// A scene of a few hundred triangles that something could go wrong with.
struct Case {
  std::string name;
  std::vector<Triangle> triangles;
};

inline std::vector<Case> hard_cases() {
  namespace shapes = stability;
  const glm::vec3 origin(0.0F);
  const std::vector<Triangle> ball = shapes::ball(400, origin, 1.0F);
  return {{"nothing", {}},
          {"one triangle", encore::test::triangle_soup(1, 0.5F, 1.0F, 1)},
          {"five triangles", encore::test::triangle_soup(5, 0.5F, 1.0F, 2)},
          {"soup", encore::test::triangle_soup(500, 0.2F, 1.0F, 3)},
          {"large triangles", shapes::spanning(100, 4)},
          {"closed ball", ball},
          {"lattice", shapes::lattice(400)},
          {"needles", shapes::needles(300, 5)},
          {"corner to corner", shapes::corner_to_corner(100, 6)},
          {"without area", shapes::without_area(300, 7)},
          {"all equal", std::vector<Triangle>(70, ball[3])},
          {"same centroid", shapes::same_centroid(200, 8)},
          {"coplanar", shapes::coplanar(200, 9)},
          {"one a level", shapes::one_a_level(120)},
          {"tiny", encore::test::scaled(ball, 0x1p-120F)},
          {"below the normal range", encore::test::scaled(ball, 0x1p-130F)},
          {"as large as can be", encore::test::scaled(ball, 0x1p126F)},
          {"far from the origin", encore::test::scaled(ball, glm::vec3(1.0F), glm::vec3(1e5F))}};
}

/// `each` rays of every kind, and the same directions at lengths at the ends of the range.
inline std::vector<Ray> hard_rays(const AccelerationStructure& structure,
                                  const std::vector<Triangle>& triangles, std::size_t each,
                                  std::uint64_t seed) {
  if (triangles.empty()) {
    return {{{0, 0, 5}, 0, {0, 0, -1}}, {{0, 0, 0}, 0, {1, 0, 0}}, {{0, 0, 0}, 0, {1e-44F, 0, 0}}};
  }
  std::vector<Ray> rays;
  for (const RayKind kind : all_ray_kinds()) {
    for (const Ray& ray : test_rays(kind, each, seed, triangles, structure)) rays.push_back(ray);
  }
  // Powers of two, so that whoever is far enough from the ends still hits what it did.
  const std::size_t plain = rays.size();
  for (std::size_t i = 0; i < plain; i += 3) {
    for (const float length : {0x1p-147F, 0x1p-127F, 0x1p-70F, 0x1p+70F, 0x1p+125F}) {
      Ray ray = rays[i];
      const glm::vec3 d =
          glm::vec3(glm::dvec3(ray.direction) /
                    double(std::max({std::fabs(ray.direction.x), std::fabs(ray.direction.y),
                                     std::fabs(ray.direction.z)})) *
                    double(length));
      ray.direction = d;
      ray.t_min = 0.0F;
      ray.t_max = std::numeric_limits<float>::infinity();
      rays.push_back(ray);
    }
  }
  return rays;
}

}  // namespace encore::accel::test
