// Bit for bit the hits of brute force, for rays of every kind on ordinary and hostile scenes.
#include "accel/brute_force.h"
#include "accel/bvh/bvh.h"
#include "accel/test_rays.h"
#include "accel/verify.h"
#include "test_scenes.h"
#include "tests/support/oracle_hits.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace encore::accel::test {
namespace {

void expect_brute_force_hits(const Triangles& triangles, std::size_t rays_a_kind,
                             std::uint64_t seed) {
  Bvh bvh(StructureKind::bvh_median, BvhSettings{}, MemoryMode::pool);
  bvh.build(triangles);
  for (const RayKind kind : all_ray_kinds()) {
    const auto rays = test_rays(kind, rays_a_kind, seed, triangles, bvh);
    encore::test::expect_oracle_hits(bvh, triangles, rays, std::string(to_string(kind)));
  }
}

TEST(BvhHits, AreThoseOfBruteForceOnEveryScene) {
  for (const auto& [name, triangles] : all_test_scenes()) {
    SCOPED_TRACE(name);
    expect_brute_force_hits(triangles, 4000, 50);
  }
}

TEST(BvhHits, AreThoseOfBruteForceForAHundredThousandRaysOfEveryKind) {
  expect_brute_force_hits(soup(60, 4.0F, 51), 100000, 52);
}

TEST(BvhHits, DoNotDependOnScale) {
  const Triangles base = soup(200, 2.0F, 53);
  for (int exponent = -60; exponent <= 60; exponent += 15) {
    SCOPED_TRACE(exponent);
    expect_brute_force_hits(scaled(base, std::ldexp(1.0F, exponent)), 2000, 54);
  }
}

TEST(BvhHits, GoToTheLowestIndexAtEqualDistance) {
  const Triangles triangles = thrice(soup(100, 3.0F, 55));
  Bvh bvh(StructureKind::bvh_median, BvhSettings{}, MemoryMode::pool);
  bvh.build(triangles);
  const auto rays = test_rays(RayKind::outside, 20000, 56, triangles, bvh);
  std::vector<Hit> hits(rays.size());
  bvh.intersect(rays, hits);
  std::size_t found = 0;
  for (const Hit& hit : hits) {
    if (!hit.found()) continue;
    ++found;
    ASSERT_LT(hit.triangle, 100U);
  }
  EXPECT_GT(found, 1000U);
}

TEST(BvhHits, RaysWithNegativeZerosAreNotSlowed) {
  // A zero component must reject boxes beside the ray whatever its sign.
  const Triangles triangles = floor_tiles(32);
  Bvh bvh(StructureKind::bvh_median, BvhSettings{}, MemoryMode::pool);
  bvh.build(triangles);
  for (const float zero : {0.0F, -0.0F}) {
    const Ray ray{.origin = {3.3F, 5.0F, 7.7F}, .direction = {zero, -1.0F, zero}};
    std::vector<Hit> hit(1);
    std::vector<TraceCounters> counters(1);
    bvh.intersect_counted({&ray, 1}, hit, counters);
    EXPECT_TRUE(hit[0].found());
    EXPECT_LT(counters[0].triangle_tests, 20U);
  }
}

TEST(BvhHits, DirectionsTooSmallToInvertLoseNothing) {
  const Triangles triangles = scaled(soup(100, 3.0F, 57), 0x1p-30F);
  Bvh bvh(StructureKind::bvh_median, BvhSettings{}, MemoryMode::pool);
  bvh.build(triangles);
  BruteForce brute;
  brute.build(triangles);
  auto rays = test_rays(RayKind::outside, 5000, 58, triangles, bvh);
  for (Ray& ray : rays) ray.direction *= 0x1p-128F / std::max(1e-30F, glm::length(ray.direction));
  EXPECT_EQ(compare_hits(bvh, brute, rays).mismatches(), 0U);
  EXPECT_GT(compare_hits(bvh, brute, rays).hits, 100U);
}

TEST(BvhHits, CountingChangesNoHitAndCountsEveryTest) {
  const Triangles triangles = soup(1000, 1.0F, 59);
  Bvh bvh(StructureKind::bvh_median, BvhSettings{}, MemoryMode::pool);
  bvh.build(triangles);
  const auto rays = test_rays(RayKind::outside, 2000, 60, triangles, bvh);
  std::vector<Hit> plain(rays.size());
  std::vector<Hit> counted(rays.size());
  std::vector<TraceCounters> counters(rays.size());
  bvh.intersect(rays, plain);
  bvh.intersect_counted(rays, counted, counters);
  TraceCounters sum;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(plain[i].triangle, counted[i].triangle);
    EXPECT_EQ(plain[i].t, counted[i].t);
    sum += counters[i];
    // Each step is either a leaf's triangle or a pair of boxes.
    EXPECT_EQ(counters[i].steps, counters[i].triangle_tests + counters[i].box_tests / 2);
  }
  EXPECT_GT(sum.triangle_tests, 0U);
  // Culled: far fewer than brute force.
  EXPECT_LT(sum.triangle_tests, 50U * rays.size());
}

}  // namespace
}  // namespace encore::accel::test
