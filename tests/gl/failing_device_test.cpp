// What a device does that hangs, resets or runs out of memory cannot be had at will, so a few
// OpenGL functions are replaced by ones that answer as its driver would.
#include "renderer/gl/buffer.h"
#include "renderer/gl/error.h"
#include "renderer/gl/fence.h"
#include "tests/support/gl_context.h"
#include "tests/support/messages.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <string>

namespace encore::renderer::gl {
namespace {

using test::contains;

/// Puts another function in an OpenGL function's place while it lives.
template <class Function>
class Replaced {
 public:
  Replaced(Function& place, Function other) : place_(place), before_(place) { place = other; }
  ~Replaced() { place_ = before_; }
  Replaced(const Replaced&) = delete;
  Replaced& operator=(const Replaced&) = delete;

 private:
  Function& place_;
  Function before_;
};

using FailingDevice = test::GlTest;

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const GlError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

GLenum EPOXY_CALLSPEC never_done(GLsync, GLbitfield, GLuint64) {
  return GL_TIMEOUT_EXPIRED;
}
GLenum EPOXY_CALLSPEC wait_fails(GLsync, GLbitfield, GLuint64) {
  return GL_WAIT_FAILED;
}
GLenum EPOXY_CALLSPEC reset_by_us() {
  return GL_GUILTY_CONTEXT_RESET;
}
GLenum EPOXY_CALLSPEC reset_by_another() {
  return GL_INNOCENT_CONTEXT_RESET;
}

TEST_F(FailingDevice, WorkThatNeverEndsIsGivenUpWithAWayOut) {
  const Replaced wait(epoxy_glClientWaitSync, &never_done);
  const std::string message = message_of([] { finish("drawing toys", 0.01); });
  EXPECT_TRUE(contains(message, "drawing toys")) << message;
  EXPECT_TRUE(contains(message, "0.01 s")) << message;
  EXPECT_TRUE(contains(message, "--size")) << message;
}

TEST_F(FailingDevice, AWaitThatFailsIsNoSuccess) {
  const Replaced wait(epoxy_glClientWaitSync, &wait_fails);
  const std::string message = message_of([] { finish("drawing toys"); });
  EXPECT_TRUE(contains(message, "drawing toys")) << message;
  EXPECT_TRUE(contains(message, "gave the work up")) << message;
}

TEST_F(FailingDevice, ALostContextIsReportedAsOne) {
  if (!context_->capabilities().robust) GTEST_SKIP() << "this driver cannot report a reset";
  for (const auto reset : {&reset_by_us, &reset_by_another}) {
    const Replaced status(epoxy_glGetGraphicsResetStatus, reset);
    const std::string message = message_of([this] { context_->check("drawing toys"); });
    EXPECT_TRUE(contains(message, "drawing toys")) << message;
    EXPECT_TRUE(contains(message, "reset")) << message;
  }
  EXPECT_NO_THROW(context_->check("drawing toys")) << "the context itself is well";
}

TEST_F(FailingDevice, AResetWhileWaitingEndsTheWait) {
  if (!context_->capabilities().robust) GTEST_SKIP() << "this driver cannot report a reset";
  const Replaced wait(epoxy_glClientWaitSync, &never_done);
  const Replaced status(epoxy_glGetGraphicsResetStatus, &reset_by_us);
  const std::string message = message_of([] { finish("drawing toys", 1e6); });
  EXPECT_TRUE(contains(message, "gave the work up")) << message;
}

}  // namespace
}  // namespace encore::renderer::gl
