#include "renderer/picture.h"

#include "renderer/gl/error.h"
#include "renderer/gl/error_queue.h"
#include "shaders/shared/bindings.h"

#include <epoxy/gl.h>

#include <stdexcept>
#include <string>

namespace encore::renderer {

namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

}  // namespace

Picture::~Picture() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void Picture::resize(int width, int height, int most) {
  if (texture_ != 0 && width == width_ && height == height_) return;
  if (width > most || height > most) {
    throw gl::GlError("a picture of " + size_text(width, height) +
                      " is larger than this device allows: at most " + size_text(most, most) +
                      "; draw a smaller one or use --device cpu");
  }
  if (texture_ != 0) glDeleteTextures(1, &texture_);
  texture_ = 0;
  width_ = width;
  height_ = height;
  glGenTextures(1, &texture_);
  gl::discard_errors();
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, height);
  const GLenum error = glGetError();
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, 0);
  if (error == GL_NO_ERROR) return;
  glDeleteTextures(1, &texture_);
  texture_ = 0;
  throw gl::GlError("the device has no room for a picture of " + size_text(width, height) + " (" +
                    gl::error_name(error) + "); draw a smaller one or use --device cpu");
}

void Picture::bind() const {
  glBindImageTexture(ENCORE_BINDING_PICTURE, texture_, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
}

void Picture::read(Image& image) const {
  if (texture_ == 0) throw std::logic_error("there is no picture yet: draw() one first");
  image.resize(width_, height_);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  glBindTexture(GL_TEXTURE_2D, texture_);
  // Rows of three floats a pixel are always a multiple of the default alignment, 4 bytes.
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_FLOAT, image.pixels.data());
  glBindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace encore::renderer
