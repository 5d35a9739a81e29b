#include "renderer/raster_target.h"

#include "renderer/gl/error.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>

namespace encore::renderer {

RasterTarget::~RasterTarget() {
  if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
  if (depth_ != 0) glDeleteRenderbuffers(1, &depth_);
}

void RasterTarget::resize(int width, int height, int most) {
  const bool made = framebuffer_ != 0 && picture_.texture() != 0;
  if (made && width == picture_.width() && height == picture_.height()) return;
  picture_.resize(width, height, most);

  if (depth_ == 0) glGenRenderbuffers(1, &depth_);
  GLint bound_renderbuffer = 0;
  glGetIntegerv(GL_RENDERBUFFER_BINDING, &bound_renderbuffer);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glBindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(bound_renderbuffer));

  GLint bound_framebuffer = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound_framebuffer);
  if (framebuffer_ == 0) glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                         picture_.texture(), 0);
  glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  const GLenum status = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound_framebuffer));
  if (status == GL_FRAMEBUFFER_COMPLETE) return;

  // Nothing half-made may pass for a target of this size.
  glDeleteFramebuffers(1, &framebuffer_);
  framebuffer_ = 0;
  throw gl::GlError(fmt::format(
      "the driver cannot draw into a picture of {} x {} pixels with four floats each and a depth "
      "of "
      "32 bits (framebuffer status {:#06x}); a smaller picture may fit, or use another device",
      width, height, status));
}

void RasterTarget::bind() const {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
}

void RasterTarget::clear(const glm::vec3& background) {
  const std::array<float, 4> color = {background.r, background.g, background.b, 1.0F};
  const float farthest = 0.0F;
  glClearBufferfv(GL_COLOR, 0, color.data());
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

}  // namespace encore::renderer
