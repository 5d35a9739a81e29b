#pragma once

#include "accel/acceleration_structure.h"
#include "app/bench/embree.h"

namespace encore::app::bench {

/// Embree in the place of one of our structures, so that the same tracer draws with it. Only what a
/// tracer asks for: it counts nothing and has no nodes to show. Tiles go in packets of 4 x 4 rays,
/// put together on the way.
class EmbreeStructure final : public accel::AccelerationStructure {
 public:
  EmbreeStructure(EmbreeDevice& device, const EmbreeSettings& settings);

  [[nodiscard]] std::string_view name() const override { return name_; }
  void build(std::span<const accel::Triangle> triangles) override;
  void update(std::span<const accel::Triangle> triangles) override;
  [[nodiscard]] bool can_refit() const override { return settings_.refit; }
  void intersect(std::span<const accel::Ray> rays, std::span<accel::Hit> hits) const override;
  void intersect_counted(std::span<const accel::Ray> rays, std::span<accel::Hit> hits,
                         std::span<accel::TraceCounters> counters) const override;
  void occluded(std::span<const accel::Ray> rays, std::span<std::uint8_t> blocked) const override;
  [[nodiscard]] accel::BuildStats stats() const override { return {}; }
  [[nodiscard]] accel::GpuBuffers gpu_buffers() const override { return {}; }
  void visit(const std::function<bool(const accel::NodeView&)>&) const override {}

 protected:
  void intersect_together(std::span<const accel::Ray> rays, std::size_t width,
                          std::span<accel::Hit> hits) const override;

 private:
  EmbreeSettings settings_;
  std::string name_;
  EmbreeScene scene_;
  std::size_t built_ = 0;  ///< triangles
};

}  // namespace encore::app::bench
