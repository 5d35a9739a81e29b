#pragma once

#include "accel/array.h"
#include "accel/kdtree/kdtree_build_sah.h"
#include "accel/kdtree/kdtree_builder.h"
#include "accel/parallel.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace encore::accel {

/// A part of a tree that one thread builds: a node and all below it.
struct KdBranch {
  KdTask task;
  std::uint32_t node = 0;         ///< of the top, in whose place it comes
  std::uint64_t waiting = 0;      ///< references that wait beside its own while it is built
  std::uint64_t leaf_before = 0;  ///< references in leaves of the top that come before it
  KdDemand demand;                ///< its own
  KdBuildMemory memory;
  KdSahMemory sah_memory;
};

/// Memory of such builds, kept from build to build in pool mode.
struct KdTopMemory {
  KdBuildMemory top;
  KdSahMemory sah;
  Array<KdReference> lower;  ///< by parts, what of a node's references goes to its lower child
  Array<KdReference> upper;
  std::vector<KdBranch> branches;
};

/// Builds the tree that KdBuilder builds by itself, node for node, with several threads: those
/// above the branches one after the other, the threads sharing the work of each; then the branches,
/// each by one thread. Branches are cut by their size, so they are the same for any number of
/// threads.
///
/// Whether the limits (KdLimits) are in the way is worked out afterwards, exactly as KdBuilder
/// would have seen it: from what each branch needed by itself and what would have been there before
/// it.
class KdTop {
 public:
  /// All must outlive it.
  KdTop(std::span<const scene::Triangle> triangles, const KdLimits& limits, MemoryMode mode,
        KdTopMemory& memory, BuildMeter& meter, const Workers& workers);

  /// Fills `tree` and the counts of `sah`; false if the limits are in the way, after which both
  /// mean nothing. `settings` null: the spatial median. Throws BuildCancelled.
  bool build(const scene::Bounds& bounds, const KdTreeSettings* settings, KdBuildMemory& tree,
             KdSahMemory& sah);

  // For KdBuilder.

  /// Writes the references of all triangles.
  void fill(std::span<const scene::Triangle> triangles, KdReference* references) const;
  /// Takes a node over if it is small enough for a branch.
  bool take(const KdBuilder& builder, const KdTask& task, std::span<const KdReference> references);
  /// KdBuilder::partition by all threads. `source` may be where the results go.
  KdBuilder::Counts partition(const KdBuilder& builder, const KdTask& task, const KdSplit& split,
                              const KdReference* source, KdReference* lower, KdReference* upper);

 private:
  /// What was looked at before a node of the top was split.
  struct Check {
    KdDemand demand;
    std::size_t branches;  ///< that come before it
  };

  bool build_branches(const KdTreeSettings* settings);
  [[nodiscard]] bool within_limits() const;
  void join(KdBuildMemory& tree, KdSahMemory& sah);
  void join_top(KdBuildMemory& tree);

  std::span<const scene::Triangle> triangles_;
  KdLimits limits_;
  MemoryMode mode_;
  KdTopMemory& memory_;
  BuildMeter& meter_;
  Workers workers_;
  std::uint32_t branch_size_;
  std::size_t branch_count_ = 0;
  std::vector<Check> checks_;
};

}  // namespace encore::accel
