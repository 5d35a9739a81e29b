#pragma once

#include "renderer/paths/path_worker.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace encore::renderer {

/// Traces whole pictures on the CPU where one ray a pixel is not enough: shadows, reflections and
/// refractions (Whitted 1980) and several samples a pixel.
///
/// A batch holds the rays of one kind and one depth, at most one a pixel of the tile: the camera
/// rays of one sample, then all that they mirror, and what those mirror …, depth first. So a batch
/// leaves behind at most as many rays of each kind as it has itself, a worker keeps two queues of
/// kBatchRays a level of depth, and its memory is bounded by 2 * depth * kBatchRays rays, though a
/// pixel's tree of rays may have 2^depth leaves. And a pixel's colours are added in the order of
/// its own tree (own colour, what is mirrored, what is seen through), whatever its neighbours do:
/// it depends on scene, camera and settings alone.
class CpuPaths {
 public:
  /// Makes ready for drawing what `needs` says with that many workers, and gives back what is no
  /// longer needed; without needs.paths() everything. Allocates only if something has grown.
  void prepare(const RenderInput& input, const scene::Needs& needs, const scene::RaySettings& rays,
               int workers);
  /// Whether there is anything that prepare() has made ready.
  [[nodiscard]] bool needed() const { return !workers_.empty(); }

  /// Before each picture: forgets the last one's figures.
  void begin_picture();
  /// Writes the means of those samples of a tile of at most kBatchRays pixels, row by row. Leaves
  /// `colors` as they are and returns false if `*cancel` turns true between two samples. `worker`:
  /// whose memory is used, of [0, workers); each by one thread at a time.
  bool draw_tile(const CameraFrame& frame, const PixelRect& tile, const SampleRange& samples,
                 int worker, const std::atomic<bool>* cancel, std::span<glm::vec3> colors);

  /// Of the picture since begin_picture().
  [[nodiscard]] RayFigures figures() const;
  [[nodiscard]] std::uint64_t camera_hits() const;
  /// What all workers keep.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  PathJob job_;
  std::vector<std::unique_ptr<PathWorker>> workers_;
};

}  // namespace encore::renderer
