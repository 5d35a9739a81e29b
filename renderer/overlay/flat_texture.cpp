#include "renderer/overlay/flat_texture.h"

#include "renderer/gl/error.h"
#include "renderer/gl/error_queue.h"
#include "renderer/overlay/overlay_state.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <stdexcept>

namespace encore::renderer {

namespace {

void check_count(std::size_t given, std::size_t wanted) {
  if (given == wanted) return;
  throw std::invalid_argument(
      fmt::format("a texture of {} values was given {}; give one a place", wanted, given));
}

}  // namespace

FlatTexture::~FlatTexture() {
  release();
}

void FlatTexture::release() {
  if (id_ != 0) glDeleteTextures(1, &id_);
  id_ = 0;
  width_ = 0;
  height_ = 0;
}

void FlatTexture::resize(int width, int height, int most) {
  if (width <= 0 || height <= 0) {
    throw std::invalid_argument(
        fmt::format("a picture needs at least one pixel each way, not {} x {}", width, height));
  }
  if (id_ != 0 && width == width_ && height == height_) return;
  if (width > most || height > most) {
    throw gl::GlError(
        fmt::format("a picture of {} x {} pixels is larger than this device allows: at most {} x "
                    "{}; make the window or the picture smaller",
                    width, height, most, most));
  }
  release();
  glGenTextures(1, &id_);
  const PixelTransferState state(id_);
  gl::discard_errors();
  const bool colors = kind_ == PixelKind::rgba8;
  glTexStorage2D(GL_TEXTURE_2D, 1, colors ? GL_RGBA8 : GL_R32F, width, height);
  const GLenum error = glGetError();
  const GLint filter = colors ? GL_LINEAR : GL_NEAREST;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (error != GL_NO_ERROR) {
    release();
    throw gl::GlError(fmt::format(
        "the device has no room for a picture of {} x {} pixels ({}); close other programs that "
        "use it, or make the picture smaller",
        width, height, gl::error_name(error)));
  }
  width_ = width;
  height_ = height;
}

void FlatTexture::write(std::span<const std::uint8_t> rgba) {
  check_count(rgba.size(), 4 * pixels());
  const PixelTransferState state(id_);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

void FlatTexture::write(std::span<const float> distances) {
  check_count(distances.size(), pixels());
  const PixelTransferState state(id_);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RED, GL_FLOAT, distances.data());
}

void FlatTexture::read(std::span<std::uint8_t> rgba) const {
  check_count(rgba.size(), 4 * pixels());
  const PixelTransferState state(id_);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

}  // namespace encore::renderer
