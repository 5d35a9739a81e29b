#include "renderer/overlay/overlay_state.h"

#include <epoxy/gl.h>

namespace encore::renderer {

namespace {

// All are off while an overlay is drawn, but for those that a pass turns on itself.
constexpr std::array<GLenum, 18> kSwitchList = {GL_BLEND,
                                                GL_DEPTH_TEST,
                                                GL_CULL_FACE,
                                                GL_SCISSOR_TEST,
                                                GL_STENCIL_TEST,
                                                GL_COLOR_LOGIC_OP,
                                                GL_DEPTH_CLAMP,
                                                GL_DITHER,
                                                GL_RASTERIZER_DISCARD,
                                                GL_PRIMITIVE_RESTART,
                                                GL_CLIP_DISTANCE0,
                                                GL_CLIP_DISTANCE1,
                                                GL_CLIP_DISTANCE2,
                                                GL_CLIP_DISTANCE3,
                                                GL_CLIP_DISTANCE4,
                                                GL_CLIP_DISTANCE5,
                                                GL_CLIP_DISTANCE6,
                                                GL_CLIP_DISTANCE7};

constexpr std::array<GLenum, 6> kBlendList = {GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA,
                                              GL_BLEND_SRC_RGB,      GL_BLEND_DST_RGB,
                                              GL_BLEND_SRC_ALPHA,    GL_BLEND_DST_ALPHA};

/// A setting of glPixelStorei, and what rows without gaps ask of it.
struct PixelSetting {
  GLenum name;
  GLint value;
};

constexpr std::array<PixelSetting, 8> kPixelList = {{{GL_PACK_ALIGNMENT, 4},
                                                     {GL_PACK_ROW_LENGTH, 0},
                                                     {GL_PACK_SKIP_PIXELS, 0},
                                                     {GL_PACK_SKIP_ROWS, 0},
                                                     {GL_UNPACK_ALIGNMENT, 4},
                                                     {GL_UNPACK_ROW_LENGTH, 0},
                                                     {GL_UNPACK_SKIP_PIXELS, 0},
                                                     {GL_UNPACK_SKIP_ROWS, 0}}};

GLenum as_enum(GLint value) {
  return static_cast<GLenum>(value);
}

GLuint as_name(GLint value) {
  return static_cast<GLuint>(value);
}

}  // namespace

OverlayState::OverlayState(int width, int height, bool clip_control) : clip_control_(clip_control) {
  static_assert(kSwitchList.size() == kSwitches);
  for (std::size_t i = 0; i < kSwitches; ++i) {
    switches_[i] = glIsEnabled(kSwitchList[i]);
    glDisable(kSwitchList[i]);
  }
  glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  glGetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
  for (std::size_t i = 0; i < blend_.size(); ++i) glGetIntegerv(kBlendList[i], &blend_[i]);
  glGetBooleanv(GL_COLOR_WRITEMASK, color_mask_.data());
  if (clip_control_) {
    glGetIntegerv(GL_CLIP_ORIGIN, &clip_origin_);
    glGetIntegerv(GL_CLIP_DEPTH_MODE, &clip_depth_);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  }
  save_units();

  glViewport(0, 0, width, height);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBlendEquation(GL_FUNC_ADD);
  // The picture stays opaque.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

OverlayState::~OverlayState() {
  restore_units();
  for (std::size_t i = 0; i < kSwitches; ++i) {
    if (switches_[i] != 0) {
      glEnable(kSwitchList[i]);
    } else {
      glDisable(kSwitchList[i]);
    }
  }
  glUseProgram(as_name(program_));
  glBindVertexArray(as_name(vertex_array_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, as_name(draw_framebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, as_name(read_framebuffer_));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glPolygonMode(GL_FRONT_AND_BACK, as_enum(polygon_mode_[0]));
  glBlendEquationSeparate(as_enum(blend_[0]), as_enum(blend_[1]));
  glBlendFuncSeparate(as_enum(blend_[2]), as_enum(blend_[3]), as_enum(blend_[4]),
                      as_enum(blend_[5]));
  glColorMask(color_mask_[0], color_mask_[1], color_mask_[2], color_mask_[3]);
  if (clip_control_) glClipControl(as_enum(clip_origin_), as_enum(clip_depth_));
}

void OverlayState::save_units() {
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active_unit_);
  for (std::size_t unit = 0; unit < kUnits; ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &textures_[unit]);
    glGetIntegerv(GL_TEXTURE_BINDING_BUFFER, &buffer_textures_[unit]);
    glGetIntegerv(GL_SAMPLER_BINDING, &samplers_[unit]);
    glBindSampler(static_cast<GLuint>(unit), 0);
  }
}

void OverlayState::restore_units() const {
  for (std::size_t unit = 0; unit < kUnits; ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, as_name(textures_[unit]));
    glBindTexture(GL_TEXTURE_BUFFER, as_name(buffer_textures_[unit]));
    glBindSampler(static_cast<GLuint>(unit), as_name(samplers_[unit]));
  }
  glActiveTexture(as_enum(active_unit_));
}

PixelTransferState::PixelTransferState(std::uint32_t texture) {
  static_assert(kPixelList.size() == kSettings);
  for (std::size_t i = 0; i < kSettings; ++i) {
    glGetIntegerv(kPixelList[i].name, &settings_[i]);
    glPixelStorei(kPixelList[i].name, kPixelList[i].value);
  }
  glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack_buffer_);
  glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack_buffer_);
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture_);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glBindTexture(GL_TEXTURE_2D, texture);
}

PixelTransferState::~PixelTransferState() {
  for (std::size_t i = 0; i < kSettings; ++i) glPixelStorei(kPixelList[i].name, settings_[i]);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, as_name(pack_buffer_));
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, as_name(unpack_buffer_));
  glBindTexture(GL_TEXTURE_2D, as_name(texture_));
}

}  // namespace encore::renderer
