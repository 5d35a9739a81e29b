// The tree is the thesis' (3.3.1): split by split, tight, bounded in size and depth.
#include "accel/bvh/bvh.h"
#include "check_tree.h"
#include "shaders/shared/bindings.h"
#include "test_scenes.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace encore::accel::test {
namespace {

Bvh make(MemoryMode memory = MemoryMode::pool) {
  return Bvh(StructureKind::bvh_median, BvhSettings{}, memory);
}

struct SplitCounts {
  int first_axis = 0;
  int other_axis = 0;
  int halves = 0;
};

/// Holds every inner node to the pseudo-code of thesis 3.3.1, carried out naively on sets.
SplitCounts expect_thesis_splits(const Bvh& bvh, std::span<const Triangle> triangles) {
  SplitCounts counts;
  const auto nodes = bvh.nodes();
  const auto below = triangles_below(nodes);
  std::vector<std::uint32_t> depth(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].count != 0) continue;
    depth[nodes[i].first] = depth[nodes[i].first + 1] = depth[i] + 1;
    if (below[i].size() == 2) continue;
    const Bounds box = bounds_of_all(triangles, below[i]);
    std::vector<std::uint32_t> left;
    std::uint32_t attempt = 0;
    for (; attempt < 3; ++attempt) {
      const int axis = static_cast<int>((depth[i] + attempt) % 3);
      const float middle = box.center()[axis];
      left.clear();
      for (const std::uint32_t t : below[i]) {
        if (scene::bounds_of(triangles[t]).min[axis] < middle) left.push_back(t);
      }
      if (!left.empty() && left.size() < below[i].size()) break;
    }
    const auto& found = below[nodes[i].first];
    if (attempt < 3 && depth[i] < Bvh::kMaxSpatialDepth) {
      EXPECT_EQ(found, left) << "node " << i;
      ++(attempt == 0 ? counts.first_axis : counts.other_axis);
    } else {
      EXPECT_EQ(found.size(), below[i].size() / 2) << "node " << i;
      ++counts.halves;
    }
  }
  return counts;
}

TEST(BvhBuild, EveryTreeIsWholeTightAndBounded) {
  for (const auto& [name, triangles] : all_test_scenes()) {
    SCOPED_TRACE(name);
    Bvh bvh = make();
    bvh.build(triangles);
    expect_tight_tree(bvh, triangles);
  }
}

TEST(BvhBuild, EverySplitIsTheOneThatTheThesisDescribes) {
  for (const auto& [name, triangles] : all_test_scenes()) {
    SCOPED_TRACE(name);
    Bvh bvh = make();
    bvh.build(triangles);
    expect_thesis_splits(bvh, triangles);
  }
}

TEST(BvhBuild, AxesTakeTurns) {
  // Eight triangles at the corners of a cube: x, y and z in turn divide everything.
  Triangles corners;
  for (int i = 0; i < 8; ++i) {
    const vec3 at(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                  static_cast<float>(i >> 2));
    corners.push_back(make_triangle(at, at + vec3(0.1F, 0, 0), at + vec3(0, 0.1F, 0.1F)));
  }
  Bvh bvh = make();
  bvh.build(corners);
  const auto below = triangles_below(bvh.nodes());
  const std::uint32_t left = bvh.nodes()[0].first;
  const std::uint32_t left_left = bvh.nodes()[left].first;
  EXPECT_EQ(below[left], (std::vector<std::uint32_t>{0, 2, 4, 6}));
  EXPECT_EQ(below[left_left], (std::vector<std::uint32_t>{0, 4}));
  EXPECT_EQ(bvh.stats().max_depth, 3U);
}

TEST(BvhBuild, TheOtherAxesAreTriedWhenOneSideWouldBeEmpty) {
  // All in one row along z: neither x nor y divides anything, at any depth.
  Triangles row;
  for (int i = 0; i < 64; ++i) {
    const vec3 at(0, 0, static_cast<float>(i));
    row.push_back(make_triangle(at, at + vec3(1, 0, 0), at + vec3(0, 1, 0.5F)));
  }
  Bvh bvh = make();
  bvh.build(row);
  const SplitCounts counts = expect_thesis_splits(bvh, row);
  EXPECT_GT(counts.other_axis, counts.first_axis);
  EXPECT_EQ(counts.halves, 0);
  EXPECT_EQ(bvh.stats().max_depth, 6U);
}

TEST(BvhBuild, IdenticalTrianglesAreHalved) {
  const Triangles same = identical(1000);
  Bvh bvh = make();
  bvh.build(same);
  const SplitCounts counts = expect_thesis_splits(bvh, same);
  EXPECT_EQ(counts.first_axis + counts.other_axis, 0);
  EXPECT_GT(counts.halves, 400);
  EXPECT_EQ(bvh.stats().max_depth, 10U);
}

TEST(BvhBuild, AScaleOfPowersOfTwoGoesDeepButNotTooDeep) {
  const Triangles series = geometric_series(360);
  Bvh bvh = make();
  bvh.build(series);
  EXPECT_GT(bvh.stats().max_depth, 60U);
  expect_tight_tree(bvh, series);
}

TEST(BvhBuild, ScenesThatLoseOneTriangleALevelAreHalvedAtTheLimit) {
  const Triangles chain = one_a_level(500);
  Bvh bvh = make();
  bvh.build(chain);
  EXPECT_GT(bvh.stats().max_depth, Bvh::kMaxSpatialDepth);
  EXPECT_LE(bvh.stats().max_depth, Bvh::kMaxSpatialDepth + 9);  // 285 left: at most 9 halvings
}

TEST(BvhBuild, StatisticsDescribeTheTree) {
  const Triangles triangles = soup(1000, 0.5F, 20);
  Bvh bvh = make();
  bvh.build(triangles);
  const BuildStats stats = bvh.stats();
  EXPECT_EQ(stats.triangles, 1000U);
  EXPECT_EQ(stats.nodes, 1999U);
  EXPECT_EQ(stats.leaves, 1000U);
  EXPECT_EQ(stats.empty_leaves, 0U);
  EXPECT_EQ(stats.references, 1000U);
  EXPECT_EQ(stats.largest_leaf, 1U);
  EXPECT_EQ(stats.bytes, 1999U * 32U);
  EXPECT_DOUBLE_EQ(stats.duplication(), 1.0);
  double cost = 0;
  bvh.visit([&](const NodeView& node) {
    EXPECT_EQ(node.triangles.size(), node.leaf ? 1U : 0U);
    cost += node.bounds.area();
    return true;
  });
  const Bounds root{bvh.nodes()[0].min, bvh.nodes()[0].max};
  EXPECT_NEAR(stats.sah_cost, cost / root.area(), 1e-9 * stats.sah_cost);
}

TEST(BvhBuild, AVisitorThatDeclinesSeesNoChildren) {
  const Triangles triangles = soup(100, 1.0F, 21);
  Bvh bvh = make();
  bvh.build(triangles);
  int visited = 0;
  bvh.visit([&](const NodeView& node) {
    ++visited;
    return node.depth < 1;
  });
  EXPECT_EQ(visited, 3);
}

TEST(BvhBuild, TheGpuGetsTheVeryNodes) {
  const Triangles triangles = soup(100, 1.0F, 22);
  Bvh bvh = make();
  bvh.build(triangles);
  const GpuBuffers buffers = bvh.gpu_buffers();
  ASSERT_EQ(buffers.size(), 1U);
  EXPECT_EQ(buffers[0].binding, ENCORE_BINDING_NODES);
  EXPECT_EQ(buffers[0].bytes.size(), 199U * 32U);
  EXPECT_EQ(static_cast<const void*>(buffers[0].bytes.data()), bvh.nodes().data());
}

TEST(BvhBuild, PoolAllocatesOnceAndFreshEveryTime) {
  const Triangles triangles = soup(500, 1.0F, 23);
  Bvh pool = make(MemoryMode::pool);
  pool.build(triangles);
  EXPECT_GT(pool.stats().allocations, 0U);
  EXPECT_GE(pool.stats().allocated_bytes, 999U * 32U);
  pool.update(triangles);
  pool.build(triangles);
  EXPECT_EQ(pool.stats().allocations, 0U);
  EXPECT_EQ(pool.stats().allocated_bytes, 0U);
  pool.update(triangles);
  EXPECT_EQ(pool.stats().allocations, 0U);

  Bvh fresh = make(MemoryMode::fresh);
  fresh.build(triangles);
  const BuildStats first = fresh.stats();
  fresh.build(triangles);
  EXPECT_GT(first.allocations, 0U);
  EXPECT_EQ(fresh.stats().allocations, first.allocations);
  EXPECT_EQ(fresh.stats().allocated_bytes, first.allocated_bytes);
}

TEST(BvhBuild, RebuildingForgetsTheLastScene) {
  const Triangles large = soup(500, 1.0F, 24);
  const Triangles small = soup(7, 1.0F, 25);
  Bvh bvh = make();
  for (const Triangles* triangles : {&large, &small, &large}) {
    bvh.build(*triangles);
    expect_tight_tree(bvh, *triangles);
  }
  bvh.build({});
  EXPECT_EQ(bvh.stats().nodes, 0U);
  EXPECT_EQ(bvh.stats().max_depth, 0U);
}

TEST(BvhBuild, TooManyTrianglesAreRefusedInWords) {
  // Only the number is looked at before the refusal.
  const Triangle triangle{};
  const std::span<const Triangle> endless(&triangle, (std::size_t{1} << 31) + 1);
  Bvh bvh = make();
  EXPECT_THROW(bvh.build(endless), std::length_error);
}

}  // namespace
}  // namespace encore::accel::test
