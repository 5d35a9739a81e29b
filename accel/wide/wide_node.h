#pragma once

#include "accel/wide/wide_tree.h"
#include "scene/bounds.h"
#include "shaders/shared/gpu_types.h"

#include <cstdint>

namespace encore::accel {

/// The box of a node's child; empty where there is none.
inline scene::Bounds child_bounds(const gpu::WideNode& node, std::uint32_t child) {
  constexpr std::uint32_t kAxis = 2 * WideTree::kWidth;
  const float* const lower = node.bounds + child;
  const float* const upper = lower + WideTree::kWidth;
  return {{lower[0], lower[kAxis], lower[2 * kAxis]},
          {-upper[0], -upper[kAxis], -upper[2 * kAxis]}};
}

/// How many triangles a leaf refers to, without those that fill up its last block.
inline std::uint32_t leaf_references(const std::uint32_t* ids, std::uint32_t leaf) {
  const std::uint32_t* const first = ids + TriangleBlock::kSize * WideChild::first_block(leaf);
  std::uint32_t count = TriangleBlock::kSize * WideChild::blocks(leaf);
  while (count > 1 && first[count - 1] == first[count - 2]) --count;
  return count;
}

}  // namespace encore::accel
