#pragma once

#include "accel/acceleration_structure.h"
#include "accel/kdtree/kd_tile.h"
#include "accel/kdtree/kdtree_build_sah.h"
#include "accel/kdtree/kdtree_builder.h"
#include "accel/kdtree/kdtree_top.h"
#include "accel/settings.h"

namespace encore::accel {

/// The kd-trees of thesis 3.2: `kd-median` (KD-M) halves boxes, the axes taking turns; `kd-sah`
/// (KD-S) splits where the surface area heuristic wants it. They differ in the splitter only.
///
/// Memory is bounded on any input: depth by kKdDepthCap, references and nodes by
/// KdLimits::references each, and nodes by 2^30.
class KdTree final : public TracedStructure<KdTree> {
 public:
  /// `kind`: kd_median or kd_sah.
  KdTree(StructureKind kind, const KdTreeSettings& settings, MemoryMode mode)
      : kind_(kind), settings_(settings), mode_(mode) {}

  [[nodiscard]] std::string_view name() const override;
  /// Throws std::length_error for 2^30 triangles or more, which a leaf could not count.
  void build(std::span<const Triangle> triangles) override;
  [[nodiscard]] BuildStats stats() const override;
  [[nodiscard]] GpuBuffers gpu_buffers() const override;
  [[nodiscard]] gpu::StructureParameters gpu_parameters() const override;
  void visit(const std::function<bool(const NodeView&)>& visitor) const override;

  /// Front to back with a stack (Pharr and Humphreys 2004, section 4.4.3), see kdtree_traverse.cpp.
  template <bool AnyHit, class Tester, class Counter>
  void trace(const Ray& ray, Hit& hit, Counter& counter) const;

  /// Work of the last build in elementary steps, independent of the machine: references
  /// classified, and for kd-sah ends sorted and candidates examined.
  [[nodiscard]] std::uint64_t build_operations() const;
  /// Which instruction set traces tiles from now on; chosen_isa() unless a test asks for another.
  void set_isa(Isa isa) { isa_ = isa; }

 protected:
  void intersect_together(std::span<const Ray> rays, std::size_t width,
                          std::span<Hit> hits) const override;
  void occluded_together(std::span<const Ray> rays, std::size_t width,
                         std::span<std::uint8_t> blocked) const override;

 private:
  [[nodiscard]] KdTileView tile_view() const;
  void build_over(std::span<const Triangle> triangles, BuildMeter& meter, const Workers& workers);
  void build_alone(const KdLimits& limits, BuildMeter& meter);
  bool build_together(const KdLimits& limits, BuildMeter& meter, const Workers& workers);

  StructureKind kind_;
  KdTreeSettings settings_;
  MemoryMode mode_;
  Isa isa_ = chosen_isa();
  std::span<const Triangle> triangles_;
  Bounds bounds_;
  KdBuildMemory memory_;
  KdSahMemory sah_memory_;
  KdTopMemory top_memory_;  ///< for builds with several threads
};

}  // namespace encore::accel
