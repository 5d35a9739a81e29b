#pragma once

#include "renderer/camera_rays.h"
#include "renderer/paths/ray_clock.h"
#include "renderer/paths/shadowed_shading.h"
#include "renderer/renderer.h"
#include "renderer/shading.h"
#include "scene/needs.h"

#include <glm/vec3.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace encore::renderer {

/// Which samples of each pixel a picture is made of.
struct SampleRange {
  std::uint32_t first = 0;
  std::uint32_t count = 1;
};

/// What all workers read while they draw.
struct PathJob {
  RenderInput input;
  scene::Needs needs;
  scene::RaySettings rays;
  ShadeFunction shade = nullptr;
  ShadowedShadeFunction shade_shadowed = nullptr;

  [[nodiscard]] bool bounces() const { return needs.reflections || needs.refractions; }
};

/// What one thread needs to trace a tile with all of its rays (cpu_paths.h says in which order).
class PathWorker {
 public:
  /// Makes room for what the job needs, and for nothing else.
  void fit(const PathJob& job);

  void begin_picture();
  /// As CpuPaths::draw_tile().
  bool draw_tile(const PathJob& job, const CameraFrame& frame, const PixelRect& tile,
                 const SampleRange& samples, const std::atomic<bool>* cancel,
                 std::span<glm::vec3> colors);

  [[nodiscard]] const RayFigures& figures() const { return clock_.figures(); }
  [[nodiscard]] std::uint64_t camera_hits() const { return camera_hits_; }
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  /// Rays of one kind and depth, at most one a pixel.
  struct Queue {
    std::array<scene::Ray, kBatchRays> rays;
    std::array<glm::vec3, kBatchRays> weights;
    std::array<std::uint32_t, kBatchRays> pixels;  ///< places in the tile
    std::size_t count = 0;

    void push(const Continuation& next, const glm::vec3& weight_before, std::uint32_t pixel);
  };
  /// The rays that one batch leaves behind.
  struct Level {
    Queue reflections;
    Queue refractions;
  };
  /// The hits of a batch whose own colour is seen, side by side.
  struct OwnColors {
    std::array<scene::Ray, kBatchRays> rays;
    std::array<scene::Hit, kBatchRays> hits;
    std::array<glm::vec3, kBatchRays> weights;
    std::array<std::uint32_t, kBatchRays> pixels;
    std::size_t count = 0;
  };
  struct BounceSpace {
    Queue camera;
    OwnColors own;
    std::array<glm::vec3, kBatchRays> light;  ///< of one sample, a pixel each
  };

  /// One sample of each of the rays' pixels, into colors_.
  template <bool kShadows>
  void cast_sample(const PathJob& job, std::span<const scene::Ray> rays, std::size_t width);
  template <bool kShadows>
  void bounce_sample(const PathJob& job, const PixelRect& tile);
  /// Adds what a batch brings back, with all that follows from it, to the pixels' light. `width`:
  /// of the batch's rays as a rectangle; those of some of a tile's pixels are a row.
  template <bool kShadows>
  void trace(const PathJob& job, const Queue& batch, std::size_t width, scene::RayKind kind,
             std::size_t depth);
  /// Sees to what a batch's rays have hit: own colours are collected, further rays queued.
  void scatter_batch(const PathJob& job, const Queue& batch, std::size_t depth);
  template <bool kShadows>
  void shade_batch(const PathJob& job, std::span<const scene::Ray> rays,
                   std::span<const scene::Hit> hits, scene::RayKind kind);

  RayClock clock_;
  std::uint64_t camera_hits_ = 0;
  std::array<scene::Ray, kBatchRays> rays_;
  std::array<scene::Hit, kBatchRays> hits_;
  std::array<glm::vec3, kBatchRays> colors_;
  std::array<glm::vec3, kBatchRays> sums_;
  std::unique_ptr<std::array<SurfacePoint, kBatchRays>> points_;
  std::unique_ptr<ShadowSpace> shadows_;
  std::unique_ptr<BounceSpace> bounces_;
  std::vector<Level> levels_;  ///< one a depth that may be reached
};

}  // namespace encore::renderer
