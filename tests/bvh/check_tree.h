#pragma once

#include "accel/bvh/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

namespace encore::accel::test {

/// The triangles below each node, in ascending order, found by walking the node array itself.
inline std::vector<std::vector<std::uint32_t>> triangles_below(
    std::span<const gpu::BvhNode> nodes) {
  std::vector<std::vector<std::uint32_t>> below(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].count != 0) {
      below[i] = {nodes[i].first};
      continue;
    }
    if (nodes[i].first <= i || nodes[i].first + 1 >= nodes.size()) {
      ADD_FAILURE() << "children of node " << i << " do not come after it";
      return below;
    }
    const auto& left = below[nodes[i].first];
    const auto& right = below[nodes[i].first + 1];
    std::merge(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(below[i]));
  }
  return below;
}

inline Bounds bounds_of_all(std::span<const Triangle> triangles,
                            std::span<const std::uint32_t> indices) {
  Bounds bounds;
  for (const std::uint32_t index : indices) bounds.extend(scene::bounds_of(triangles[index]));
  return bounds;
}

/// Expects a whole tree: 2n - 1 nodes, one triangle a leaf, each triangle once, every box (the
/// root's children's, too) exactly that of the triangles below, no node too deep.
inline void expect_tight_tree(const Bvh& bvh, std::span<const Triangle> triangles) {
  const auto nodes = bvh.nodes();
  if (triangles.empty()) {
    EXPECT_TRUE(nodes.empty());
    return;
  }
  ASSERT_EQ(nodes.size(), 2 * triangles.size() - 1);
  const auto below = triangles_below(nodes);
  ASSERT_EQ(below[0].size(), triangles.size());
  for (std::uint32_t i = 0; i < below[0].size(); ++i) ASSERT_EQ(below[0][i], i);
  std::size_t loose = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_LE(nodes[i].count, 1U);
    loose += Bounds{nodes[i].min, nodes[i].max} == bounds_of_all(triangles, below[i]) ? 0 : 1;
  }
  EXPECT_EQ(loose, 0U) << "nodes whose box is not tight";
  std::uint32_t deepest = 0;
  std::size_t visited = 0;
  bvh.visit([&](const NodeView& node) {
    deepest = std::max(deepest, node.depth);
    ++visited;
    return true;
  });
  EXPECT_EQ(visited, nodes.size());
  EXPECT_EQ(bvh.stats().max_depth, deepest);
  EXPECT_LE(deepest, Bvh::kMaxDepth);
}

}  // namespace encore::accel::test
