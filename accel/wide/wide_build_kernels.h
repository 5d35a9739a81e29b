#pragma once

#include "accel/simd/isa.h"
#include "accel/wide/wide_tree.h"
#include "scene/triangle.h"

#include <cstddef>
#include <cstdint>

namespace encore::accel {

/// What a builder sorts: the box of a triangle, or of a part of it. The upper ends have their sign
/// turned, so that a union is one minimum of eight numbers. Coordinates are scaled by a power of
/// two that brings the scene into [-1, 1], so that no area or sum of theirs leaves single
/// precision.
struct alignas(32) WideItem {
  float lower[3];
  std::uint32_t triangle;  ///< with kTriangleBit, which makes a number of ordinary size of it
  float minus_upper[3];
  std::uint32_t reserved;

  static constexpr std::uint32_t kTriangleBit = 0x40000000U;
};
static_assert(sizeof(WideItem) == 32);

/// A box as WideItem has it; the fourth number of each half means nothing.
struct alignas(32) WideBox {
  float ends[8];
};

/// The children of a node whose boxes are not known yet: inner ones by their index, counted from
/// the root of the subtree; leaves by leaf().
struct WideTopology {
  std::uint32_t child[WideTree::kWidth];

  static constexpr std::uint32_t kMostReferences = 1U << 28;
  /// Of a leaf: two blocks cost a ray no more than a node with two leaves of one.
  static constexpr std::uint32_t kLargestLeaf = 2 * TriangleBlock::kSize;

  /// `count` 1 to kLargestLeaf references from `first` on, in the builder's order.
  [[gnu::always_inline]] static std::uint32_t leaf(std::uint32_t first, std::uint32_t count) {
    return WideChild::kLeafBit | (count - 1) << 28 | first;
  }
  static std::uint32_t first(std::uint32_t child) { return child & (kMostReferences - 1); }
  static std::uint32_t count(std::uint32_t child) { return (child >> 28 & 7U) + 1; }
  [[gnu::always_inline]] static std::uint32_t blocks(std::uint32_t count) {
    return (count + TriangleBlock::kSize - 1) / TriangleBlock::kSize;
  }
};

/// Items [begin, end) of one of two arrays: all that a split has to know of them.
struct WideRange {
  WideBox box;      ///< of the items
  WideBox centers;  ///< of the sums of their lower and upper ends: twice the centres
  std::uint32_t begin, end;
  std::uint32_t room;  ///< positions up to here are this range's own
  std::uint32_t array;
  float area;  ///< half the box's
};

/// How items fall into bins: along each axis (center - first) * scale, rounded down.
struct WideBinning {
  float first[4];
  float scale[4];  ///< 0: the centres do not differ along that axis
  std::uint32_t bins;
};

struct WideBins {
  static constexpr std::uint32_t kMost = 32;
  WideBox box[kMost][3];
  std::uint32_t count[kMost][4];
};

/// Items whose bin along `axis` lies below `bin` go left; axis 3: no plane divides them.
struct WideSplit {
  std::uint32_t axis = 3;
  std::uint32_t bin = 0;
  std::uint32_t left = 0;  ///< so many
  float cost = 0.0F;       ///< half areas times blocks
  WideBox box[2];
};

/// A subtree that one thread builds.
struct WideSubtree {
  WideRange range;
  std::uint32_t depth = 0;       ///< of its root
  std::uint32_t first_node = 0;  ///< where its nodes lie in the builder's array
  // What comes out:
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;
  std::uint32_t blocks = 0;
  std::uint32_t references = 0;
  std::uint32_t deepest = 0;
};

/// Where subtrees go.
struct WideBuildArrays {
  WideItem* items[2];
  const std::uint64_t* keys[2];  ///< Morton codes above the triangles' numbers (WideKeyRange)
  WideTopology* nodes;
  std::uint32_t* order;  ///< the triangle of each reference
  WideBox* leaf_boxes;   ///< by their leaf's first reference; null: boxes come from the triangles
  std::uint32_t bins;    ///< most of a node
  const struct WideSpatial* spatial;  ///< null: triangles are not split
};

/// How Morton codes are made of the boxes' centres: (center - first) * scale, rounded down, is a
/// place along each axis, and its bits go where `mask` has some.
struct WideMorton {
  float unit;      ///< what coordinates are multiplied by before
  float first[4];  ///< the scene's lower end, twice
  float scale[4];
  float most[4];  ///< the last place
  std::uint32_t mask[3];
  /// spread[axis][k][byte]: the bits that byte k of a place sets; places have 24 bits at most.
  std::uint32_t spread[3][3][256];
};

/// Which nodes' boxes are fitted: [begin, end).
struct WideFit {
  std::size_t begin, end;
  /// From here on blocks' triangles are fetched before their turn; those before may still be
  /// written by others.
  std::uint32_t first_block = 0;
  bool keep_leaves = false;  ///< the boxes of leaves are left as they are

  /// For WideFit::first_block: nothing is fetched early.
  static constexpr std::uint32_t kNoBlock = 0x7FFFFFFFU;
};

/// The inner loops of the builder for one instruction set (see wide_kernels.h). All give the same
/// tree.
struct WideBuildKernels {
  /// Extends `box` by triangles [begin, end).
  void (*bounds)(const scene::Triangle* triangles, std::size_t begin, std::size_t end,
                 WideBox& box);
  /// Makes the items of triangles [begin, end), extends `centers` by theirs.
  void (*items)(const scene::Triangle* triangles, std::size_t begin, std::size_t end, float scale,
                WideItem* items, WideBox& centers);
  /// Bins for items whose centres lie in `centers`, none of them with an item in it.
  void (*clear)(const WideBox& centers, std::uint32_t count, WideBinning& binning, WideBins& bins);
  /// Adds items to bins.
  void (*bin)(const WideItem* items, std::size_t begin, std::size_t end, const WideBinning& binning,
              WideBins& bins);
  void (*merge)(WideBins& into, const WideBins& from, std::uint32_t count);
  /// The cheapest plane.
  void (*split)(const WideBins& bins, const WideBinning& binning, WideSplit& split);
  /// Copies the left ones of items [begin, end) to `left`, the others to `right` and extends the
  /// boxes of both sides' centres.
  void (*part)(const WideItem* items, std::size_t begin, std::size_t end,
               const WideBinning& binning, const WideSplit& split, WideItem* left, WideItem* right,
               WideBox centers[2]);
  /// Boxes of items [begin, end) and of their centres.
  void (*fit_items)(const WideItem* items, std::size_t begin, std::size_t end, WideBox& box,
                    WideBox& centers);
  /// Codes above the numbers of triangles [begin, end).
  void (*keys)(const scene::Triangle* triangles, std::size_t begin, std::size_t end,
               const WideMorton& morton, std::uint64_t* keys);
  /// The box of the centres of the triangles that `count` keys name.
  void (*centers)(const scene::Triangle* triangles, const std::uint64_t* keys, std::size_t count,
                  float unit, WideBox& centers);
  /// Other codes for the same triangles; WideMorton::spread is not used.
  void (*refine)(const scene::Triangle* triangles, const std::uint64_t* keys, std::size_t count,
                 const WideMorton& morton, std::uint64_t* fine);
  void (*sah_subtree)(const WideBuildArrays& arrays, WideSubtree& subtree);
  void (*morton_subtree)(const WideBuildArrays& arrays, WideSubtree& subtree);
  /// Copies the corners of the leaves of some nodes into their blocks and fits the boxes, last node
  /// first.
  void (*fit)(const scene::Triangle* triangles, const std::uint32_t* ids, TriangleBlock* blocks,
              gpu::WideNode* nodes, const WideFit& fit);
};

/// Throws std::invalid_argument for an instruction set that is not among available_isas().
const WideBuildKernels& wide_build_kernels(Isa isa);

}  // namespace encore::accel
