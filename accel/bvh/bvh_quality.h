#pragma once

#include "shaders/shared/gpu_types.h"

#include <optional>
#include <span>

namespace encore::accel {

/// The surface area heuristic's cost of a hierarchy (see BuildStats::sah_cost): areas of all boxes,
/// a leaf's times its triangles, over the root's; 0 if the root has no area. One pass over the
/// nodes, in order.
double bvh_sah_cost(std::span<const gpu::BvhNode> nodes);

/// Nearly the same for about a fifth of the time, for hierarchies of some size: the boxes whose
/// area is at least 1/64 of the root's all count, found from the root down; of the others, whose
/// number is large and weight small, a sample stands for all (32 neighbours of every 256). Small
/// hierarchies are counted whole. Children must lie side by side.
double bvh_sah_cost_sampled(std::span<const gpu::BvhNode> nodes);

/// How a hierarchy ages under refits. Only the ratio of its cost to what it was after the build
/// tells: what costs much may be as good as it gets for its scene.
class BvhQuality {
 public:
  /// After a build: nothing is known of it yet.
  void forget() { *this = {}; }
  /// After a refit: what was known holds no more, apart from the cost after the build.
  void outdate() {
    refitted_ = true;
    now_.reset();
  }
  /// Looks at the nodes as they are, at a sample of large hierarchies.
  void assess(std::span<const gpu::BvhNode> nodes);

  /// Cost now over that after the build, 1 or about it for a good tree. Nothing if the nodes were
  /// not looked at since the last change, or not before the first refit.
  [[nodiscard]] std::optional<double> decay() const;
  /// The cost itself; nothing if the nodes were not looked at since the last change.
  [[nodiscard]] std::optional<double> cost() const { return now_; }

 private:
  std::optional<double> built_;  ///< cost after the build
  std::optional<double> now_;
  bool refitted_ = false;
};

}  // namespace encore::accel
