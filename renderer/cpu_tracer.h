#pragma once

#include "accel/counters.h"
#include "renderer/renderer.h"
#include "renderer/shading.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace encore::renderer {

/// Ray casting on the CPU, tile by tile over threads.
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
  /// Looks again at what the scene needs (normals, colours, highlights).
  void refresh() override;
  /// Throws std::logic_error before init(), std::invalid_argument for a camera or an image size
  /// that make_camera_frame() rejects.
  void render(const scene::Camera& camera, Image& image) override;
  void draw(const scene::Camera& camera, int width, int height) override;
  void read(Image& image) override { image = picture_; }

  /// These throw as render() does.
  void trace_hits(const scene::Camera& camera, int width, int height,
                  std::vector<scene::Hit>& hits) override;
  void trace_counters(const scene::Camera& camera, int width, int height,
                      std::vector<accel::TraceCounters>& counters) override;
  void trace_rays(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) override;

  /// Tiles that have not begun are left as they are.
  void set_cancel_flag(const std::atomic<bool>* flag) override { cancel_ = flag; }
  [[nodiscard]] bool complete() const override { return complete_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::optional<std::uint64_t> last_hits() const override { return hit_count(); }
  /// Rays of the last frame that hit something.
  [[nodiscard]] std::uint64_t hit_count() const { return hits_.load(std::memory_order_relaxed); }
  [[nodiscard]] int threads() const { return threads_; }

 private:
  /// Calls work(PixelRect) for every tile of the image, over all threads.
  template <class TileWork>
  void for_each_tile(int width, int height, const TileWork& work);
  void check_ready() const;

  RenderInput input_;
  Image picture_;                  ///< of draw()
  ShadeFunction shade_ = nullptr;  ///< the variant that this scene needs
  int threads_ = 1;
  std::optional<tbb::global_control> more_threads_;  ///< only if there are more than processors
  std::optional<tbb::task_arena> arena_;             ///< only if there is more than one thread
  const std::atomic<bool>* cancel_ = nullptr;
  std::atomic<bool> complete_{true};
  std::atomic<std::uint64_t> hits_{0};
};

}  // namespace encore::renderer
