// A built kd-tree keeps the limits it was given, loses no triangle, stays within its memory and
// takes O(n log n) steps.
#include "accel/kdtree/kd_node.h"
#include "accel/kdtree/kdtree.h"
#include "kd_scenes.h"
#include "shaders/shared/bindings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

namespace encore::accel {
namespace {

using kd_test::nodes_of;

class KdTreeBuild : public testing::TestWithParam<StructureKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, KdTreeBuild, kd_test::kKinds, kd_test::kind_name);

bool holds(const Bounds& box, const glm::vec3& p) {
  return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x &&
         p.y <= box.max.y && p.z <= box.max.z;
}

TEST_P(KdTreeBuild, KeepsTheDepthAndLeafLimits) {
  for (const kd_test::NamedScene& scene : kd_test::hostile_scenes()) {
    KdTree tree(GetParam(), {}, MemoryMode::pool);
    tree.build(scene.triangles);
    const double count = static_cast<double>(scene.triangles.size());
    EXPECT_LE(tree.stats().max_depth, 11.0 + 1.3 * std::log(count)) << scene.name;
  }
  // Without any other limit, a leaf above the leaf size lies at the depth limit.
  const std::vector<Triangle> soup = kd_test::soup(6000, 0.05F, 21);
  KdTreeSettings settings;
  settings.bad_split_retries = 1000;
  settings.depth_offset = 3.0F;
  settings.depth_factor = 0.5F;
  KdTree tree(GetParam(), settings, MemoryMode::pool);
  tree.build(soup);
  const auto limit = static_cast<std::uint32_t>(3.0 + 0.5 * std::log(6000.0));
  EXPECT_EQ(tree.stats().max_depth, limit);
  for (const NodeView& node : nodes_of(tree)) {
    EXPECT_LE(node.depth, limit);
    if (node.leaf) {
      EXPECT_TRUE(node.triangles.size() <= 10 || node.depth == limit);
    }
  }
}

TEST_P(KdTreeBuild, TakesTheDepthLogarithmFromTheSettings) {
  KdTreeSettings settings;
  settings.depth_logarithm = KdTreeSettings::DepthLogarithm::base2;
  EXPECT_EQ(kd_limits(settings, 1U << 16).depth, 31U);  // 11 + 1.3 * 16 = 31.8
  EXPECT_EQ(kd_limits({}, 1U << 16).depth, 25U);        // 11 + 1.3 * 11.09 = 25.4
  settings.depth_offset = 1000.0F;
  EXPECT_EQ(kd_limits(settings, 100).depth, kKdDepthCap);
  settings.depth_offset = -1000.0F;
  EXPECT_EQ(kd_limits(settings, 100).depth, 0U);
}

TEST_P(KdTreeBuild, UsesSmallerLeavesInSmallScenes) {
  EXPECT_EQ(kd_limits({}, 4999).leaf_triangles, 2U);
  EXPECT_EQ(kd_limits({}, 5000).leaf_triangles, 10U);
  KdTreeSettings settings;
  settings.leaf_triangles = 37;
  EXPECT_EQ(kd_limits(settings, 10).leaf_triangles, 37U);
  // No node of that size is split.
  const std::vector<Triangle> soup = kd_test::soup(3000, 0.02F, 22);
  KdTree tree(GetParam(), settings, MemoryMode::pool);
  tree.build(soup);
  std::size_t leaves = 0;
  for (const NodeView& node : nodes_of(tree)) leaves += node.leaf && node.triangles.size() > 18;
  EXPECT_GT(leaves, 20U);
}

TEST(KdMedian, SplitsTheLongWayRoundAndInTheMiddle) {
  const std::vector<Triangle> soup = kd_test::soup(4000, 0.05F, 23);
  KdTree tree(StructureKind::kd_median, {}, MemoryMode::pool);
  tree.build(soup);
  for (const NodeView& node : nodes_of(tree)) {
    if (node.leaf) continue;
    EXPECT_EQ(node.split_axis, static_cast<int>(node.depth % 3));
    EXPECT_EQ(node.split_position,
              node.bounds.min[node.split_axis] * 0.5F + node.bounds.max[node.split_axis] * 0.5F);
  }
}

TEST(KdMedian, PassesOverAnAxisThatCannotBeSplit) {
  KdTree tree(StructureKind::kd_median, {}, MemoryMode::pool);
  const std::vector<Triangle> flat = kd_test::terrain(32, 0.0F);
  tree.build(flat);
  EXPECT_LE(tree.stats().largest_leaf, 8U);
  for (const NodeView& node : nodes_of(tree)) EXPECT_NE(node.split_axis, 2);
}

TEST(KdMedian, GivesUpAfterFiveBadSplitsInheritedDownThePath) {
  // A cluster so small that halving the box does not divide it before the retries run out.
  std::vector<Triangle> cluster = kd_test::scaled(kd_test::soup(300, 0.5F, 24), 0x1p-20F);
  cluster.push_back(scene::make_triangle({64, 64, 64}, {63, 64, 64}, {64, 63, 63}));
  for (const int retries : {0, 1, 5, 9}) {
    KdTreeSettings settings;
    settings.bad_split_retries = retries;
    KdTree tree(StructureKind::kd_median, settings, MemoryMode::pool);
    tree.build(cluster);
    EXPECT_EQ(tree.stats().largest_leaf, retries == 0 ? 301U : 300U);
    EXPECT_EQ(tree.stats().max_depth, static_cast<std::uint32_t>(retries));
  }
}

TEST(KdSah, SeparatesAFarClusterThatTheMedianCannot) {
  for (const kd_test::NamedScene& scene : kd_test::hostile_scenes()) {
    if (scene.name != "uneven") continue;
    KdTree median(StructureKind::kd_median, {}, MemoryMode::pool);
    KdTree sah(StructureKind::kd_sah, {}, MemoryMode::pool);
    median.build(scene.triangles);
    sah.build(scene.triangles);
    EXPECT_LT(sah.stats().sah_cost, median.stats().sah_cost);
    EXPECT_LT(sah.stats().largest_leaf, 100U);
  }
  const std::vector<Triangle> soup = kd_test::soup(6000, 0.05F, 25);
  KdTree median(StructureKind::kd_median, {}, MemoryMode::pool);
  KdTree sah(StructureKind::kd_sah, {}, MemoryMode::pool);
  median.build(soup);
  sah.build(soup);
  EXPECT_LE(sah.stats().sah_cost, median.stats().sah_cost * 1.1);
}

TEST(KdSah, SplitsOnlyAtEndsOfTriangles) {
  // Scenes whose triangles are never cut have only vertices to split at.
  const std::vector<Triangle> boxes = kd_test::boxes(5);
  KdTree tree(StructureKind::kd_sah, {}, MemoryMode::pool);
  tree.build(boxes);
  for (const NodeView& node : nodes_of(tree)) {
    if (node.leaf) continue;
    EXPECT_EQ(node.split_position, std::floor(node.split_position));
    EXPECT_GT(node.split_position, node.bounds.min[node.split_axis]);
    EXPECT_LT(node.split_position, node.bounds.max[node.split_axis]);
  }
}

TEST(KdSah, TakesStepsInProportionToNLogN) {
  // Of four times the triangles, at most 4 * (1 + 2 / log2(n)) times the steps, and some room. The
  // larger soup has 28 to 31 references a triangle: with fewer allowed, trees of different limits
  // would be compared.
  for (const float size : {0.02F, 0.5F}) {
    std::uint64_t before = 0;
    for (const std::size_t count : {std::size_t{2500}, std::size_t{10000}, std::size_t{40000}}) {
      const float shrink = 1.0F / std::cbrt(static_cast<float>(count) / 2500.0F);
      const std::vector<Triangle> soup = kd_test::soup(count, size * shrink, 26);
      KdTreeSettings settings;
      settings.leaf_triangles = 10;
      settings.most_references = 64;
      KdTree tree(StructureKind::kd_sah, settings, MemoryMode::pool);
      tree.build(soup);
      EXPECT_FALSE(tree.stats().limited);
      if (before > 0) {
        EXPECT_LT(tree.build_operations(), 6 * before) << count;
      }
      before = tree.build_operations();
    }
  }
}

TEST_P(KdTreeBuild, TakesAtMostTwiceTheStepsWhereItBeginsAnew) {
  const std::vector<Triangle> soup = kd_test::soup(10000, 0.3F, 26);
  KdTreeSettings settings;
  settings.most_references = 1000;
  KdTree free(GetParam(), settings, MemoryMode::pool);
  free.build(soup);
  ASSERT_FALSE(free.stats().limited);
  for (const int most : {2, 8, 16}) {
    settings.most_references = most;
    KdTree tree(GetParam(), settings, MemoryMode::pool);
    tree.build(soup);
    // Both builds make the splits of the free one, or fewer of them.
    EXPECT_LE(tree.build_operations(), 2 * free.build_operations()) << most;
    if (most == 2) {
      EXPECT_TRUE(tree.stats().limited);
    }
  }
}

TEST(KdSah, DoesNotSplitWhatCannotBeDivided) {
  const std::vector<Triangle> same(1000, kd_test::soup(1, 1.0F, 27)[0]);
  KdTree tree(StructureKind::kd_sah, {}, MemoryMode::pool);
  tree.build(same);
  EXPECT_EQ(tree.stats().nodes, 1U);
  EXPECT_EQ(tree.stats().references, 1000U);
}

TEST_P(KdTreeBuild, HoldsEveryPointOfEveryTriangleInSomeLeafThere) {
  for (const kd_test::NamedScene& scene : kd_test::hostile_scenes()) {
    KdTree tree(GetParam(), {}, MemoryMode::pool);
    tree.build(scene.triangles);
    // Vertices are exact points: a leaf whose closed box holds one must name the triangle.
    std::vector<std::set<int>> covered(scene.triangles.size());
    tree.visit([&](const NodeView& node) {
      for (const std::uint32_t i : node.triangles) {
        const Triangle& t = scene.triangles[i];
        if (holds(node.bounds, t.v0)) covered[i].insert(0);
        if (holds(node.bounds, t.v1)) covered[i].insert(1);
        if (holds(node.bounds, t.v2)) covered[i].insert(2);
      }
      return true;
    });
    for (const auto& vertices : covered) EXPECT_EQ(vertices.size(), 3U) << scene.name;
  }
}

TEST_P(KdTreeBuild, NamesNoTriangleWhereItIsNot) {
  // A diagonal triangle's box covers the cube, the triangle only a slice of it.
  std::vector<Triangle> triangles(1, scene::make_triangle({0, 0, 0}, {16, 16, 0}, {16, 16, 16}));
  for (const Triangle& t : kd_test::soup(2000, 0.2F, 28)) {
    const glm::vec3 at(8.0F);
    triangles.push_back(scene::make_triangle(t.v0 * 7.0F + at, t.v1 * 7.0F + at, t.v2 * 7.0F + at));
  }
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  tree.build(triangles);
  std::size_t named = 0;
  for (const NodeView& node : nodes_of(tree)) {
    if (!node.leaf || !std::count(node.triangles.begin(), node.triangles.end(), 0U)) continue;
    ++named;
    // It lies in the plane x = y.
    EXPECT_LE(node.bounds.min.x, node.bounds.max.y + 1e-4F);
    EXPECT_LE(node.bounds.min.y, node.bounds.max.x + 1e-4F);
  }
  EXPECT_GT(named, 5U);
}

TEST_P(KdTreeBuild, KeepsLeavesInIndexOrderAndNodesDepthFirst) {
  const std::vector<Triangle> soup = kd_test::soup(2000, 0.2F, 29);
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  tree.build(soup);
  std::size_t references = 0;
  std::size_t nodes = 0;
  for (const NodeView& node : nodes_of(tree)) {
    ++nodes;
    references += node.triangles.size();
    EXPECT_TRUE(std::is_sorted(node.triangles.begin(), node.triangles.end()));
  }
  const GpuBuffers buffers = tree.gpu_buffers();
  ASSERT_EQ(buffers.size(), 2U);
  EXPECT_EQ(buffers[0].binding, ENCORE_BINDING_NODES);
  EXPECT_EQ(buffers[0].bytes.size(), nodes * 8);
  EXPECT_EQ(buffers[1].binding, ENCORE_BINDING_REFERENCES);
  EXPECT_EQ(buffers[1].bytes.size(), references * 4);
  const BuildStats stats = tree.stats();
  EXPECT_EQ(stats.nodes, nodes);
  EXPECT_EQ(stats.leaves, nodes / 2 + 1);
  EXPECT_EQ(stats.references, references);
  EXPECT_EQ(stats.bytes, nodes * 8 + references * 4);
}

TEST_P(KdTreeBuild, StaysWithinItsReferenceLimitOnHostileScenes) {
  // Large triangles everywhere: no split separates much, and every limit is off but the last one.
  const std::vector<Triangle> spanning = kd_test::soup(3000, 8.0F, 30);
  KdTreeSettings settings;
  settings.bad_split_retries = 1000;
  settings.depth_offset = 60.0F;
  settings.leaf_triangles = 1;
  KdTree tree(GetParam(), settings, MemoryMode::pool);
  tree.build(spanning);
  const std::uint64_t limit = kd_limits(settings, spanning.size()).references;
  EXPECT_EQ(limit, 16U * 3000U + 65536U);
  EXPECT_LE(tree.stats().references, limit);
  EXPECT_GT(tree.stats().references, limit / 4);
}

TEST_P(KdTreeBuild, AllocatesByItsMemoryMode) {
  const std::vector<Triangle> soup = kd_test::soup(20000, 0.1F, 31);
  const std::vector<Triangle> fewer(soup.begin(), soup.begin() + 9000);
  KdTree pooled(GetParam(), {}, MemoryMode::pool);
  pooled.build(soup);
  EXPECT_GT(pooled.stats().allocations, 0U);
  EXPECT_LT(pooled.stats().allocations, 40U);
  const BuildStats first = pooled.stats();
  for (const auto* triangles : {&fewer, &soup}) {
    pooled.build(*triangles);
    EXPECT_EQ(pooled.stats().allocations, 0U);
    EXPECT_EQ(pooled.stats().allocated_bytes, 0U);
  }
  EXPECT_EQ(pooled.stats().references, first.references);
  KdTree fresh(GetParam(), {}, MemoryMode::fresh);
  for (int round = 0; round < 2; ++round) {
    fresh.build(soup);
    EXPECT_GT(fresh.stats().allocations, 3U);
    EXPECT_EQ(fresh.stats().references, first.references);
    EXPECT_EQ(fresh.stats().nodes, first.nodes);
  }
}

TEST_P(KdTreeBuild, RefusesMoreTrianglesThanALeafCanCount) {
  const Triangle one = kd_test::soup(1, 1.0F, 32)[0];
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  // The length alone is looked at.
  EXPECT_THROW(tree.build({&one, std::size_t{1} << 30}), std::length_error);
}

TEST_P(KdTreeBuild, IsOneEmptyLeafWithoutTriangles) {
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  tree.build({});
  const BuildStats stats = tree.stats();
  EXPECT_EQ(stats.nodes, 1U);
  EXPECT_EQ(stats.empty_leaves, 1U);
  EXPECT_EQ(stats.references, 0U);
  EXPECT_EQ(stats.sah_cost, 0.0);
}

}  // namespace
}  // namespace encore::accel
