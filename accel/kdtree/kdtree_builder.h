#pragma once

#include "accel/array.h"
#include "accel/build_watch.h"
#include "accel/kdtree/kd_depth.h"
#include "accel/settings.h"
#include "scene/bounds.h"
#include "scene/triangle.h"
#include "shaders/shared/gpu_types.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace encore::accel {

/// A triangle in a node under construction: its index and the bounds of its part inside the node.
struct KdReference {
  glm::vec3 min;
  std::uint32_t triangle;
  glm::vec3 max;
  std::uint32_t unused;
};

inline KdReference kd_reference(std::span<const scene::Triangle> triangles, std::size_t index) {
  const scene::Bounds bounds = scene::bounds_of(triangles[index]);
  return {bounds.min, static_cast<std::uint32_t>(index), bounds.max, 0};
}

/// A node that waits to be built.
struct KdTask {
  scene::Bounds box;
  std::uint32_t parent = 0;      ///< whose upper child it is; the root and lower children: unused
  std::uint32_t count = 0;       ///< references
  std::uint32_t depth = 0;       ///< the root has 0
  std::uint32_t bad_splits = 0;  ///< on the path from the root
  std::uint64_t budget = 0;     ///< references and nodes of its subtree, where these are shared out
  std::uint64_t lower_end = 0;  ///< upper children: what may be spent once the lower one is built
  int last_axis = 2;            ///< the parent's; 2 at the root, so that round-robin starts at x
};

/// Where to split a node.
struct KdSplit {
  /// Against a leaf, where the splitter knows.
  enum class Worth { unknown, pays, costs };

  int axis = -1;             ///< -1: nowhere, make a leaf
  float position = 0.0F;     ///< strictly inside the node's box
  bool planar_below = true;  ///< the side of triangles that lie in the plane
  Worth worth = Worth::unknown;
};

/// Decides where nodes are split: the only thing that tells kd-trees apart.
class KdSplitter {
 public:
  virtual ~KdSplitter() = default;
  /// `references` are those of the task's node, in index order.
  virtual KdSplit choose(const KdTask& task, std::span<const KdReference> references) = 0;
};

/// The limits that end the splitting (thesis 3.2.1), worked out for one scene.
struct KdLimits {
  std::uint32_t depth;           ///< floor(offset + factor * log(#T)), within 0 .. kKdDepthCap
  std::uint32_t leaf_triangles;  ///< a node of at most this many is a leaf
  std::uint32_t bad_splits;      ///< a node below this many bad splits is a leaf
  std::int64_t bad_margin;       ///< a child with at most this many fewer than its parent is bad
  /// Triangles may be referenced from many leaves. 16 #T + 65,536 references in all are the limit
  /// (KdTreeSettings::most_references; at most 2^32 - 2), so that hostile scenes, in which every
  /// triangle spans everything, cannot fill the memory. See KdBuilder.
  std::uint64_t references;
};
KdLimits kd_limits(const KdTreeSettings& settings, std::size_t triangle_count);

/// What a build works in and what it made; kept from build to build in pool mode.
struct KdBuildMemory {
  Array<gpu::KdNode> nodes;
  Array<std::uint32_t> references;
  Array<KdReference> left;   ///< the references of the node in work, if it is a lower child
  Array<KdReference> right;  ///< a stack of batches: the upper children that wait
  AllocationCount allocations;
  std::uint32_t depth = 0;                  ///< of the deepest node; the root has 0
  bool limited = false;                     ///< KdLimits::references was not enough
  std::uint64_t references_classified = 0;  ///< summed over all nodes split
  std::uint64_t triangle_box_tests = 0;     ///< triangles cut to a child's box
};

/// The most that a builder ever had to have room for, were every reference of the next node to end
/// up on both sides; what KdLimits::references is compared with.
struct KdDemand {
  std::uint64_t references = 0;  ///< in leaves and waiting
  std::uint64_t nodes = 0;
  std::uint64_t waiting = 0;  ///< references

  void include(const KdDemand& other) {
    references = std::max(references, other.references);
    nodes = std::max(nodes, other.nodes);
    waiting = std::max(waiting, other.waiting);
  }
  [[nodiscard]] bool within(const KdLimits& limits, std::size_t triangle_count) const;
};

class KdTop;

/// Builds a kd-tree depth first, lower child first (thesis 3.2.1, iteratively). As there, two
/// global arrays hold the references of all nodes under construction: `left` is overwritten on the
/// way down, `right` is a stack of batches for upper children; both are flat and shared by all
/// nodes. A triangle goes to the sides that its part within the node reaches into, by exact
/// comparisons with the stored float plane: below if part of it is below, above if part of it is
/// above; what only touches the plane is on one side, and a ray through such a point visits both.
///
/// Bad splits are the thesis': a child with at most 3 fewer triangles than its parent lies below
/// one more. Where the splitter weighs splits against leaves, its verdict goes first, as in Pharr
/// and Humphreys: what costs more than a leaf is bad, and what pays is bad only if neither child
/// has fewer triangles. (The bare count would end `kd-sah` after cutting off five outliers or
/// pieces of empty space at the top, with nearly all triangles in one leaf.)
///
/// We also differ from the thesis in that the root counts as no bad split and that there is a limit
/// on references. A build that could exceed it, or fill more than as many nodes or a quarter as
/// many waiting references, begins anew: the limit is now shared out from the root down, to each
/// child by its triangles, and a node that could exceed its own share is a leaf; what a lower child
/// leaves of its share goes to the upper one. (Ending the first build's splits where the limit is
/// met would leave whatever is built last in one leaf.)
class KdBuilder {
 public:
  KdBuilder(std::span<const scene::Triangle> triangles, const KdLimits& limits, MemoryMode mode,
            KdBuildMemory& memory, BuildMeter& meter)
      : triangles_(triangles), limits_(limits), mode_(mode), memory_(memory), meter_(meter) {}

  /// `bounds`: of all triangles. Fills memory.nodes and memory.references. Throws BuildCancelled,
  /// after which only another run makes sense of the memory.
  void run(const scene::Bounds& bounds, KdSplitter& splitter);

  /// The same for one branch of a tree, whose references are in memory.left; indices are counted
  /// from the branch's own. False if it is beyond the limits by itself.
  bool run_branch(const KdTask& branch, KdSplitter& splitter);
  /// The same for what is above the branches, which `top` is given: each leaves one node that means
  /// nothing.
  bool run_top(const scene::Bounds& bounds, KdSplitter& splitter, KdTop& top);
  [[nodiscard]] const KdDemand& demand() const { return demand_; }

 private:
  friend class KdTop;
  struct Counts {
    std::uint32_t lower = 0;
    std::uint32_t upper = 0;
    std::uint64_t straddlers = 0;
  };

  void start(std::size_t count);
  void fill_left();
  bool grow(const KdTask& root, KdSplitter& splitter);
  [[nodiscard]] KdTask whole(const scene::Bounds& bounds) const;
  void finish();
  [[nodiscard]] KdDemand demand_of(const KdTask& task) const;
  [[nodiscard]] std::uint64_t waiting_with(const KdTask& task) const;
  /// Of the budget: references and nodes so far.
  [[nodiscard]] std::uint64_t spent() const { return leaf_references_ + node_count_; }
  [[nodiscard]] bool must_be_leaf(const KdTask& task) const;
  void add_leaf(std::span<const KdReference> references);
  void report(const KdTask& task, std::span<const KdTask> waiting);
  Counts partition(const KdTask& task, const KdSplit& split);
  Counts partition(const KdTask& task, const KdSplit& split, const KdReference* source,
                   std::uint32_t count, KdReference* lower, KdReference* upper,
                   BuildMeter& meter) const;
  void partition_straddler(const KdReference& reference, const KdTask& task, const KdSplit& split,
                           KdReference* lower_end, KdReference* upper_end, Counts& counts) const;
  [[nodiscard]] KdTask child(const KdTask& parent, const KdSplit& split, bool upper,
                             const Counts& counts) const;
  [[nodiscard]] KdReference* references_in_work(std::uint32_t count);

  std::span<const scene::Triangle> triangles_;
  KdLimits limits_;
  MemoryMode mode_;
  KdBuildMemory& memory_;
  BuildMeter& meter_;
  std::size_t node_count_ = 0;
  std::size_t leaf_references_ = 0;
  std::size_t right_count_ = 0;
  bool in_left_ = true;      ///< where the references of the node in work lie
  bool shared_out_ = false;  ///< whether tasks have budgets
  KdDemand demand_;
  KdTop* top_ = nullptr;  ///< who takes branches over, if anybody
};

}  // namespace encore::accel
