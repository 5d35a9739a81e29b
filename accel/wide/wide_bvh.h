#pragma once

#include "accel/acceleration_structure.h"
#include "accel/wide/wide_build.h"
#include "accel/wide/wide_kernels.h"
#include "accel/wide/wide_tree.h"

#include <cstdint>
#include <optional>
#include <span>

namespace encore::accel {

/// Bounding volume hierarchy of up to eight children a node, built by the surface area heuristic or
/// along Morton codes (BuildPreset) and traced with the widest registers that the processor has:
/// what a tracer of today would use, beside the thesis' structures. Neighbouring rays go through it
/// in packets (intersect_tile).
///
/// A refit keeps the topology and fits all boxes, in place. The tree holds copies of the triangles'
/// corners: if those move without an update, rays find them where they were.
class WideBvh final : public AccelerationStructure {
 public:
  WideBvh(const BvhSettings& settings, MemoryMode memory);

  [[nodiscard]] std::string_view name() const override { return to_string(StructureKind::bvh_sah); }
  /// Throws std::length_error for more triangles than 2^28.
  void build(std::span<const Triangle> triangles) override;
  /// Builds instead if the number of triangles is another.
  void update(std::span<const Triangle> triangles) override;
  [[nodiscard]] bool can_refit() const override { return true; }
  void assess() override;
  [[nodiscard]] std::optional<double> decay() const override;
  [[nodiscard]] std::optional<double> assessed_cost() const override;
  [[nodiscard]] bool decayed() const override;

  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const override;
  void intersect_counted(std::span<const Ray> rays, std::span<Hit> hits,
                         std::span<TraceCounters> counters) const override;
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override;
  void trace_path(const Ray& ray, Hit& hit, RayPath& path) const override;

  [[nodiscard]] BuildStats stats() const override;
  /// Nodes and references (WideTree::ids); a GPU takes the corners from the scene.
  [[nodiscard]] GpuBuffers gpu_buffers() const override;
  [[nodiscard]] gpu::StructureParameters gpu_parameters() const override;
  /// Every box of the tree: inner nodes, and leaves with their triangles (repetitions left out).
  void visit(const std::function<bool(const NodeView&)>& visitor) const override;

  [[nodiscard]] const WideTree& tree() const { return tree_; }
  [[nodiscard]] const BvhSettings& settings() const { return settings_; }
  /// Which instruction set traces from now on; chosen_isa() unless a test asks for another.
  void set_isa(Isa isa) {
    single_ = &wide_single_kernels(isa);
    tiles_ = &wide_tile_kernels(isa);
  }

 protected:
  void intersect_together(std::span<const Ray> rays, std::size_t width,
                          std::span<Hit> hits) const override;
  void occluded_together(std::span<const Ray> rays, std::size_t width,
                         std::span<std::uint8_t> blocked) const override;

 private:
  [[nodiscard]] WideView view() const;
  void clear();
  /// NodeView::place: inner nodes by their index, leaves after them by their first block.
  [[nodiscard]] std::uint32_t place(std::uint32_t child) const {
    return WideChild::is_leaf(child)
               ? static_cast<std::uint32_t>(tree_.nodes.size()) + WideChild::first_block(child)
               : child;
  }
  template <class Tester, class Counter>
  void trace(const Ray& ray, Hit& hit, Counter& counter) const;

  BvhSettings settings_;
  MemoryMode memory_;
  const WideSingleKernels* single_;
  const WideTileKernels* tiles_;
  WideBuilder builder_;
  WideTree tree_;
  std::span<const Triangle> triangles_;
  AllocationCount allocations_;
  std::optional<double> built_cost_;  ///< SAH cost right after the last build, once assessed
  std::optional<double> cost_;        ///< as assess() last saw it; nothing after a change
  bool refitted_ = false;             ///< since the last build
};

}  // namespace encore::accel
