// Every ray gets from both grids the hit that testing all triangles gives, bit for bit.
#include "accel/grid/grid.h"
#include "tests/grid/random_scenes.h"
#include "tests/support/oracle_hits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace encore::accel::test {
namespace {

// Compares both kinds with brute force and returns how many rays hit.
std::size_t expect_oracle_hits(const std::vector<Triangle>& triangles, const std::vector<Ray>& rays,
                               GridSettings settings = {}) {
  std::size_t hits = 0;
  for (const StructureKind kind : {StructureKind::grid_exact, StructureKind::grid_box}) {
    Grid grid(kind, settings, MemoryMode::pool);
    grid.build(triangles);
    hits = encore::test::expect_oracle_hits(grid, triangles, rays, std::string(grid.name()));
  }
  return hits;
}

std::vector<Ray> mixed_rays(const std::vector<Triangle>& triangles, std::size_t count,
                            std::uint32_t seed) {
  const scene::Bounds box = bounds_of_all(triangles);
  std::vector<Ray> rays;
  for (const float distance : {0.0F, 0.9F, 3.0F, 100.0F}) {
    const auto more = rays_at(box, distance, count / 4, ++seed);
    rays.insert(rays.end(), more.begin(), more.end());
  }
  return rays;
}

// Rays along an axis, and in planes of two axes, exactly on the grid's own planes and on vertices.
std::vector<Ray> aligned_rays(const std::vector<Triangle>& triangles, std::size_t count,
                              std::uint32_t seed, GridSettings settings = {}) {
  Grid grid(StructureKind::grid_box, settings, MemoryMode::pool);
  grid.build(triangles);
  Random random(seed);
  const auto on_plane = [&](int axis) {
    return grid.layout().planes(axis)[random.below(grid.layout().size(axis) + 1)];
  };
  std::vector<Ray> rays;
  const scene::Bounds box = grid.layout().bounds();
  while (rays.size() < count) {
    Ray ray;
    for (int axis = 0; axis < 3; ++axis) {
      const Triangle& t = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
      const std::uint32_t choice = random.below(4);
      ray.origin[axis] = choice <= 1   ? on_plane(axis)
                         : choice == 2 ? t.v0[axis]
                                       : random.between(box.min[axis], box.max[axis]);
      ray.direction[axis] = 0.0F;
    }
    const int axis = static_cast<int>(random.below(3));
    const float sign = random.below(2) == 0 ? 1.0F : -1.0F;
    if (random.below(2) == 0) {
      // Along one axis, from outside or inside, with zeros of both signs beside it.
      ray.direction[(axis + 1) % 3] = random.below(2) == 0 ? 0.0F : -0.0F;
      ray.direction[(axis + 2) % 3] = random.below(2) == 0 ? 0.0F : -0.0F;
      ray.direction[axis] = sign;
      if (random.below(2) == 0) ray.origin[axis] -= sign * 2.0F * (box.size()[axis] + 1e-3F);
    } else {
      // From one crossing of planes towards another: through cell edges and corners.
      vec3 target;
      for (int a = 0; a < 3; ++a) target[a] = on_plane(a);
      ray.direction = target - ray.origin;
      if (random.below(2) == 0) ray.direction[axis] = 0.0F * sign;
      if (random.below(2) == 0) ray.origin -= ray.direction;
    }
    if (ray.direction == vec3(0.0F)) continue;
    rays.push_back(ray);
  }
  return rays;
}

TEST(GridOracle, RandomSoupsOfSmallAndLargeTriangles) {
  for (const float size : {0.02F, 0.2F, 1.0F}) {
    const auto triangles = soup(700, size, 11);
    EXPECT_GT(expect_oracle_hits(triangles, mixed_rays(triangles, 100000, 12)), 100U);
  }
}

TEST(GridOracle, RaysAlongCellPlanesEdgesAndCorners) {
  // Powers of two make planes exact and plane distances tie exactly; the soup does not.
  auto cube = terrain(8, 0.0F, 1);
  const auto lifted = scaled(terrain(8, 0.0F, 1), vec3(1.0F), vec3(0.0F, 0.0F, 1.0F));
  cube.insert(cube.end(), lifted.begin(), lifted.end());
  EXPECT_GT(expect_oracle_hits(cube, aligned_rays(cube, 100000, 3, {.cells_per_axis = 16}),
                               {.cells_per_axis = 16}),
            1000U);
  const auto random = soup(500, 0.3F, 4);
  EXPECT_GT(expect_oracle_hits(random, aligned_rays(random, 100000, 5)), 1000U);
  const auto field = terrain(16, 0.5F, 6);
  EXPECT_GT(expect_oracle_hits(field, aligned_rays(field, 100000, 7)), 1000U);
}

TEST(GridOracle, FarOriginsWhereAllPlanesTie) {
  const auto triangles = soup(300, 0.2F, 21);
  const scene::Bounds box = bounds_of_all(triangles);
  for (const float distance : {1e3F, 1e4F, 1e5F, 1e6F, 1e7F}) {
    expect_oracle_hits(triangles, rays_at(box, distance, 3000, 22));
    // Along one axis aim is better, so that most of these hit.
    auto rays = rays_at(box, 0.5F, 5000, 23);
    for (Ray& ray : rays) {
      ray.origin.x = distance;
      ray.direction = vec3(-1.0F, 0.0F, 0.0F);
    }
    EXPECT_GT(expect_oracle_hits(triangles, rays), 2500U);
  }
}

TEST(GridOracle, AnyScale) {
  // Whole scenes scaled; directions stay about 1, so that t scales too.
  const auto at_one = soup(300, 0.2F, 31);
  std::vector<Ray> rays_at_one;
  for (const float distance : {0.0F, 0.9F, 3.0F}) {
    const auto more = rays_at(bounds_of_all(at_one), distance, 6000, 32);
    rays_at_one.insert(rays_at_one.end(), more.begin(), more.end());
  }
  for (const Ray& ray : aligned_rays(at_one, 10000, 33)) rays_at_one.push_back(ray);
  for (const float scale : {1e-18F, 1e-9F, 1e-3F, 1e6F, 1e12F, 1e18F}) {
    auto rays = rays_at_one;
    for (Ray& ray : rays) ray.origin *= scale;
    EXPECT_GT(expect_oracle_hits(scaled(at_one, vec3(scale)), rays), 1000U) << scale;
  }
}

TEST(GridOracle, FlatAndThinScenes) {
  for (const vec3 scale : {vec3(1, 1, 0), vec3(0, 1, 1), vec3(1, 0, 1), vec3(1, 1, 1e-7F),
                           vec3(1e-6F, 1, 1e-12F), vec3(1, 1e-3F, 1e3F)}) {
    const auto triangles = scaled(soup(400, 0.2F, 41), scale);
    std::size_t hits = expect_oracle_hits(triangles, mixed_rays(triangles, 8000, 42));
    hits += expect_oracle_hits(triangles, aligned_rays(triangles, 8000, 43));
    EXPECT_GT(hits, 100U);
  }
}

TEST(GridOracle, FewerFloatsThanCells) {
  // The extent holds only a dozen floats, so most planes coincide.
  const auto triangles = scaled(soup(300, 0.5F, 51), vec3(4e-7F, 1.0F, 6e-7F), vec3(1.0F));
  expect_oracle_hits(triangles, mixed_rays(triangles, 8000, 52), {.cells_per_axis = 40});
  EXPECT_GT(
      expect_oracle_hits(triangles, aligned_rays(triangles, 8000, 53), {.cells_per_axis = 40}),
      100U);
}

TEST(GridOracle, NeedlesDuplicatesAndPointsLoseNothing) {
  std::vector<Triangle> triangles = scaled(soup(200, 1.0F, 61), vec3(1.0F, 1.0F, 1e-4F));
  for (Triangle& t : triangles) t.v2 = t.v1 + (t.v2 - t.v1) * 1e-3F;
  const auto some = soup(200, 0.2F, 62);
  triangles.insert(triangles.end(), some.begin(), some.end());
  triangles.insert(triangles.end(), some.begin(), some.end());  // ties: the lower index wins
  for (int i = 0; i < 50; ++i) {
    const vec3 p = some[static_cast<std::size_t>(i)].v0;
    triangles.push_back(scene::make_triangle(p, p, p));
    triangles.push_back(scene::make_triangle(p, p, vec3(0.0F)));
  }
  EXPECT_GT(expect_oracle_hits(triangles, mixed_rays(triangles, 60000, 63)), 1000U);
  expect_oracle_hits(triangles, aligned_rays(triangles, 40000, 64));
}

TEST(GridOracle, LimitedAndSurfaceStartingRays) {
  const auto triangles = soup(500, 0.3F, 71);
  auto rays = mixed_rays(triangles, 40000, 72);
  BruteForce brute;
  brute.build(triangles);
  std::vector<Hit> hits(rays.size());
  brute.intersect(rays, hits);
  Random random(73);
  std::vector<Ray> limited;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    Ray ray = rays[i];
    // Limits exactly at the hit, just before it, and anywhere.
    ray.t_max = hits[i].t;
    limited.push_back(ray);
    ray.t_max = std::nextafter(hits[i].t, 0.0F);
    limited.push_back(ray);
    ray.t_max = std::numeric_limits<float>::infinity();
    ray.t_min = hits[i].t;
    limited.push_back(ray);
    ray.t_min = hits[i].t * random.unit();
    ray.t_max = hits[i].t * (1.0F + random.unit());
    limited.push_back(ray);
    // A secondary ray from the surface.
    limited.push_back(Ray{.origin = rays[i].origin + rays[i].direction * hits[i].t,
                          .direction = random.point(1.0F)});
  }
  EXPECT_GT(expect_oracle_hits(triangles, limited), 1000U);
}

TEST(GridOracle, DirectionsThatCannotBeInverted) {
  const auto triangles = soup(200, 0.3F, 81);
  auto rays = mixed_rays(triangles, 8000, 82);
  Random random(83);
  for (Ray& ray : rays) ray.direction[static_cast<int>(random.below(3))] *= 1e-40F;
  auto tiny = mixed_rays(triangles, 400, 84);
  for (Ray& ray : tiny) ray.direction = ray.direction * 1e-40F;
  rays.insert(rays.end(), tiny.begin(), tiny.end());
  EXPECT_GT(expect_oracle_hits(triangles, rays), 500U);
}

TEST(GridOracle, NoTrianglesOneTriangleAndAllTheSame) {
  const auto one = soup(1, 1.0F, 91);
  const auto rays = mixed_rays(one, 4000, 92);
  EXPECT_EQ(expect_oracle_hits({}, rays), 0U);
  EXPECT_GT(expect_oracle_hits(one, rays), 100U);
  EXPECT_GT(expect_oracle_hits(std::vector<Triangle>(300, one[0]), rays), 100U);
  const vec3 p(0.25F, 0.5F, 0.75F);
  expect_oracle_hits(std::vector<Triangle>(50, scene::make_triangle(p, p, p)), rays);
}

TEST(GridOracle, TrianglesAcrossTheWholeScene) {
  const auto triangles = scaled(soup(300, 1.0F, 101), vec3(1.0F));
  EXPECT_GT(
      expect_oracle_hits(triangles, mixed_rays(triangles, 20000, 102), {.cells_per_axis = 70}),
      1000U);
}

}  // namespace
}  // namespace encore::accel::test
