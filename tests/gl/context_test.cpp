#include "renderer/gl/context.h"

#include "renderer/gl/error.h"
#include "renderer/gl/program.h"
#include "tests/support/gl_context.h"
#include "tests/support/messages.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace encore::renderer::gl {
namespace {

using test::contains;
using ContextTest = test::GlTest;

TEST_F(ContextTest, ComesUpWithoutAWindowAndKnowsItsDevice) {
  const Capabilities& found = context_->capabilities();
  EXPECT_NE(found.renderer, "");
  EXPECT_NE(found.vendor, "");
  EXPECT_NE(found.version, "");
  EXPECT_GE(10 * found.major + found.minor, 43);
  EXPECT_EQ(found.version.substr(0, 3),
            std::to_string(found.major) + "." + std::to_string(found.minor));
  // What OpenGL 4.3 promises of any device.
  EXPECT_GE(found.storage_block_bytes, std::uint64_t{1} << 24);
  EXPECT_GE(found.compute_storage_blocks, 8);
  EXPECT_GE(found.storage_bindings, 8);
  for (const std::uint32_t count : found.workgroups) EXPECT_GE(count, 65535U);
  EXPECT_GE(found.workgroup_invocations, 1024U);
  EXPECT_GE(found.texture_size, 16384);
  EXPECT_TRUE(found.timestamp_bits == 0 || found.timestamp_bits >= 30) << found.timestamp_bits;
  EXPECT_NO_THROW(require_compute(found));
}

TEST_F(ContextTest, SoftwareIsNamedAsSuch) {
  const Capabilities& found = context_->capabilities();
  EXPECT_EQ(found.software, contains(found.device_name(), "software, runs on the CPU"));
  if (contains(found.renderer, "llvmpipe")) {
    EXPECT_TRUE(found.software);
  }
}

TEST_F(ContextTest, TwoContextsAreIndependent) {
  const auto first = make_headless_context();
  const EGLContext handle = eglGetCurrentContext();
  const auto second = make_headless_context();
  EXPECT_NE(eglGetCurrentContext(), handle);
  glEnable(GL_DEPTH_TEST);
  first->make_current();
  EXPECT_EQ(eglGetCurrentContext(), handle);
  EXPECT_EQ(glIsEnabled(GL_DEPTH_TEST), GL_FALSE);
  second->make_current();
  EXPECT_EQ(glIsEnabled(GL_DEPTH_TEST), GL_TRUE);
  first->make_current();
  first->check("the first");
  second->make_current();
  second->check("the second");
}

TEST_F(ContextTest, OneThatEndsLeavesTheOthersAlone) {
  const auto kept = make_headless_context();
  const EGLContext handle = eglGetCurrentContext();
  auto gone = make_headless_context();
  kept->make_current();
  gone.reset();
  EXPECT_EQ(eglGetCurrentContext(), handle);
  EXPECT_NE(glGetString(GL_RENDERER), nullptr);
  kept->check("the one that is left");
  // Its display is there, too.
  EXPECT_NO_THROW(make_headless_context());
  kept->make_current();
}

TEST_F(ContextTest, CheckTellsWhatWasDoneAndWhatWentWrongOnce) {
  glEnable(GL_COMPUTE_SHADER);
  glBindBuffer(GL_ARRAY_BUFFER, 0);
  try {
    context_->check("drawing the frame");
    FAIL() << "the error was not seen";
  } catch (const GlError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(contains(message, "drawing the frame: ")) << message;
    EXPECT_TRUE(contains(message, "GL_INVALID_ENUM")) << message;
    EXPECT_TRUE(contains(message, context_->capabilities().device_name())) << message;
  }
  EXPECT_NO_THROW(context_->check("the next frame"));
}

TEST_F(ContextTest, TheCurrentContextCanBeAdopted) {
  const auto window = make_headless_context();
  const EGLContext handle = eglGetCurrentContext();
  const auto adopted = adopt_current_context();
  EXPECT_EQ(adopted->capabilities().renderer, window->capabilities().renderer);
  EXPECT_EQ(adopted->capabilities().version, window->capabilities().version);
  adopted->make_current();
  EXPECT_EQ(eglGetCurrentContext(), handle);
}

TEST_F(ContextTest, DevicesAreListedAndCanBeChosen) {
  const EGLContext before = eglGetCurrentContext();
  std::string problem;
  const auto devices = list_devices(&problem);
  EXPECT_EQ(problem, "");
  EXPECT_EQ(eglGetCurrentContext(), before);
  ASSERT_FALSE(devices.empty());
  bool usable = false;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceListing& device = devices[i];
    EXPECT_EQ(device.index, static_cast<int>(i));
    EXPECT_NE(device.name, "");
    EXPECT_EQ(device.usable, device.problem.empty()) << device.problem;
    if (!device.usable) continue;
    usable = true;
    EXPECT_EQ(device.software, is_software_renderer(device.name));
    const auto context = make_headless_context(device.index);
    EXPECT_EQ(context->capabilities().renderer, device.name);
    EXPECT_EQ(context->capabilities().version, device.version);
  }
  EXPECT_TRUE(usable);
}

TEST_F(ContextTest, ADeviceThatIsNotThereIsNamedWithTheWayToThoseThatAre) {
  for (const int device : {-1, 999}) {
    try {
      make_headless_context(device);
      FAIL() << device;
    } catch (const GlUnavailable& error) {
      const std::string message = error.what();
      EXPECT_TRUE(contains(message, "no OpenGL device " + std::to_string(device))) << message;
      EXPECT_TRUE(contains(message, "encore doctor")) << message;
    }
  }
  // The context that was there still is.
  EXPECT_NE(glGetString(GL_RENDERER), nullptr);
}

}  // namespace
}  // namespace encore::renderer::gl
