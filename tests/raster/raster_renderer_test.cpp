// What the rasteriser sends, reports and leaves behind.

#include "renderer/raster_renderer.h"

#include "renderer/gl/error.h"
#include "renderer/image_diff.h"
#include "scene/sample_scenes.h"
#include "tests/raster/raster_scenes.h"
#include "tests/support/gl_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

namespace {

using namespace encore;
using renderer::Image;
using renderer::RasterRenderer;
using renderer::test::TestScene;
using RasterRendererTest = test::GlTest;

TEST_F(RasterRendererTest, OnlyWhatMovedIsSentAgain) {
  auto scene = scene::make_sample_scene("toys");
  ASSERT_TRUE(scene.has_value());
  scene::TriangleList list;
  scene::update_triangles(*scene, 0.0, list);
  RasterRenderer raster(context_);
  raster.init({&*scene, &list, nullptr});
  EXPECT_TRUE(raster.transfers());
  const std::uint64_t all = raster.last_transfer().uploaded_bytes;
  EXPECT_GE(all, list.triangles.size() * sizeof(scene::Triangle));

  const std::uint64_t before = list.version;
  ASSERT_EQ(scene::update_triangles(*scene, 0.4, list), scene::TriangleChange::moved);
  std::uint64_t moved = 0;
  for (const auto& range : scene::changed_since(list, before)) moved += range.count;
  ASSERT_LT(moved, list.triangles.size()) << "something has to stay where it was";
  raster.refresh();
  EXPECT_GE(raster.last_transfer().uploaded_bytes, moved * sizeof(scene::Triangle));
  EXPECT_LT(raster.last_transfer().uploaded_bytes, all);

  Image image;
  raster.draw(scene->camera, 64, 64);
  raster.read(image);
  const Image traced = renderer::test::traced_picture(*scene, list, scene->camera, 64, 64);
  EXPECT_LT(renderer::compare_images(image, traced, 0.02).differing, 64U * 64U / 50U);

  raster.refresh();
  EXPECT_EQ(raster.last_transfer().uploaded_bytes, 0U) << "nothing moved since";
}

TEST_F(RasterRendererTest, AChangingNumberOfTrianglesIsFollowed) {
  auto scene = scene::make_sample_scene("metaballs");
  ASSERT_TRUE(scene.has_value());
  scene::TriangleList list;
  scene::update_triangles(*scene, 0.0, list);
  RasterRenderer raster(context_);
  raster.init({&*scene, &list, nullptr});
  for (const double time_s : {0.5, 1.0, 1.5}) {
    scene::update_triangles(*scene, time_s, list);
    raster.refresh();
    Image image;
    raster.draw(scene->camera, 48, 48);
    raster.read(image);
    const Image traced = renderer::test::traced_picture(*scene, list, scene->camera, 48, 48);
    EXPECT_LT(renderer::compare_images(image, traced, 0.02).differing, 48U * 48U / 50U) << time_s;
  }
}

TEST_F(RasterRendererTest, RefreshSeesWhatTheSceneHasComeToNeed) {
  TestScene setup;
  setup.scene.camera = {.eye = {0.0F, 0.0F, 2.0F}};
  setup.scene.materials.resize(1);
  renderer::test::add_square(setup.list, 3.0F, 0.0F);
  RasterRenderer raster(context_);
  raster.init({&setup.scene, &setup.list, nullptr});
  Image dark, lit;
  raster.draw(setup.scene.camera, 4, 4);
  raster.read(dark);
  setup.scene.lights.resize(1);
  setup.scene.mark_changed();
  raster.refresh();
  raster.draw(setup.scene.camera, 4, 4);
  raster.read(lit);
  EXPECT_GT(lit.pixels[5].g, dark.pixels[5].g);
  setup.scene.lights.clear();
  setup.scene.mark_changed();
  raster.refresh();
  raster.draw(setup.scene.camera, 4, 4);
  raster.read(lit);
  EXPECT_EQ(lit.pixels[5], dark.pixels[5]);
}

/// All state that drawing sets, as the context reports it.
std::string state() {
  std::string text;
  for (const GLenum name :
       {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_DRAW_FRAMEBUFFER_BINDING,
        GL_READ_FRAMEBUFFER_BINDING, GL_RENDERBUFFER_BINDING, GL_DEPTH_FUNC, GL_CLIP_ORIGIN,
        GL_CLIP_DEPTH_MODE, GL_DEPTH_WRITEMASK, GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE,
        GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_RASTERIZER_DISCARD, GL_POLYGON_OFFSET_FILL,
        GL_POLYGON_MODE}) {
    std::array<GLint, 4> values{};
    glGetIntegerv(name, values.data());
    text += std::to_string(values[0]) + ' ';
  }
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  for (const GLint value : viewport) text += std::to_string(value) + ' ';
  std::array<GLboolean, 4> mask{};
  glGetBooleanv(GL_COLOR_WRITEMASK, mask.data());
  for (const GLboolean value : mask) text += std::to_string(int{value}) + ' ';
  std::array<GLdouble, 2> range{};
  glGetDoublev(GL_DEPTH_RANGE, range.data());
  return text + std::to_string(range[0]) + ' ' + std::to_string(range[1]);
}

TEST_F(RasterRendererTest, ForeignStateIsNeitherInTheWayNorLost) {
  const auto setup = renderer::test::sphere_before_square();
  RasterRenderer raster(context_);
  raster.init({&setup->scene, &setup->list, nullptr});
  Image expected, found;
  raster.draw(setup->scene.camera, 32, 32);
  raster.read(expected);

  const std::array<GLenum, 5> switches = {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST,
                                          GL_RASTERIZER_DISCARD};
  const std::string before = state();
  for (const GLenum name : switches) glEnable(name);
  glCullFace(GL_FRONT_AND_BACK);
  glDepthFunc(GL_NEVER);
  glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glScissor(0, 0, 1, 1);
  glViewport(3, 4, 5, 6);
  glDepthMask(GL_FALSE);
  glDepthRange(0.25, 0.5);
  glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  const std::string foreign = state();
  EXPECT_NE(foreign, before);
  raster.draw(setup->scene.camera, 32, 32);
  EXPECT_EQ(state(), foreign);
  raster.read(found);
  EXPECT_EQ(renderer::compare_images(found, expected).differing, 0U);

  for (const GLenum name : switches) glDisable(name);
  glCullFace(GL_BACK);
  glDepthFunc(GL_LESS);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glDepthMask(GL_TRUE);
  glDepthRange(0.0, 1.0);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glViewport(0, 0, 1, 1);
}

TEST_F(RasterRendererTest, TheDeviceIsNamedAndTimedAsFarAsItHasAClock) {
  const auto setup = renderer::test::sphere_before_square();
  RasterRenderer raster(context_);
  EXPECT_EQ(raster.device_name(), context_->capabilities().device_name());
  EXPECT_FALSE(raster.device_name().empty());
  raster.init({&setup->scene, &setup->list, nullptr});
  EXPECT_FALSE(raster.last_draw_s().has_value());
  EXPECT_EQ(raster.texture(), 0U);
  raster.draw(setup->scene.camera, 32, 32);
  EXPECT_NE(raster.texture(), 0U);
  if (context_->capabilities().timestamp_bits == 0) {
    EXPECT_FALSE(raster.last_draw_s().has_value());
  } else if (raster.last_draw_s()) {
    EXPECT_GT(*raster.last_draw_s(), 0.0);
  }
}

TEST_F(RasterRendererTest, WrongUseIsReported) {
  RasterRenderer raster(context_);
  Image image;
  EXPECT_THROW(raster.draw({}, 4, 4), std::logic_error);
  EXPECT_THROW(raster.refresh(), std::logic_error);
  EXPECT_THROW(raster.read(image), std::logic_error);
  EXPECT_THROW(raster.init({}), std::invalid_argument);
  TestScene setup;
  raster.init({&setup.scene, &setup.list, nullptr});
  EXPECT_THROW(raster.read(image), std::logic_error);
  EXPECT_THROW(raster.draw({.eye = glm::vec3(0.0F)}, 4, 4), std::invalid_argument);
  EXPECT_THROW(raster.draw({}, 0, 4), std::invalid_argument);
  EXPECT_THROW(raster.draw({}, 1 << 20, 4), renderer::gl::GlError);
  raster.draw({}, 4, 4);
}

/// A context of a driver that has nothing beyond OpenGL 4.3.
class OldContext final : public renderer::gl::Context {
 public:
  OldContext() {
    capabilities_.renderer = "Old Driver";
    capabilities_.version = "4.3.0";
  }
  void make_current() override {}
};

TEST(RasterRendererNoContext, ADriverWithoutClipControlIsNamed) {
  try {
    const RasterRenderer raster(std::make_shared<OldContext>());
    FAIL() << "nothing was thrown";
  } catch (const renderer::gl::GlError& error) {
    const std::string message = error.what();
    for (const char* part : {"GL_ARB_clip_control", "Old Driver", "4.3.0", "--device"}) {
      EXPECT_NE(message.find(part), std::string::npos) << message;
    }
  }
}

}  // namespace
