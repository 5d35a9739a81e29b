#pragma once

#include "accel/array.h"
#include "accel/wide/wide_build.h"
#include "accel/wide/wide_build_kernels.h"
#include "accel/wide/wide_spatial_parts.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

namespace encore::accel {

/// A node above the subtrees. Its children: leaves after WideTopology::leaf; kSubtree and the
/// number of a subtree; else the number of another such node.
struct WideTopNode {
  static constexpr std::uint32_t kSubtree = 0x40000000U;
  std::uint32_t child[WideTree::kWidth];
};

/// Where a subtree's nodes and blocks begin in the tree.
struct WidePlace {
  std::uint32_t node, block;
};
/// The same of a node above the subtrees, and of its children.
struct WideTopPlace {
  std::uint32_t node;
  WidePlace child[WideTree::kWidth];
};

inline constexpr WideBox kEmptyWideBox{
    {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
     std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
     std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
     std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()}};

inline void extend(WideBox& box, const WideBox& by) {
  for (int i = 0; i < 8; ++i) box.ends[i] = std::min(box.ends[i], by.ends[i]);
}

/// References that a tree over so many triangles may have after long ones were split.
constexpr std::uint64_t most_wide_references(std::uint64_t triangles) {
  return std::min<std::uint64_t>(triangles + triangles / 2, WideTopology::kMostReferences);
}

/// Ranges of more than four references are divided until none is left, and a node is filled up to
/// eight children while it has such a range. So nodes that are not full have leaves alone, and at
/// least one pair of them that holds five references: with n references, L leaves and B such nodes
/// there are at most (L + 6 B) / 7 nodes and L <= n - 3 B, B <= n / 5. Leaves of more than one
/// block are such nodes left out.
constexpr std::uint64_t most_wide_nodes(std::uint64_t references) {
  return references * 8 / 35 + 1;
}

/// What a WideBuilder works with.
struct WideBuildMemory {
  Array<WideItem> items[2];
  Array<std::uint64_t> keys[2];
  Array<WidePlace> runs;        ///< of equal codes: first and number
  Array<std::uint32_t> digits;  ///< counts of the sort
  Array<WideTopology> nodes;    ///< of the subtrees
  Array<std::uint32_t> order;
  Array<WideTopNode> top;  ///< the root first; empty if the whole tree is one subtree
  Array<WideSubtree> subtrees;
  Array<WideTopPlace> top_places;
  Array<WidePlace> subtree_places;
  Array<WideBox> part_boxes;  ///< of parts of a pass
  Array<WideBins> part_bins;
  Array<WideSlabBins> part_slabs;  ///< three a part
  Array<WideBox> leaf_boxes;       ///< where leaves hold parts of triangles
  WideMorton morton;

  void release();
};

/// Ranges of at most this many items are left to one thread; where items are moved more, as it
/// takes many of them to keep several threads busy with one range.
inline constexpr std::uint32_t kWideSubtree = 4096;
inline constexpr std::uint32_t kLargeWideSubtree = 32768;
/// Elements of a part of a pass over triangles.
inline constexpr std::size_t kWidePart = 16384;
/// From this depth on ranges are halved by number, which ends within 28 more.
inline constexpr std::uint32_t kWideForcedDepth = 32;

/// One build: what its steps share.
struct WideBuildRun {
  const WideBuildKernels& kernels;
  std::span<const scene::Triangle> triangles;
  Workers& workers;
  BuildMeter& meter;
  MemoryMode mode;
  AllocationCount& allocations;
  WideBuildMemory& memory;
  WideBox box;         ///< of all triangles
  float unit = 1.0F;   ///< the power of two that brings it into [-1, 1]
  bool parts = false;  ///< items are parts of triangles: leaves' boxes are in memory.leaf_boxes
};

// The steps: the box of everything; the top of the tree and the list of subtrees; the subtrees;
// putting all of it in its place.
void find_wide_bounds(WideBuildRun& run);
void build_wide_morton(WideBuildRun& run);
void build_wide_sah(WideBuildRun& run, bool best);
void finish_wide_tree(WideBuildRun& run, WideTree& tree);

/// Runs body(i) for each of `count` pieces of work, several at once; progress goes on to `until`.
/// Where somebody watches, the threads meet before every few pieces to look: how often is then the
/// same every time.
template <class Body>
void for_wide_pieces(WideBuildRun& run, std::size_t count, double until, const Body& body) {
  const double from = run.meter.done();
  std::size_t together = std::max<std::size_t>(count, 1);
  if (run.meter.watched()) {
    together = run.workers.parallel() ? 8 * static_cast<std::size_t>(run.workers.threads()) : 1;
  }
  for (std::size_t first = 0; first < count; first += together) {
    run.meter.report(from +
                     (until - from) * static_cast<double>(first) / static_cast<double>(count));
    run.workers.for_parts(std::min(together, count - first), 1,
                          [&](std::size_t i, std::size_t) { body(first + i); });
  }
  run.meter.report(until);
}

/// The same for parts of elements [0, count): body(begin, end).
template <class Body>
void for_wide_parts(WideBuildRun& run, std::size_t count, double until, const Body& body) {
  for_wide_pieces(run, (count + kWidePart - 1) / kWidePart, until, [&](std::size_t i) {
    body(i * kWidePart, std::min(count, (i + 1) * kWidePart));
  });
}

}  // namespace encore::accel
