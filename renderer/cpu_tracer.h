#pragma once

#include "accel/counters.h"
#include "renderer/paths/cpu_paths.h"
#include "renderer/renderer.h"
#include "renderer/shading.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace encore::renderer {

/// Ray casting on the CPU, tile by tile over threads; with shadows, bounces or several samples a
/// pixel where set_rays() asks for them and the scene has a use for them (paths/cpu_paths.h).
///
/// A tile is one batch: its rays are made in a buffer on the stack, traced by one virtual call of
/// the structure, and shaded straight into the image. A pixel depends on nothing but the scene and
/// the camera, so pictures are the same bit for bit for any number of threads and, by the hit
/// contract, for any structure. After the first frame nothing is allocated.
///
/// One object draws one frame at a time; several objects may share scene and structure.
class CpuTracer final : public Tracer {
 public:
  /// `threads` workers, 0: as many as the machine has. One worker runs in the calling thread.
  explicit CpuTracer(int threads = 0);

  /// Throws std::invalid_argument if a part of the input is missing.
  void init(const RenderInput& input) override;
  void set_rays(const scene::RaySettings& rays) override { rays_ = rays; }
  /// Looks again at what the scene needs (normals, colours, highlights, textures, which rays).
  void refresh() override;
  /// Throws std::logic_error before init(), std::invalid_argument for a camera or an image size
  /// that make_camera_frame() rejects.
  void render(const scene::Camera& camera, Image& image) override;
  void draw(const scene::Camera& camera, int width, int height) override;
  /// Throws std::invalid_argument also if there are no such samples.
  void draw_samples(const scene::Camera& camera, int width, int height, std::uint32_t first,
                    std::uint32_t count) override;
  void read(Image& image) override { image = picture_; }

  /// These throw as render() does.
  void trace_hits(const scene::Camera& camera, int width, int height,
                  std::vector<scene::Hit>& hits) override;
  void trace_counters(const scene::Camera& camera, int width, int height,
                      std::vector<accel::TraceCounters>& counters) override;
  void trace_rays(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) override;

  /// Tiles that have not begun are left as they are, and so are those of which samples are missing.
  void set_cancel_flag(const std::atomic<bool>* flag) override { cancel_ = flag; }
  [[nodiscard]] bool complete() const override { return complete_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::optional<std::uint64_t> last_hits() const override { return hit_count(); }
  /// Rays of the last frame that hit something.
  [[nodiscard]] std::uint64_t hit_count() const { return hits_.load(std::memory_order_relaxed); }
  /// Seconds are told apart only where there may be rays of several kinds or samples.
  [[nodiscard]] std::optional<RayFigures> last_rays() const override { return figures_; }
  [[nodiscard]] int threads() const { return threads_; }

 private:
  /// Calls work(PixelRect) for every tile of the image, over all threads.
  template <class TileWork>
  void for_each_tile(int width, int height, const TileWork& work);
  void check_ready() const;
  [[nodiscard]] CameraFrame frame_for(const scene::Camera& camera, const Image& image) const;
  /// One ray through each pixel's centre.
  void cast(const CameraFrame& frame, Image& image);
  /// All rays that the pictures' samples ask for.
  void trace_paths(const CameraFrame& frame, const SampleRange& samples, Image& image);

  RenderInput input_;
  scene::RaySettings rays_;
  Image picture_;                  ///< of draw()
  ShadeFunction shade_ = nullptr;  ///< the variant that this scene needs
  CpuPaths paths_;                 ///< if there is more to do than casting
  std::uint32_t samples_ = 1;      ///< a pixel, as of the last refresh
  std::optional<RayFigures> figures_;
  int threads_ = 1;
  std::optional<tbb::global_control> more_threads_;  ///< only if there are more than processors
  std::optional<tbb::task_arena> arena_;             ///< only if there is more than one thread
  const std::atomic<bool>* cancel_ = nullptr;
  std::atomic<bool> complete_{true};
  std::atomic<std::uint64_t> left_out_{0};  ///< pixels of tiles that were not begun
  std::atomic<std::uint64_t> hits_{0};
};

}  // namespace encore::renderer
