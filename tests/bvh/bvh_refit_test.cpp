// After update() the tree is as tight as a fresh one and returns the same hits; the emulated cases
// of thesis 5.1.1 touch exactly the share of leaves that they stand for.
#include "accel/brute_force.h"
#include "accel/bvh/bvh.h"
#include "accel/test_rays.h"
#include "accel/verify.h"
#include "check_tree.h"
#include "moved_triangles.h"

#include <gtest/gtest.h>

#include <cstring>

namespace encore::accel::test {
namespace {

Bvh make(UpdateCase update_case = UpdateCase::real, std::uint64_t seed = 1) {
  return Bvh(StructureKind::bvh_median, BvhSettings{.update_case = update_case, .seed = seed},
             MemoryMode::pool);
}

void expect_same_hits_as_fresh(const Bvh& refitted, const Triangles& triangles) {
  Bvh fresh = make();
  fresh.build(triangles);
  for (const RayKind kind : all_ray_kinds()) {
    const auto rays = test_rays(kind, 2000, 3, triangles, refitted);
    EXPECT_EQ(compare_hits(refitted, fresh, rays).mismatches(), 0U) << to_string(kind);
  }
}

TEST(BvhRefit, NamesTheLeavesThatTheAverageCaseWrites) {
  const Triangles triangles = soup(1000, 1.0F, 5);
  Bvh bvh = make(UpdateCase::average, 7);
  bvh.build(triangles);
  const auto bits = bvh.average_case_leaves();
  ASSERT_EQ(bits.size(), (1999U + 31) / 32);
  std::uint64_t chosen = 0;
  for (std::uint32_t i = 0; i < 1999; ++i) {
    if ((bits[i / 32] >> (i % 32) & 1U) == 0) continue;
    ++chosen;
    EXPECT_EQ(bvh.nodes()[i].count, 1U) << "an inner node is no leaf";
  }
  bvh.update(triangles);
  EXPECT_EQ(bvh.last_refit().leaves_written, chosen);
}

std::vector<gpu::BvhNode> copy_of(const Bvh& bvh) {
  return {bvh.nodes().begin(), bvh.nodes().end()};
}

bool same_bytes(const std::vector<gpu::BvhNode>& a, std::span<const gpu::BvhNode> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), b.size_bytes()) == 0;
}

TEST(BvhRefit, MovedGrownAndShrunkScenesStayTightAndGiveFreshHits) {
  const Triangles start = soup(2000, 1.0F, 30);
  Bvh bvh = make();
  bvh.build(start);
  const std::vector<Triangles> frames = {
      moved(start, 0.1F, 31), moved(start, 5.0F, 32),         scaled(start, 4.0F),
      scaled(start, 0.125F),  scaled(moved(start, 3, 33), 0), start,
  };
  for (std::size_t i = 0; i < frames.size(); ++i) {
    SCOPED_TRACE(i);
    bvh.update(frames[i]);
    expect_tight_tree(bvh, frames[i]);
    expect_same_hits_as_fresh(bvh, frames[i]);
  }
}

TEST(BvhRefit, EveryHostileSceneCanBeRefitted) {
  for (const auto& [name, triangles] : all_test_scenes()) {
    SCOPED_TRACE(name);
    Bvh bvh = make();
    bvh.build(triangles);
    const Triangles next = moved(triangles, 0.5F, 34);
    bvh.update(next);
    expect_tight_tree(bvh, next);
  }
}

TEST(BvhRefit, TheRootsChildrenShrinkToo) {
  const Triangles start = soup(300, 1.0F, 35);
  Bvh bvh = make();
  bvh.build(start);
  const double before = Bounds{bvh.nodes()[1].min, bvh.nodes()[1].max}.area();
  bvh.update(scaled(start, 0.5F));
  EXPECT_DOUBLE_EQ((Bounds{bvh.nodes()[1].min, bvh.nodes()[1].max}.area()), before / 4);
}

TEST(BvhRefit, NothingIsWrittenWhenNothingMoved) {
  const Triangles triangles = soup(500, 1.0F, 36);
  Bvh bvh = make();
  bvh.build(triangles);
  const auto before = copy_of(bvh);
  bvh.update(triangles);
  EXPECT_EQ(bvh.last_refit().leaves_changed, 0U);
  EXPECT_EQ(bvh.last_refit().leaves_written, 0U);
  EXPECT_EQ(bvh.last_refit().inner_written, 0U);
  EXPECT_TRUE(same_bytes(before, bvh.nodes()));
}

TEST(BvhRefit, OneMovedTriangleTouchesOnlyItsAncestors) {
  Triangles triangles = soup(500, 1.0F, 37);
  Bvh bvh = make();
  bvh.build(triangles);
  triangles[123].v0 += vec3(50.0F);
  bvh.update(triangles);
  EXPECT_EQ(bvh.last_refit().leaves_written, 1U);
  EXPECT_GE(bvh.last_refit().inner_written, 1U);
  EXPECT_LE(bvh.last_refit().inner_written, bvh.stats().max_depth);
  expect_tight_tree(bvh, triangles);
}

TEST(BvhRefit, TheTopologyStays) {
  const Triangles triangles = soup(500, 1.0F, 38);
  Bvh bvh = make();
  bvh.build(triangles);
  const auto before = copy_of(bvh);
  bvh.update(moved(triangles, 2.0F, 39));
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_EQ(before[i].first, bvh.nodes()[i].first);
    ASSERT_EQ(before[i].count, bvh.nodes()[i].count);
  }
}

TEST(BvhRefit, AnotherNumberOfTrianglesIsBuiltAfresh) {
  Bvh bvh = make();
  bvh.update(soup(0, 1.0F, 40));
  EXPECT_TRUE(bvh.nodes().empty());
  for (const std::size_t count : {100, 101, 1, 0, 50}) {
    const Triangles triangles = soup(count, 1.0F, 41);
    bvh.update(triangles);
    expect_tight_tree(bvh, triangles);
  }
}

TEST(BvhRefit, TheBestCaseChecksEveryLeafAndWritesNothing) {
  const Triangles start = soup(1000, 1.0F, 42);
  const Triangles next = moved(start, 1.0F, 43);
  Bvh bvh = make(UpdateCase::best);
  bvh.build(start);
  const auto before = copy_of(bvh);
  bvh.update(next);
  EXPECT_EQ(bvh.last_refit().leaves_changed, 1000U);
  EXPECT_EQ(bvh.last_refit().leaves_written, 0U);
  EXPECT_EQ(bvh.last_refit().inner_written, 0U);
  EXPECT_TRUE(same_bytes(before, bvh.nodes()));
}

TEST(BvhRefit, TheWorstCaseWritesEveryNode) {
  const Triangles start = soup(1000, 1.0F, 44);
  Bvh bvh = make(UpdateCase::worst);
  bvh.build(start);
  bvh.update(start);
  EXPECT_EQ(bvh.last_refit().leaves_changed, 0U);
  EXPECT_EQ(bvh.last_refit().leaves_written, 1000U);
  EXPECT_EQ(bvh.last_refit().inner_written, 999U);
  expect_tight_tree(bvh, start);
  const Triangles next = moved(start, 1.0F, 45);
  bvh.update(next);
  expect_tight_tree(bvh, next);
}

TEST(BvhRefit, TheAverageCaseWritesASeededSixtyPercent) {
  const Triangles start = soup(20000, 0.2F, 46);
  const Triangles next = moved(start, 1.0F, 47);
  const auto refitted = [&](std::uint64_t seed) {
    Bvh bvh = make(UpdateCase::average, seed);
    bvh.build(start);
    bvh.update(next);
    // Five standard deviations of 20,000 draws.
    EXPECT_NEAR(static_cast<double>(bvh.last_refit().leaves_written), 12000.0, 350.0);
    return copy_of(bvh);
  };
  const auto one = refitted(1);
  EXPECT_TRUE(same_bytes(one, refitted(1)));
  EXPECT_FALSE(same_bytes(one, refitted(2)));

  // On a scene that stands still it costs the same and changes nothing.
  Bvh still = make(UpdateCase::average);
  still.build(start);
  const auto before = copy_of(still);
  still.update(start);
  EXPECT_GT(still.last_refit().leaves_written, 11000U);
  EXPECT_TRUE(same_bytes(before, still.nodes()));
}

}  // namespace
}  // namespace encore::accel::test
