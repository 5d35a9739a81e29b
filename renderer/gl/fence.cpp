#include "renderer/gl/fence.h"

#include "renderer/gl/error.h"
#include "renderer/gl/error_queue.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace encore::renderer::gl {

namespace {

struct Fence {
  Fence() : sync(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {}
  ~Fence() { glDeleteSync(sync); }  // ignores null
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;
  const GLsync sync;
};

[[noreturn]] void fail_to_wait(const std::string& doing) {
  const std::string reason = reset_reason();
  throw GlError(fmt::format(
      "{}: the graphics driver gave the work up ({}); use smaller pictures (--size), update the "
      "driver, or use --device cpu",
      doing, reason.empty() ? error_name(discard_errors()) : reason));
}

}  // namespace

void finish(const std::string& doing, double timeout_s) {
  using Clock = std::chrono::steady_clock;
  // Short enough that a context lost meanwhile is noticed.
  constexpr GLuint64 kSlice_ns = 250'000'000;
  const auto deadline = Clock::now() + std::chrono::duration<double>(timeout_s);
  const Fence fence;
  if (fence.sync == nullptr) fail_to_wait(doing);
  GLbitfield flush = GL_SYNC_FLUSH_COMMANDS_BIT;
  while (true) {
    const double left_s = std::chrono::duration<double>(deadline - Clock::now()).count();
    const GLuint64 left_ns = left_s > 0 ? static_cast<GLuint64>(left_s * 1e9) : 0;
    const GLenum state = glClientWaitSync(fence.sync, flush, std::min(left_ns, kSlice_ns));
    if (state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED) return;
    if (state == GL_WAIT_FAILED || !reset_reason().empty()) fail_to_wait(doing);
    if (left_ns == 0) break;
    flush = 0;
  }
  throw GlError(fmt::format(
      "{}: the device did not finish within {:g} s; use smaller pictures (--size), another "
      "structure, or --device cpu",
      doing, timeout_s));
}

Timer::Timer(int timestamp_bits) {
  if (timestamp_bits > 0) glGenQueries(2, queries_);
}

Timer::~Timer() {
  if (queries_[0] != 0) glDeleteQueries(2, queries_);
}

void Timer::begin() {
  if (queries_[0] != 0) glQueryCounter(queries_[0], GL_TIMESTAMP);
}

void Timer::end() {
  if (queries_[1] != 0) glQueryCounter(queries_[1], GL_TIMESTAMP);
}

std::optional<double> Timer::seconds() const {
  // A query that was never used is none yet.
  if (queries_[0] == 0 || glIsQuery(queries_[0]) == GL_FALSE ||
      glIsQuery(queries_[1]) == GL_FALSE) {
    return std::nullopt;
  }
  GLuint64 times_ns[2] = {0, 0};
  for (int i = 0; i < 2; ++i) glGetQueryObjectui64v(queries_[i], GL_QUERY_RESULT, &times_ns[i]);
  if (times_ns[1] < times_ns[0]) return std::nullopt;
  return static_cast<double>(times_ns[1] - times_ns[0]) * 1e-9;
}

}  // namespace encore::renderer::gl
