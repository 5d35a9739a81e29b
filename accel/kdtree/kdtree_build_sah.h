#pragma once

#include "accel/array.h"
#include "accel/kdtree/kdtree_builder.h"
#include "accel/parallel.h"
#include "accel/split_cost.h"

namespace encore::accel {

/// Memory of the SAH splitter, kept from build to build in pool mode.
struct KdSahMemory {
  Array<std::uint32_t> keys;
  AllocationCount allocations;
  std::uint64_t keys_sorted = 0;          ///< summed over all nodes
  std::uint64_t candidates_examined = 0;  ///< split positions, summed over all nodes

  void forget_counts() {
    allocations = {};
    keys_sorted = 0;
    candidates_examined = 0;
  }
};

/// Surface area heuristic after Pharr and Humphreys (2004, section 4.4): every end of a triangle's
/// extent within the node is a candidate; the box's longest axis is taken, the others only if it
/// offers no position inside the box. A split that costs more than a leaf is a bad one.
///
/// Differences: extents are those of clipped triangles; triangles that lie in the plane are tried
/// on both sides (Wald and Havran 2006); and the ends are sorted as bare numbers, lower and upper
/// ones apart, which is all that counting needs. Larger nodes are sorted by digits in linear time,
/// so that the whole build takes O(n log n).
class KdSahSplitter final : public KdSplitter {
 public:
  /// Asks for all its memory here. `triangle_count`: the most references a node may have. Several
  /// workers share the work of one large node.
  KdSahSplitter(const KdTreeSettings& settings, std::size_t triangle_count, MemoryMode mode,
                KdSahMemory& memory, BuildMeter& meter, const Workers& workers = Workers(1));

  KdSplit choose(const KdTask& task, std::span<const KdReference> references) override;

 private:
  KdSplit best_on_axis(const KdTask& task, std::span<const KdReference> references, int axis);
  /// Sort a node's ends on one axis; both return how many lie in a plane.
  std::size_t sort_ends(std::span<const KdReference> references, int axis);
  std::size_t sort_ends_together(std::span<const KdReference> references, int axis);

  KdTreeSettings settings_;
  std::size_t capacity_;
  KdSahMemory& memory_;
  BuildMeter& meter_;
  Workers workers_;
};

}  // namespace encore::accel
