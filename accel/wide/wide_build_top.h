#pragma once

#include "accel/wide/wide_build_memory.h"

#include <cstdint>

namespace encore::accel {

/// Where a range that nothing divides is halved: whole blocks on the left.
inline std::uint32_t wide_middle(std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kBlock = TriangleBlock::kSize;
  return begin + (end - begin + 2 * kBlock - 1) / (2 * kBlock) * kBlock;
}

/// Divides a range from the top until what is left is small enough for one thread; lists the
/// subtrees from left to right. `Rules` says what a range is, which to divide first, and how.
template <class Rules>
class WideTop {
 public:
  using Range = typename Rules::Range;

  /// Ranges of at most `subtree` items are left to one thread.
  WideTop(WideBuildRun& run, Rules& rules, std::uint32_t subtree)
      : run_(run), rules_(rules), subtree_(subtree) {}

  void build(const Range& all) {
    WideBuildMemory& memory = run_.memory;
    // The arrays grow only where a build has more nodes up here than any before.
    memory.top.reset(0, run_.mode, run_.allocations);
    memory.subtrees.reset(0, run_.mode, run_.allocations);
    if (all.end - all.begin <= subtree_) {
      add_subtree(all, 0);
    } else {
      node(all, 0);
    }
    memory.nodes.reset(next_node_, run_.mode, run_.allocations);
  }

 private:
  std::uint32_t node(const Range& range, std::uint32_t depth) {
    const auto index = static_cast<std::uint32_t>(run_.memory.top.size());
    run_.memory.top.grow(index + 1, run_.allocations);
    Range parts[WideTree::kWidth];
    parts[0] = range;
    std::uint32_t count = 1;
    for (; count < WideTree::kWidth; ++count) {
      Range* const widest = widest_of(parts, count);
      if (widest == nullptr) break;
      rules_.divide(*widest, parts[count], depth);
    }
    for (std::uint32_t i = 0; i < WideTree::kWidth; ++i) {
      // Nodes move in memory as more are made.
      const std::uint32_t child = i < count ? child_of(parts[i], depth + 1) : WideChild::kNoChild;
      run_.memory.top[index].child[i] = child;
    }
    return index;
  }

  std::uint32_t child_of(const Range& range, std::uint32_t depth) {
    const std::uint32_t size = range.end - range.begin;
    if (size <= WideTopology::kLargestLeaf) return rules_.leaf(range);
    if (size <= subtree_) return WideTopNode::kSubtree | add_subtree(range, depth);
    return node(range, depth);
  }

  static Range* widest_of(Range* parts, std::uint32_t count) {
    Range* widest = nullptr;
    for (Range* part = parts; part < parts + count; ++part) {
      if (!Rules::divisible(*part)) continue;
      if (widest == nullptr || Rules::wider(*part, *widest)) widest = part;
    }
    return widest;
  }

  std::uint32_t add_subtree(const Range& range, std::uint32_t depth) {
    Array<WideSubtree>& subtrees = run_.memory.subtrees;
    const auto index = static_cast<std::uint32_t>(subtrees.size());
    subtrees.grow(index + 1, run_.allocations);
    WideSubtree subtree;
    subtree.range = rules_.subtree(range);
    subtree.depth = depth;
    subtree.first_node = next_node_;
    subtrees[index] = subtree;
    next_node_ += static_cast<std::uint32_t>(most_wide_nodes(Rules::room(range)));
    return index;
  }

  WideBuildRun& run_;
  Rules& rules_;
  const std::uint32_t subtree_;
  std::uint32_t next_node_ = 0;
};

}  // namespace encore::accel
