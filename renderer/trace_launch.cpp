#include "renderer/trace_launch.h"

#include <epoxy/gl.h>

namespace encore::renderer {

namespace {

GLuint groups(int pixels, int group) {
  return static_cast<GLuint>((pixels + group - 1) / group);
}

void dispatch(const gl::Program& program, const PixelRect& piece) {
  program.use();
  program.set("first_pixel", piece.x0, piece.y0);
  program.set("last_pixel", piece.x1, piece.y1);
  glDispatchCompute(groups(piece.width(), kTraceGroupWidth),
                    groups(piece.height(), kTraceGroupHeight), 1);
}

}  // namespace

TraceVariant TraceLaunch::variant(TraceOutput output, bool resumable) const {
  TraceVariant made = scene_;
  made.output = output;
  made.pause_after = context_->capabilities().software ? PausedRays::kPauseAfter : 0;
  made.resumable = resumable;
  return made;
}

std::shared_ptr<gl::Program> TraceLaunch::program(TraceOutput output, bool resumable) const {
  return context_->programs().compute("trace.comp", trace_defines(variant(output, resumable)));
}

void TraceLaunch::set_uniforms(const gl::Program& program) const {
  program.set("width", rays_.width);
  program.set("first_index", rays_.first_index);
  program.set("ray_count", rays_.ray_count);
  program.set("queue_first", rays_.queue_first);
}

void TraceLaunch::begin(const Rays& rays, std::shared_ptr<gl::Program> program) {
  rays_ = rays;
  program_ = std::move(program);
  set_uniforms(*program_);
}

void TraceLaunch::send(const PixelRect& piece) {
  const TraceVariant used = variant(rays_.output, false);
  if (used.pause_after == 0) return dispatch(*program_, piece);
  const auto resumable = [this]() -> const gl::Program& {
    // The context's cache keeps it.
    const gl::Program& again = *this->program(rays_.output, true);
    set_uniforms(again);
    return again;
  };
  paused_.run({program_.get(), resumable}, piece, rays_.width, paused_ray_words(used),
              context_->capabilities().storage_block_bytes, dispatch);
}

std::uint64_t TraceLaunch::pace_key(std::uint64_t salt) const {
  constexpr std::uint64_t kFactor = 0x100000001B3;  // mixes as the FNV hash does
  std::uint64_t key = salt;
  for (const std::uint64_t part :
       {std::uint64_t{program_->id()}, static_cast<std::uint64_t>(rays_.width)}) {
    key = (key ^ part) * kFactor;
  }
  return key;
}

}  // namespace encore::renderer
