#pragma once

#include "renderer/cpu_tracer.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace encore::app::test {

/// A device that hands everything on to the CPU tracer.
class CpuDevice : public renderer::Tracer {
 public:
  void init(const renderer::RenderInput& input) override { inner_.init(input); }
  void refresh() override { inner_.refresh(); }
  void draw(const scene::Camera& camera, int width, int height) override {
    inner_.draw(camera, width, height);
  }
  void read(renderer::Image& image) override { inner_.read(image); }
  void trace_hits(const scene::Camera& camera, int width, int height,
                  std::vector<scene::Hit>& hits) override {
    inner_.trace_hits(camera, width, height, hits);
  }
  void trace_counters(const scene::Camera& camera, int width, int height,
                      std::vector<accel::TraceCounters>& counters) override {
    inner_.trace_counters(camera, width, height, counters);
  }
  void trace_rays(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) override {
    inner_.trace_rays(rays, hits);
  }

 private:
  renderer::CpuTracer inner_{1};
};

/// A device that tells what `lie` makes of each right answer; its pictures are right. It "refits"
/// by trusting that the host updates the structure that both look at.
class LyingTracer final : public CpuDevice {
 public:
  using Lie = std::function<void(const scene::Ray* ray, std::size_t index, scene::Hit& hit)>;

  /// `lie` is told the ray where the device was given one, null for a camera's pixel.
  explicit LyingTracer(Lie lie = {}) : lie_(std::move(lie)) {}

  void init(const renderer::RenderInput& input) override {
    CpuDevice::init(input);
    calls_ += "i";
  }
  void refresh() override {
    CpuDevice::refresh();
    calls_ += "f";
  }
  [[nodiscard]] bool can_refit() const override { return true; }
  void refit() override { calls_ += "r"; }
  void trace_hits(const scene::Camera& camera, int width, int height,
                  std::vector<scene::Hit>& hits) override {
    CpuDevice::trace_hits(camera, width, height, hits);
    for (std::size_t i = 0; lie_ && i < hits.size(); ++i) lie_(nullptr, i, hits[i]);
    calls_ += "h";
  }
  void trace_rays(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) override {
    if (silent_) return;
    CpuDevice::trace_rays(rays, hits);
    for (std::size_t i = 0; lie_ && i < hits.size(); ++i) lie_(&rays[i], i, hits[i]);
  }

  /// From now on trace_rays() writes nothing.
  void fall_silent() { silent_ = true; }
  /// i: init, f: refresh, r: refit, h: trace_hits, in order.
  [[nodiscard]] const std::string& calls() const { return calls_; }

 private:
  Lie lie_;
  bool silent_ = false;
  std::string calls_;
};

}  // namespace encore::app::test
