#pragma once

#include "accel/acceleration_structure.h"
#include "accel/array.h"
#include "accel/bvh/bvh_depth.h"
#include "accel/bvh/bvh_quality.h"
#include "accel/parallel.h"
#include "accel/settings.h"
#include "accel/shared_meter.h"
#include "accel/simd/isa.h"
#include "shaders/shared/gpu_types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace encore::accel {

/// What the last update() found and did.
struct RefitCounts {
  std::uint64_t leaves_changed = 0;  ///< leaves whose bounds differ from their triangle's
  std::uint64_t leaves_written = 0;
  std::uint64_t inner_written = 0;
};

/// Binary bounding volume hierarchy over single triangles (thesis 3.3, after Lauterbach et al.
/// 2006): split at the spatial median, axes in turn, tight boxes, one triangle a leaf, so exactly
/// 2 #T - 1 nodes in one array that is allocated once.
///
/// The two children of a node lie side by side in one 64-byte line and always after their parent,
/// so that one pass over the array in reverse refits the tree. Leaves hold their triangle's index
/// itself; there is no array of references.
///
/// Where we differ from the thesis: no recursion; the tree's depth is bounded (see kMaxDepth); rays
/// go to the nearer child first and skip what begins behind the best hit; refitting shrinks boxes
/// too and reaches every node.
class Bvh final : public TracedStructure<Bvh> {
 public:
  static constexpr std::uint32_t kMaxSpatialDepth = kBvhMostSpatialDepth;
  static constexpr std::uint32_t kMaxDepth = kBvhMostDepth;

  Bvh(StructureKind kind, const BvhSettings& settings, MemoryMode memory);

  [[nodiscard]] std::string_view name() const override { return to_string(kind_); }
  /// Throws std::length_error for more than 2^31 triangles.
  void build(std::span<const Triangle> triangles) override;
  /// Refits every box to the moved triangles, bottom-up; the topology stays. Afterwards boxes are
  /// as tight as after build(). Builds instead if the number of triangles is another.
  ///
  /// BvhSettings::update_case other than `real` emulates the cost of a frame in which that share of
  /// the leaves moved (thesis 5.1.1), on a scene that stands still: leaves that count as unchanged
  /// keep their boxes even if their triangles did move.
  void update(std::span<const Triangle> triangles) override;
  [[nodiscard]] bool can_refit() const override { return true; }
  void assess() override { quality_.assess(nodes()); }
  [[nodiscard]] std::optional<double> decay() const override { return quality_.decay(); }
  [[nodiscard]] std::optional<double> assessed_cost() const override { return quality_.cost(); }
  [[nodiscard]] bool decayed() const override;
  [[nodiscard]] BuildStats stats() const override;
  [[nodiscard]] GpuBuffers gpu_buffers() const override;
  [[nodiscard]] gpu::StructureParameters gpu_parameters() const override;
  /// One bit a node, in 32-bit words: the leaves that an update of case `average` writes.
  [[nodiscard]] std::vector<std::uint32_t> average_case_leaves() const;
  [[nodiscard]] const BvhSettings& settings() const { return settings_; }
  void visit(const std::function<bool(const NodeView&)>& visitor) const override;

  template <bool AnyHit, class Tester, class Counter>
  void trace(const Ray& ray, Hit& hit, Counter& counter) const;

  /// The nodes; the root is the first. Empty if there are no triangles.
  [[nodiscard]] std::span<const gpu::BvhNode> nodes() const;
  [[nodiscard]] const RefitCounts& last_refit() const { return refit_; }
  /// Which instruction set traces tiles from now on; chosen_isa() unless a test asks for another.
  void set_isa(Isa isa) { isa_ = isa; }

 protected:
  void intersect_together(std::span<const Ray> rays, std::size_t width,
                          std::span<Hit> hits) const override;
  void occluded_together(std::span<const Ray> rays, std::size_t width,
                         std::span<std::uint8_t> blocked) const override;

 private:
  /// The two children of one node: a cache line.
  struct alignas(64) NodePair {
    gpu::BvhNode left, right;
  };
  /// A triangle while building: its bounds and its index.
  struct Item {
    glm::vec3 min;
    std::uint32_t triangle;
    glm::vec3 max;
    std::uint32_t unused;
  };
  struct Range;
  /// A node to be built, and all below it.
  struct Branch {
    std::uint32_t node, begin, end, depth;
    std::uint32_t next_child;  ///< where the nodes below it begin
    [[nodiscard]] std::uint32_t size() const { return end - begin; }
  };

  // Node 0, the root, is the right half of pair 0, whose left half is not used: so pair k holds the
  // nodes 2k - 1 and 2k.
  [[nodiscard]] gpu::BvhNode* root() { return reinterpret_cast<gpu::BvhNode*>(pairs_.data()) + 1; }
  [[nodiscard]] const gpu::BvhNode* root() const {
    return reinterpret_cast<const gpu::BvhNode*>(pairs_.data()) + 1;
  }

  /// NodeView::place, from what a traversal knows of a node anyway: the inner node whose children
  /// are pair k is k - 1, the leaf of triangle t is #T - 1 + t.
  [[nodiscard]] std::uint32_t place(std::uint32_t first, std::uint32_t count) const {
    return count == 0 ? (first - 1) / 2 : static_cast<std::uint32_t>(triangles_.size()) - 1 + first;
  }

  void build_over(std::span<const Triangle> triangles, BuildMeter& meter, const Workers& workers);
  void build_median(BuildMeter& meter, const Workers& workers);
  void fill_items(std::size_t begin, std::size_t end);
  Range fit(gpu::BvhNode& node, std::uint32_t begin, std::uint32_t end, BuildMeter& meter) const;
  [[nodiscard]] std::uint32_t split(const Range& range, std::uint32_t depth, BuildMeter& meter);
  /// Both return the depth of the deepest node.
  std::uint32_t build_branch(const Branch& branch, BuildMeter& meter);
  std::uint32_t build_together(const Branch& branch, SharedMeter& meter, const Workers& workers);

  /// Pairs [begin, end) that hold all nodes below some node.
  struct PairRange {
    std::size_t begin, end;
  };
  template <UpdateCase Case>
  void refit();
  template <UpdateCase Case>
  void refit_together(const Workers& workers);
  template <UpdateCase Case>
  void refit_pair(std::size_t pair, RefitCounts& counts);
  template <UpdateCase Case>
  bool refit_node(std::uint32_t index, RefitCounts& counts);
  void cut_into_branches(std::vector<PairRange>& branches, std::vector<std::size_t>& above) const;

  StructureKind kind_;
  BvhSettings settings_;
  MemoryMode memory_;
  Isa isa_ = chosen_isa();
  std::span<const Triangle> triangles_;
  Array<NodePair> pairs_;
  Array<Item> items_;            // building only
  Array<std::uint8_t> changed_;  // updating only: whether anything in pair k changed
  std::uint32_t max_depth_ = 0;
  AllocationCount allocations_;
  RefitCounts refit_;
  BvhQuality quality_;
};

}  // namespace encore::accel
