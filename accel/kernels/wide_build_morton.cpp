#include "accel/kernels/wide_build_items.h"
#include "accel/kernels/wide_build_tables.h"
#include "accel/wide/wide_morton_range.h"

namespace encore::accel::ENCORE_ISA {

namespace {

class MortonSubtree {
 public:
  MortonSubtree(const WideBuildArrays& arrays, WideSubtree& subtree)
      : arrays_(arrays), nodes_(arrays.nodes + subtree.first_node), subtree_(subtree) {}

  void build(const WideKeyRange& range, std::uint32_t depth) {
    WideTopology& node = nodes_[subtree_.nodes++];
    if (depth > subtree_.deepest) subtree_.deepest = depth;
    WideKeyRange parts[WideTree::kWidth];
    parts[0] = range;
    std::uint32_t count = 1;
    while (count < WideTree::kWidth) {
      const std::uint32_t widest = widest_of(parts, count);
      if (widest == count) break;
      const std::uint32_t array = parts[widest].array;
      const std::uint32_t middle = divide_keys(arrays_.keys, parts[widest]);
      parts[count] = key_range(arrays_.keys, array, middle, parts[widest].end);
      parts[widest] = key_range(arrays_.keys, array, parts[widest].begin, middle);
      ++count;
    }
    for (std::uint32_t i = count; i < WideTree::kWidth; ++i) node.child[i] = WideChild::kNoChild;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (parts[i].end - parts[i].begin <= WideTopology::kLargestLeaf) {
        node.child[i] = leaf(parts[i]);
      } else {
        node.child[i] = subtree_.nodes;
        build(parts[i], depth + 1);
      }
    }
  }

 private:
  /// The part of the largest cell that is no leaf yet; `count` if all are.
  static std::uint32_t widest_of(const WideKeyRange* parts, std::uint32_t count) {
    std::uint32_t widest = count, level = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (parts[i].divisible() && parts[i].level >= level) {
        level = parts[i].level;
        widest = i;
      }
    }
    return widest;
  }

  std::uint32_t leaf(const WideKeyRange& range) {
    ++subtree_.leaves;
    subtree_.blocks += WideTopology::blocks(range.end - range.begin);
    subtree_.references += range.end - range.begin;
    const std::uint64_t* const keys = arrays_.keys[range.array];
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      arrays_.order[i] = static_cast<std::uint32_t>(keys[i]);
    }
    return WideTopology::leaf(range.begin, range.end - range.begin);
  }

  const WideBuildArrays& arrays_;
  WideTopology* const nodes_;
  WideSubtree& subtree_;
};

/// Asks for keys, which are looked at here and there, each look telling where the next one is.
void fetch(const std::uint64_t* keys, std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kLine = 64 / sizeof(std::uint64_t);
  for (std::uint32_t i = begin; i < end; i += kLine) __builtin_prefetch(keys + i);
}

}  // namespace

void build_morton_subtree(const WideBuildArrays& arrays, WideSubtree& subtree) {
  subtree.nodes = subtree.leaves = subtree.blocks = subtree.references = 0;
  subtree.deepest = subtree.depth;
  const WideRange& range = subtree.range;
  fetch(arrays.keys[range.array], range.begin, range.end);
  MortonSubtree(arrays, subtree)
      .build(key_range(arrays.keys, range.array, range.begin, range.end), subtree.depth);
}

void build_bounds(const scene::Triangle* triangles, std::size_t begin, std::size_t end,
                  WideBox& box) {
  bounds_of_triangles(triangles, begin, end, box);
}

void build_items(const scene::Triangle* triangles, std::size_t begin, std::size_t end, float scale,
                 WideItem* items, WideBox& centers) {
  items_of_triangles(triangles, begin, end, scale, items, centers);
}

void build_keys(const scene::Triangle* triangles, std::size_t begin, std::size_t end,
                const WideMorton& morton, std::uint64_t* keys) {
  keys_of_triangles(triangles, begin, end, morton, keys);
}

void build_centers(const scene::Triangle* triangles, const std::uint64_t* keys, std::size_t count,
                   float unit, WideBox& centers) {
  centers_of_keys(triangles, keys, count, unit, centers);
}

void build_refine(const scene::Triangle* triangles, const std::uint64_t* keys, std::size_t count,
                  const WideMorton& morton, std::uint64_t* fine) {
  refine_keys(triangles, keys, count, morton, fine);
}

}  // namespace encore::accel::ENCORE_ISA
