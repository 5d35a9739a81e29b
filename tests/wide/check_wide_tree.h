#pragma once

#include "accel/wide/wide_build.h"
#include "accel/wide/wide_node.h"
#include "scene/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace encore::accel::test {

using Triangles = std::vector<scene::Triangle>;

/// A builder and its tree.
struct BuiltTree {
  explicit BuiltTree(const Triangles& triangles, BuildPreset preset, int threads = 1,
                     MemoryMode memory = MemoryMode::fresh)
      : builder(memory) {
    build(triangles, preset, threads);
  }
  void build(const Triangles& triangles, BuildPreset preset, int threads = 1) {
    allocations = {};
    BuildMeter meter(nullptr);
    Workers workers(threads);
    workers.run([&] { builder.build(triangles, preset, workers, meter, tree, allocations); });
  }
  void refit(const Triangles& triangles, int threads = 1) {
    Workers workers(threads);
    workers.run([&] { builder.refit(triangles, workers, tree); });
  }

  WideBuilder builder;
  WideTree tree;
  AllocationCount allocations;
};

inline scene::Bounds union_of(scene::Bounds a, const scene::Bounds& b) {
  a.extend(b);
  return a;
}

/// What a walk over a tree collects and holds against its promises.
class TreeCheck {
 public:
  /// Leaves may hold parts of triangles: their boxes need not be tight.
  TreeCheck(const WideTree& tree, const Triangles& triangles, bool parts)
      : tree_(tree), triangles_(triangles), parts_(parts), seen_(triangles.size(), 0) {}

  void check() {
    ASSERT_EQ(tree_.triangles, triangles_.size());
    if (triangles_.empty()) {
      EXPECT_TRUE(tree_.nodes.empty() && tree_.blocks.empty() && tree_.ids.empty());
      return;
    }
    ASSERT_FALSE(tree_.nodes.empty());
    ASSERT_EQ(tree_.ids.size(), 4 * tree_.blocks.size());
    std::size_t end = 0;
    const scene::Bounds all = node(0, 0, end);
    ASSERT_FALSE(testing::Test::HasFatalFailure());
    EXPECT_EQ(end, tree_.nodes.size());
    EXPECT_EQ(all, (scene::Bounds{tree_.min, tree_.max}));
    EXPECT_EQ(leaves_, tree_.leaves);
    EXPECT_EQ(blocks_, tree_.blocks.size());
    EXPECT_EQ(references_, tree_.references);
    EXPECT_EQ(deepest_, tree_.depth);
    EXPECT_LE(deepest_, WideTree::kMaxDepth);
    EXPECT_EQ(std::count(seen_.begin(), seen_.end(), 0), 0) << "triangles in no leaf";
    EXPECT_GE(references_, triangles_.size());
    if (!parts_) {
      EXPECT_EQ(references_, triangles_.size());
    }
    EXPECT_EQ(loose_, 0U) << "boxes that are not tight";
    EXPECT_EQ(wrong_lanes_, 0U) << "corners that are not the scene's";
  }

 private:
  /// Checks what is below a node, whose box is returned; `end` becomes one past its last
  /// descendant.
  scene::Bounds node(std::size_t index, std::uint32_t depth, std::size_t& end) {
    scene::Bounds all;
    end = index + 1;
    deepest_ = std::max(deepest_, depth);
    if (index >= tree_.nodes.size()) {
      ADD_FAILURE() << "no node " << index;
      return all;
    }
    const gpu::WideNode& node = tree_.nodes[index];
    bool empty_before = false;
    std::vector<std::pair<std::uint32_t, scene::Bounds>> inner;
    for (std::uint32_t k = 0; k < WideTree::kWidth; ++k) {
      const scene::Bounds box = child_bounds(node, k);
      if (node.child[k] == WideChild::kNoChild) {
        EXPECT_EQ(box, scene::Bounds{});
        empty_before = true;
        continue;
      }
      EXPECT_FALSE(empty_before) << "empty places come last";
      all.extend(box);
      if (WideChild::is_leaf(node.child[k])) {
        leaf(node.child[k], box);
        continue;
      }
      inner.emplace_back(node.child[k], box);
    }
    std::sort(inner.begin(), inner.end(), [](auto& a, auto& b) { return a.first < b.first; });
    for (const auto& [child, box] : inner) {
      EXPECT_EQ(child, end) << "subtrees lie one after the other";
      if (child <= index) return all;
      loose_ += this->node(child, depth + 1, end) == box ? 0 : 1;
    }
    return all;
  }

  void leaf(std::uint32_t child, const scene::Bounds& box) {
    ++leaves_;
    blocks_ += WideChild::blocks(child);
    const std::size_t first = 4 * std::size_t{WideChild::first_block(child)};
    const std::uint32_t count = 4 * WideChild::blocks(child);
    ASSERT_LE(first + count, tree_.ids.size());
    const std::uint32_t held = leaf_references(tree_.ids.data(), child);
    references_ += held;
    scene::Bounds whole;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t id = tree_.ids[first + i];
      ASSERT_LT(id, triangles_.size());
      if (i < held) ++seen_[id];
      whole.extend(scene::bounds_of(triangles_[id]));
      wrong_lanes_ += lane_is(tree_.blocks[(first + i) / 4], i % 4, triangles_[id]) ? 0 : 1;
    }
    const bool fits = parts_ ? union_of(whole, box) == whole : whole == box;
    loose_ += fits ? 0 : 1;
  }

  static bool lane_is(const TriangleBlock& block, std::uint32_t lane, const scene::Triangle& t) {
    const glm::vec3* const corners[3] = {&t.v0, &t.v1, &t.v2};
    for (int corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        const float expected = (*corners[corner])[axis];
        if (std::memcmp(&block.corner[corner][axis][lane], &expected, sizeof expected) != 0) {
          return false;
        }
      }
    }
    return true;
  }

  const WideTree& tree_;
  const Triangles& triangles_;
  bool parts_;
  std::vector<int> seen_;
  std::size_t leaves_ = 0, blocks_ = 0, references_ = 0, loose_ = 0, wrong_lanes_ = 0;
  std::uint32_t deepest_ = 0;
};

inline void expect_sound(const WideTree& tree, const Triangles& triangles, bool parts = false) {
  TreeCheck(tree, triangles, parts).check();
}

inline bool same(const WideTree& a, const WideTree& b) {
  const auto equal = [](std::span<const std::byte> x, std::span<const std::byte> y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size()) == 0);
  };
  return equal(a.nodes.bytes(), b.nodes.bytes()) && equal(a.blocks.bytes(), b.blocks.bytes()) &&
         equal(a.ids.bytes(), b.ids.bytes());
}

/// Boxes and blocks that a random ray through the root's box meets on average.
inline double cost_of(const WideTree& tree) {
  const double root = scene::Bounds{tree.min, tree.max}.area();
  double sum = 0.0;
  for (const gpu::WideNode& node : tree.nodes.span()) {
    for (std::uint32_t k = 0; k < WideTree::kWidth; ++k) {
      if (node.child[k] == WideChild::kNoChild) continue;
      const std::uint32_t blocks =
          WideChild::is_leaf(node.child[k]) ? WideChild::blocks(node.child[k]) : 1;
      sum += child_bounds(node, k).area() / root * blocks;
    }
  }
  return sum;
}

}  // namespace encore::accel::test
