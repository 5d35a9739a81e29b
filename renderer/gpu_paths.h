#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_scene.h"
#include "renderer/paced_dispatch.h"
#include "renderer/renderer.h"
#include "renderer/stage_clock.h"
#include "renderer/trace_launch.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace encore::renderer {

/// Pictures on the device that take more than one ray a pixel: shadows, reflections and refractions
/// (Whitted 1980), several samples a pixel. The rays are those of the CPU (renderer/paths), bit for
/// bit; colours are summed in single precision.
///
/// A wavefront (Laine, Karras, Aila 2013) over a band of rows: each pixel has a path, each path one
/// ray in hand. For each sample
///   1. paths_start.comp makes the camera's rays;
///   2. trace.comp finds their hits;
///   3. with shadows, for each light, paths_light.comp makes rays towards it, and trace.comp
///      (ENCORE_ANY_HIT) adds the light where nothing is in the way;
///   4. paths_scatter.comp adds the rest, and sends paths on: where a ray is both mirrored and
///      refracted, one of the two waits on the path's own stack, which holds one ray a level of
///      depth; a path whose ray has ended takes the last one that waits;
///   2. to 4. are repeated, for reflections and refractions apart, until no path has a ray;
/// and paths_finish.comp writes the mean. Paths write their own pixel only, so the order in which
/// they are in a list does not matter, and pictures are the same each time.
///
/// What a scene does not need is neither compiled nor allocated.
class GpuPaths {
 public:
  /// `scene` and `launch`: the tracer's.
  GpuPaths(std::shared_ptr<gl::Context> context, const GpuScene& scene, TraceLaunch& launch);

  /// Compiles what the scene that was sent last needs; nothing if one ray a pixel is enough.
  void prepare();

  struct Frame {
    int width = 0;
    int height = 0;
    std::uint32_t first_sample = 0;
    std::uint32_t samples = 1;
  };
  /// Draws into the picture that is bound, by the camera and scene that are. Returns whether it was
  /// drawn to its end. `scene_number` tells scenes apart; `doing` is for messages. Throws GlError
  /// if a band of a single row does not fit on the device.
  bool draw(const Frame& frame, std::uint32_t scene_number, const std::string& doing);

  /// Of the last picture; seconds only where the device has a clock.
  [[nodiscard]] const RayFigures& figures() const { return figures_; }
  /// Rows of a band of the last picture.
  [[nodiscard]] int band_rows() const { return band_rows_; }

  /// Passes that have not begun when `*flag` turns true are left out; null: never.
  void set_cancel_flag(const std::atomic<bool>* flag);

 private:
  struct Band {
    int y = 0;
    int width = 0;
    int rows = 0;
    [[nodiscard]] int pixels() const { return width * rows; }
  };
  /// Paths in a list that have rays of one kind.
  struct List {
    scene::RayKind kind = scene::RayKind::camera;
    int first = 0;  ///< place in the path queues
    int count = 0;
    int width = 0;  ///< they are traced as a picture that is so wide
  };
  [[nodiscard]] bool bounces() const;
  [[nodiscard]] bool cancelled() const;
  [[nodiscard]] int rows_of_band(int width, int height) const;
  [[nodiscard]] int list_place(int half, scene::RayKind kind) const;
  void reserve(std::uint64_t pixels);
  void bind() const;
  bool draw_band(const Frame& frame, const Band& band);
  void start(const Band& band, std::uint32_t sample, bool first);
  bool trace_sample(const Band& band);
  bool follow(const List& list, int next_half);
  bool trace(TraceOutput output, const List& list, PacedDispatch& pace);
  bool add_lights(const List& list);
  void run_pass(const gl::Program& program, const List& list);
  void finish_band(const Band& band, std::uint32_t samples);

  std::shared_ptr<gl::Context> context_;
  const GpuScene& scene_;
  TraceLaunch& launch_;
  const std::atomic<bool>* cancel_ = nullptr;
  std::array<PacedDispatch, scene::kRayKinds> paces_;
  StageClock clock_;
  RayFigures figures_;
  std::uint64_t pace_salt_ = 0;
  std::string doing_;
  int band_rows_ = 0;
  int most_pixels_ = 0;  ///< of a band of this picture

  std::shared_ptr<gl::Program> start_, light_, scatter_, finish_, trace_, trace_shadows_;
  struct Buffers {
    gl::Buffer paths{"the paths of rays"};
    gl::Buffer queues{"the lists of rays"};
    gl::Buffer shadow_rays{"the shadow rays"};
    gl::Buffer waiting{"the rays that wait"};
  };
  std::unique_ptr<Buffers> buffers_;  ///< null: not needed so far
  scene::Needs prepared_;             ///< what they are for
};

}  // namespace encore::renderer
