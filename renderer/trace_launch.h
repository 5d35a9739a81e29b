#pragma once

#include "renderer/camera_rays.h"
#include "renderer/gl/context.h"
#include "renderer/gl/program.h"
#include "renderer/paused_rays.h"
#include "renderer/trace_defines.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace encore::renderer {

/// Sends rays to the device: finds the program of shaders/trace.comp that gives what is asked for,
/// and sees to it that long rays reach their end on software devices, too (PausedRays).
class TraceLaunch {
 public:
  explicit TraceLaunch(std::shared_ptr<gl::Context> context) : context_(std::move(context)) {}

  /// What of the variant does not depend on what is asked for. The caller's `output`,
  /// `pause_after` and `resumable` count for nothing.
  void set_scene(const TraceVariant& scene) { scene_ = scene; }

  /// What is traced, as the rows of a picture; whatever a variant has no use for stays 0.
  struct Rays {
    TraceOutput output = TraceOutput::picture;
    int width = 0;        ///< of the picture
    int first_index = 0;  ///< of the results' buffer
    int ray_count = 0;    ///< of rays from a buffer or a list
    int queue_first = 0;  ///< where a list of paths begins
  };
  [[nodiscard]] std::shared_ptr<gl::Program> program(TraceOutput output) const {
    return program(output, false);
  }
  /// Before the first piece. `program`: that of their output, looked up beforehand.
  void begin(const Rays& rays, std::shared_ptr<gl::Program> program);
  /// Sends a piece of them.
  void send(const PixelRect& piece);
  /// Tells the work in hand from other work, for PacedDispatch: by program, width and `salt`.
  [[nodiscard]] std::uint64_t pace_key(std::uint64_t salt) const;

 private:
  [[nodiscard]] std::shared_ptr<gl::Program> program(TraceOutput output, bool resumable) const;
  [[nodiscard]] TraceVariant variant(TraceOutput output, bool resumable) const;
  void set_uniforms(const gl::Program& program) const;

  std::shared_ptr<gl::Context> context_;
  TraceVariant scene_;
  Rays rays_;
  std::shared_ptr<gl::Program> program_;
  PausedRays paused_;  ///< software devices only
};

}  // namespace encore::renderer
