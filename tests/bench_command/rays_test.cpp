// The scenes and rays that are raced: the same for the same seed, and what they claim to be.
#include "app/bench/bench_scene.h"
#include "app/bench/embree.h"
#include "app/bench/tracing.h"
#include "app/exit_code.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace encore::app::bench {
namespace {

constexpr int kSide = 64;

bool same(const scene::Ray& a, const scene::Ray& b) {
  return a.origin == b.origin && a.direction == b.direction && a.t_min == b.t_min &&
         a.t_max == b.t_max;
}

bool same(const std::vector<scene::Ray>& a, const std::vector<scene::Ray>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const scene::Ray& x, const scene::Ray& y) { return same(x, y); });
}

const RaySet& of_kind(const std::vector<Rays>& kinds, const std::string& kind) {
  return std::find_if(kinds.begin(), kinds.end(), [&](const Rays& r) { return r.set.kind == kind; })
      ->set;
}

double area_of(const std::vector<scene::Triangle>& triangles) {
  double area = 0.0;
  for (const scene::Triangle& t : triangles) {
    area += 0.5 * glm::length(glm::cross(glm::dvec3(t.v1 - t.v0), glm::dvec3(t.v2 - t.v0)));
  }
  return area;
}

TEST(BenchScene, SplitTrianglesCoverWhatTheyCovered) {
  const BenchScene whole = load_bench_scene("mug");
  const BenchScene parts = load_bench_scene("mug@16");
  EXPECT_EQ(parts.triangles.size(), 16 * whole.triangles.size());
  EXPECT_EQ(parts.name, "mug@16");
  EXPECT_NEAR(area_of(parts.triangles) / area_of(whole.triangles), 1.0, 1e-4);
  EXPECT_EQ(load_bench_scene("mug@4", 4).triangles.size(), parts.triangles.size());
  EXPECT_THROW(load_bench_scene("mug@8"), UsageError);
}

TEST(BenchScene, EveryVertexOfTheMovedStateDiffers) {
  const BenchScene scene = load_bench_scene("mug");
  ASSERT_EQ(scene.moved.size(), scene.triangles.size());
  for (std::size_t i = 0; i < scene.moved.size(); ++i) {
    ASSERT_NE(scene.moved[i].v0, scene.triangles[i].v0);
    ASSERT_NE(scene.moved[i].v1, scene.triangles[i].v1);
    ASSERT_NE(scene.moved[i].v2, scene.triangles[i].v2);
  }
}

TEST(BenchScene, ASoupIsTheSameForTheSameSeedAlone) {
  const auto a = triangle_soup(100, 7);
  const auto b = triangle_soup(100, 7);
  const auto c = triangle_soup(100, 8);
  ASSERT_EQ(a.size(), 100U);
  EXPECT_EQ(a[99].v2, b[99].v2);
  EXPECT_NE(a[99].v2, c[99].v2);
  EXPECT_EQ(load_bench_scene("soup:500").triangles.size(), 500U);
}

TEST(RaySets, RepeatForTheSameSeedAndDifferForAnother) {
  const BenchScene scene = load_bench_scene("mug");
  const auto a = make_rays(scene, kSide, 1);
  const auto b = make_rays(scene, kSide, 1);
  const auto c = make_rays(scene, kSide, 2);
  ASSERT_EQ(a.size(), 4U);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_FALSE(a[k].set.rays.empty()) << a[k].set.kind;
    EXPECT_TRUE(same(a[k].set.rays, b[k].set.rays)) << a[k].set.kind;
    EXPECT_EQ(same(a[k].set.rays, c[k].set.rays), a[k].set.kind != "bounce") << a[k].set.kind;
  }
}

TEST(RaySets, TilesHoldEveryRayOnceAndNothingElseThatHits) {
  const auto kinds = make_rays(load_bench_scene("mug"), kSide, 1);
  for (const Rays& rays : kinds) {
    const RaySet& set = rays.set;
    EXPECT_EQ(set.tile_count(), 4U);
    ASSERT_EQ(set.first.size(), 5U);
    EXPECT_EQ(set.first.back(), set.rays.size());
    std::size_t without = 0;
    for (const scene::Ray& ray : set.tiles) without += ray.t_max < 0.0F ? 1 : 0;
    EXPECT_EQ(without + set.rays.size(), set.tiles.size());
    for (std::size_t i = 0; i < set.rays.size(); ++i) {
      ASSERT_TRUE(same(set.rays[i], set.tiles[set.place[i]]));
    }
  }
}

TEST(RaySets, PacketsHoldEveryRayOnce) {
  const auto kinds = make_rays(load_bench_scene("mug"), kSide, 1);
  for (const Rays& rays : kinds) {
    std::set<std::uint32_t> seen;
    for (std::size_t i = 0; i < rays.embree.index.size(); ++i) {
      const std::uint32_t index = rays.embree.index[i];
      const RayPacket& packet = rays.embree.packets[i / RayPacket::kSize];
      const std::size_t lane = i % RayPacket::kSize;
      EXPECT_EQ(packet.valid[lane] != 0, index != scene::kNoHit);
      if (index == scene::kNoHit) continue;
      EXPECT_TRUE(seen.insert(index).second);
      EXPECT_EQ(packet.direction[2][lane], rays.set.rays[index].direction.z);
      EXPECT_EQ(packet.t_max[lane], rays.set.rays[index].t_max);
    }
    EXPECT_EQ(seen.size(), rays.set.rays.size());
  }
}

TEST(RaySets, ACloserCameraSeesMoreOfTheScene) {
  const auto kinds = make_rays(load_bench_scene("bunny"), kSide, 1);
  const auto primary = of_kind(kinds, "primary").rays.size();
  // What the close rays hit is what bounces; all of it lies in the middle of the other picture.
  EXPECT_EQ(of_kind(kinds, "close").rays.size(), primary);
  EXPECT_GT(of_kind(kinds, "bounce").rays.size(), primary / 4);
}

TEST(RaySets, BouncesLeaveTheSurfaceAndShadowsEndAtTheLight) {
  const auto kinds = make_rays(load_bench_scene("mug"), kSide, 1);
  const RaySet& bounce = of_kind(kinds, "bounce");
  glm::dvec3 sum(0.0);
  for (const scene::Ray& ray : bounce.rays) {
    EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-5);
    sum += glm::dvec3(ray.direction);
  }
  // Directions of cosine distribution average two thirds of the normal, and the normals that a
  // camera sees look at it.
  EXPECT_GT(sum.z / static_cast<double>(bounce.rays.size()), 0.2);
  const RaySet& shadow = of_kind(kinds, "shadow");
  EXPECT_TRUE(shadow.any_hit);
  const glm::vec3 light = shadow.rays[0].origin + shadow.rays[0].direction;
  for (const scene::Ray& ray : shadow.rays) {
    EXPECT_LT(glm::length(ray.origin + ray.direction - light), 1e-3F);
    EXPECT_EQ(ray.t_max, 1.0F);
  }
}

}  // namespace
}  // namespace encore::app::bench
