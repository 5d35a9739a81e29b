// What an overlay leaves behind: nothing.

#include "renderer/overlay/overlay_state.h"

#include "renderer/overlay/overlay_renderer.h"
#include "renderer/overlay/screen_texture.h"
#include "tests/overlay/overlay_pictures.h"
#include "tests/support/gl_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace {

using namespace encore;
using renderer::OverlayBox;
using renderer::OverlayRenderer;
using renderer::OverlayView;
using renderer::ScreenTexture;
using test::Codes;
using test::drawn;
using test::Everything;
using test::kCamera;
using OverlayState = test::GlTest;

/// All state that drawing sets, as the context reports it.
std::vector<GLint> state() {
  std::vector<GLint> found;
  for (const GLenum name : {GL_CURRENT_PROGRAM,
                            GL_VERTEX_ARRAY_BINDING,
                            GL_DRAW_FRAMEBUFFER_BINDING,
                            GL_READ_FRAMEBUFFER_BINDING,
                            GL_BLEND,
                            GL_BLEND_EQUATION_RGB,
                            GL_BLEND_EQUATION_ALPHA,
                            GL_BLEND_SRC_RGB,
                            GL_BLEND_DST_RGB,
                            GL_BLEND_SRC_ALPHA,
                            GL_BLEND_DST_ALPHA,
                            GL_DEPTH_TEST,
                            GL_CULL_FACE,
                            GL_SCISSOR_TEST,
                            GL_STENCIL_TEST,
                            GL_RASTERIZER_DISCARD,
                            GL_POLYGON_MODE,
                            GL_CLIP_DISTANCE0,
                            GL_CLIP_DISTANCE1,
                            GL_CLIP_DISTANCE2,
                            GL_ACTIVE_TEXTURE,
                            GL_PACK_ALIGNMENT,
                            GL_UNPACK_ALIGNMENT,
                            GL_UNPACK_ROW_LENGTH,
                            GL_PACK_ROW_LENGTH,
                            GL_ARRAY_BUFFER_BINDING,
                            GL_PIXEL_UNPACK_BUFFER_BINDING,
                            GL_PIXEL_PACK_BUFFER_BINDING,
                            GL_DITHER}) {
    std::array<GLint, 4> values{};
    glGetIntegerv(name, values.data());
    found.push_back(values[0]);
  }
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  found.insert(found.end(), viewport.begin(), viewport.end());
  std::array<GLboolean, 4> mask{};
  glGetBooleanv(GL_COLOR_WRITEMASK, mask.data());
  found.insert(found.end(), mask.begin(), mask.end());
  GLint active = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  for (GLenum unit = GL_TEXTURE0; unit < GL_TEXTURE0 + 5; ++unit) {
    glActiveTexture(unit);
    for (const GLenum name :
         {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_BUFFER, GL_SAMPLER_BINDING}) {
      found.push_back(0);
      glGetIntegerv(name, &found.back());
    }
  }
  glActiveTexture(static_cast<GLenum>(active));
  return found;
}

TEST_F(OverlayState, ForeignStateIsNeitherInTheWayNorLost) {
  const Everything all;
  const OverlayBox box = Everything::box();
  OverlayRenderer overlay(context_);
  ScreenTexture screen(context_);
  const std::vector<std::uint8_t> pixels(4 * 3 * 3, 90);
  screen.upload(pixels, 3, 3);
  overlay.set_boxes(std::span(&box, 1), 1);
  OverlayView view = test::black_view(kCamera, 24, 24);
  view.background_texture = screen.texture();
  view.mode = renderer::OverlayMode::hidden_line;
  overlay.set_depth(std::vector<float>(9, 2.9F), 3, 3);
  const Codes expected = drawn(overlay, view, all.items());

  constexpr std::array<GLenum, 8> kSwitches = {
      GL_CULL_FACE,  GL_SCISSOR_TEST, GL_STENCIL_TEST,   GL_RASTERIZER_DISCARD,
      GL_DEPTH_TEST, GL_BLEND,        GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE2};
  GLuint textures[2] = {0, 0}, sampler = 0, buffer = 0;
  glGenTextures(2, textures);
  glGenSamplers(1, &sampler);
  glGenBuffers(1, &buffer);
  for (const GLenum name : kSwitches) glEnable(name);
  glCullFace(GL_FRONT_AND_BACK);
  glScissor(0, 0, 1, 1);
  glViewport(3, 4, 5, 6);
  glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glBlendEquationSeparate(GL_MAX, GL_MIN);
  glBlendFuncSeparate(GL_ZERO, GL_ONE, GL_DST_COLOR, GL_DST_ALPHA);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 77);
  glPixelStorei(GL_PACK_ALIGNMENT, 8);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, textures[0]);
  glBindSampler(0, sampler);
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_BUFFER, textures[1]);
  if (context_->capabilities().clip_control) glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  const std::vector<GLint> foreign = state();

  screen.upload(pixels, 3, 3);
  overlay.set_boxes(std::span(&box, 1), 2);
  overlay.set_depth(std::vector<float>(9, 2.9F), 3, 3);
  const Codes found = drawn(overlay, view, all.items());
  EXPECT_EQ(state(), foreign);
  EXPECT_EQ(found.rgba, expected.rgba);
  view.width = 30;
  overlay.draw(view, all.items());
  screen.upload(std::vector<std::uint8_t>(4, 0), 1, 1);
  EXPECT_EQ(state(), foreign) << "after a change of size";

  for (const GLenum name : kSwitches) glDisable(name);
  if (context_->capabilities().clip_control) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glCullFace(GL_BACK);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ZERO);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glBindSampler(0, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glActiveTexture(GL_TEXTURE0);
  glDeleteTextures(2, textures);
  glDeleteSamplers(1, &sampler);
  glDeleteBuffers(1, &buffer);
}

/// What a driver complains about, where it can.
void GLAPIENTRY note(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text,
                     const void* list) {
  if (type == GL_DEBUG_TYPE_OTHER || severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
  if (type == GL_DEBUG_TYPE_PERFORMANCE) return;
  const_cast<std::vector<std::string>*>(static_cast<const std::vector<std::string>*>(list))
      ->emplace_back(text);
}

TEST_F(OverlayState, TheDriverHasNothingToComplainAbout) {
  std::vector<std::string> complaints;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(note, &complaints);
  {
    const Everything all;
    const OverlayBox box = Everything::box();
    OverlayRenderer overlay(context_);
    overlay.set_boxes(std::span(&box, 1), 1);
    overlay.set_depth(std::vector<float>(1, 2.0F), 1, 1);
    for (const auto mode : {renderer::OverlayMode::x_ray, renderer::OverlayMode::dimmed}) {
      OverlayView view = test::black_view(kCamera, 24, 24);
      view.mode = mode;
      drawn(overlay, view, all.items());
      drawn(overlay, view, {});
    }
    overlay.clear_depth();
  }
  glDebugMessageCallback(nullptr, nullptr);
  glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDisable(GL_DEBUG_OUTPUT);
  EXPECT_TRUE(complaints.empty()) << complaints.front();
}

}  // namespace
