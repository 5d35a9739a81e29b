#pragma once

#include "accel/acceleration_structure.h"
#include "accel/settings.h"

namespace encore::accel {

/// Tests every triangle: the oracle that all other structures must agree with.
class BruteForce final : public TracedStructure<BruteForce> {
 public:
  [[nodiscard]] std::string_view name() const override { return "brute"; }
  void build(std::span<const Triangle> triangles) override {
    mark_changed();
    triangles_ = {};
    BuildMeter meter(build_watch());
    meter.check();
    triangles_ = triangles;
    meter.finish();
  }
  [[nodiscard]] bool can_refit() const override { return true; }
  [[nodiscard]] BuildStats stats() const override;
  [[nodiscard]] GpuBuffers gpu_buffers() const override { return {}; }
  void visit(const std::function<bool(const NodeView&)>& visitor) const override;

  template <bool AnyHit, class Tester, class Counter>
  void trace(const Ray& ray, Hit& hit, Counter& counter) const;

 private:
  std::span<const Triangle> triangles_;
};

}  // namespace encore::accel
