#include "renderer/gl/error_queue.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace encore::renderer::gl {

std::uint32_t discard_errors() {
  constexpr int kMost = 64;  // each kind of error has one flag a context, or one a GPU
  const GLenum first = glGetError();
  GLenum error = first;
  for (int i = 0; i < kMost && error != GL_NO_ERROR && error != GL_CONTEXT_LOST; ++i) {
    error = glGetError();
  }
  return first;
}

std::string error_name(std::uint32_t error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
      return "GL_CONTEXT_LOST";
    default:
      return fmt::format("OpenGL error 0x{:04x}", error);
  }
}

std::string reset_reason() {
  GLenum status = GL_NO_ERROR;
  if (epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness")) {
    status = glGetGraphicsResetStatus();
  } else if (epoxy_has_gl_extension("GL_ARB_robustness")) {
    status = glGetGraphicsResetStatusARB();
  }
  switch (status) {
    case GL_NO_ERROR:
      return {};
    case GL_GUILTY_CONTEXT_RESET:
      return "it took too long or crashed";
    case GL_INNOCENT_CONTEXT_RESET:
      return "another program's work took too long or crashed";
    default:
      return "for a reason it does not tell";
  }
}

}  // namespace encore::renderer::gl
