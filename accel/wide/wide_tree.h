#pragma once

#include "accel/array.h"
#include "accel/settings.h"
#include "shaders/shared/gpu_types.h"

#include <cstdint>

namespace encore::accel {

/// Triangles that a ray is held against at once: the corners of four as structure of arrays. What a
/// leaf has too few of is filled up with copies of its last one, which changes no result.
struct alignas(16) TriangleBlock {
  static constexpr std::uint32_t kSize = 4;
  float corner[3][3][kSize];  ///< [vertex][axis][lane]: exact copies of the scene's
};
static_assert(sizeof(TriangleBlock) == 144);

/// A child of a gpu::WideNode, as one number.
///
/// Inner node: its index. Leaf: bit 31 set, bits 28 to 30 its number of blocks less one, bits 0 to
/// 27 its first block. No child: kNoChild, with a box that no ray meets (lower ends +inf, upper
/// -inf).
struct WideChild {
  static constexpr std::uint32_t kNoChild = 0xFFFFFFFFU;
  static constexpr std::uint32_t kLeafBit = 0x80000000U;
  static constexpr std::uint32_t kMostBlocks = 1U << 28;
  static constexpr std::uint32_t kMostLeafBlocks = 8;

  [[gnu::always_inline]] static std::uint32_t leaf(std::uint32_t first_block,
                                                   std::uint32_t blocks) {
    return kLeafBit | (blocks - 1) << 28 | first_block;
  }
  [[gnu::always_inline]] static bool is_leaf(std::uint32_t child) {
    return (child & kLeafBit) != 0;
  }
  [[gnu::always_inline]] static std::uint32_t first_block(std::uint32_t child) {
    return child & (kMostBlocks - 1);
  }
  /// The same leaf without its first block; of leaves of at least two.
  [[gnu::always_inline]] static std::uint32_t next_block(std::uint32_t child) {
    return child - (1U << 28) + 1;
  }
  [[gnu::always_inline]] static std::uint32_t blocks(std::uint32_t child) {
    return (child >> 28 & 7U) + 1;
  }
};

/// A hierarchy of up to eight boxes a node (Wald, Benthin and Boulos 2008; Ernst and Greiner 2008),
/// as bvh-sah builds and traces it. Node 0 is the root, whose own box is `bounds`; children come
/// after their parent, and the nodes below any node lie together: [node's first descendant, last];
/// not always in the order of the children (wide_child_order.h).
/// A tree over at least one triangle has a root node, even if that has a single child.
///
/// Leaf slots: lane l of block b holds triangle ids[4 b + l]. A triangle may be in several leaves
/// (spatial splits). The lanes of one leaf that repeat its last triangle come last.
struct WideTree {
  static constexpr std::uint32_t kWidth = 8;
  /// No path from the root is longer, in nodes below it: what a traversal's stack has to hold is at
  /// most kWidth - 1 children a level, and one.
  static constexpr std::uint32_t kMaxDepth = 64;
  static constexpr std::uint32_t kStackSize = kMaxDepth * (kWidth - 1) + 1;

  Array<gpu::WideNode> nodes;
  Array<TriangleBlock> blocks;
  Array<std::uint32_t> ids;
  gpu::vec3 min, max;            ///< of all triangles
  std::uint32_t triangles = 0;   ///< distinct ones
  std::uint32_t references = 0;  ///< with those that are in several leaves; repetitions left out
  std::uint32_t leaves = 0;
  std::uint32_t depth = 0;  ///< longest path from the root, in nodes below it
};

/// What a traversal needs of it.
struct WideView {
  const gpu::WideNode* nodes;
  const TriangleBlock* blocks;
  const std::uint32_t* ids;
  std::uint32_t node_count;  ///< 0: no triangles, no hit
};

}  // namespace encore::accel
