#include "renderer/raster_state.h"

#include <epoxy/gl.h>

#include <cstddef>

namespace encore::renderer {

namespace {

/// A switch of the context and how rasterisation wants it.
struct Switch {
  GLenum name;
  bool on;
};

constexpr std::array<Switch, 9> kSwitchList = {{{GL_DEPTH_TEST, true},
                                                {GL_BLEND, false},
                                                {GL_CULL_FACE, false},
                                                {GL_SCISSOR_TEST, false},
                                                {GL_STENCIL_TEST, false},
                                                {GL_COLOR_LOGIC_OP, false},
                                                {GL_DEPTH_CLAMP, false},
                                                {GL_POLYGON_OFFSET_FILL, false},
                                                {GL_RASTERIZER_DISCARD, false}}};

void set(GLenum name, bool on) {
  if (on) {
    glEnable(name);
  } else {
    glDisable(name);
  }
}

}  // namespace

RasterState::RasterState(int width, int height) {
  static_assert(kSwitchList.size() == kSwitches);
  for (std::size_t i = 0; i < kSwitches; ++i) {
    switches_[i] = glIsEnabled(kSwitchList[i].name);
    set(kSwitchList[i].name, kSwitchList[i].on);
  }
  glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  glGetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
  glGetIntegerv(GL_DEPTH_FUNC, &depth_function_);
  glGetIntegerv(GL_CLIP_ORIGIN, &clip_origin_);
  glGetIntegerv(GL_CLIP_DEPTH_MODE, &clip_depth_);
  glGetDoublev(GL_DEPTH_RANGE, depth_range_.data());
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
  glGetBooleanv(GL_COLOR_WRITEMASK, color_mask_.data());

  glViewport(0, 0, width, height);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDepthFunc(GL_GREATER);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthRange(0.0, 1.0);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

RasterState::~RasterState() {
  for (std::size_t i = 0; i < kSwitches; ++i) set(kSwitchList[i].name, switches_[i] != 0);
  glUseProgram(static_cast<GLuint>(program_));
  glBindVertexArray(static_cast<GLuint>(vertex_array_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(polygon_mode_[0]));
  glDepthFunc(static_cast<GLenum>(depth_function_));
  glClipControl(static_cast<GLenum>(clip_origin_), static_cast<GLenum>(clip_depth_));
  glDepthRange(depth_range_[0], depth_range_[1]);
  glDepthMask(depth_mask_);
  glColorMask(color_mask_[0], color_mask_[1], color_mask_[2], color_mask_[3]);
}

}  // namespace encore::renderer
