#include "renderer/overlay/overlay_boxes.h"

#include "renderer/gl/error.h"
#include "scene/triangle.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace encore::renderer {

namespace {

constexpr GLenum kDataUnit = GL_TEXTURE2;   ///< as in shaders/overlay_boxes.glsl
constexpr GLenum kColorUnit = GL_TEXTURE3;  ///< likewise
constexpr std::uint64_t kTexelsPerBox = 2;

void check_fits(std::size_t count) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  if (count * kTexelsPerBox <= static_cast<std::uint64_t>(most)) return;
  throw gl::GlError(
      fmt::format("drawing {} boxes needs a texture buffer of {} texels; this device's largest has "
                  "{}; show fewer levels of the structure",
                  count, count * kTexelsPerBox, most));
}

scene::Bounds bounds_of(std::span<const OverlayBox> boxes) {
  scene::Bounds bounds;
  for (const OverlayBox& box : boxes) {
    const scene::Bounds one{box.min, box.max};
    if (!one.empty() && scene::is_finite(one.min) && scene::is_finite(one.max)) bounds.extend(one);
  }
  return bounds;
}

/// Attaches a buffer's present memory to a texture, made when first needed.
void attach(GLenum unit, std::uint32_t& texture, GLenum format, const gl::Buffer& buffer) {
  if (texture == 0) glGenTextures(1, &texture);
  GLint active = 0;
  GLint bound = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  glActiveTexture(unit);
  glGetIntegerv(GL_TEXTURE_BINDING_BUFFER, &bound);
  glBindTexture(GL_TEXTURE_BUFFER, texture);
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer.id());
  glBindTexture(GL_TEXTURE_BUFFER, static_cast<GLuint>(bound));
  glActiveTexture(static_cast<GLenum>(active));
}

std::uint64_t send(gl::Buffer& buffer, std::span<const std::byte> bytes) {
  buffer.reserve(bytes.size(), UINT64_MAX);
  buffer.write(bytes);
  return bytes.size();
}

}  // namespace

OverlayBoxes::~OverlayBoxes() {
  if (data_texture_ != 0) glDeleteTextures(1, &data_texture_);
  if (color_texture_ != 0) glDeleteTextures(1, &color_texture_);
}

std::uint64_t OverlayBoxes::set(std::span<const OverlayBox> boxes, std::uint64_t version) {
  if (version_ == version) return 0;
  version_.reset();
  color_version_.reset();
  count_ = 0;
  check_fits(boxes.size());
  std::vector<std::uint32_t> colors;
  colors.reserve(boxes.size());
  for (const OverlayBox& box : boxes) colors.push_back(box.rgba);
  std::uint64_t sent = send(data_, std::as_bytes(boxes));
  sent += send(colors_, std::as_bytes(std::span(colors)));
  attach(kDataUnit, data_texture_, GL_RGBA32UI, data_);
  attach(kColorUnit, color_texture_, GL_R32UI, colors_);
  bounds_ = bounds_of(boxes);
  any_filled_ = std::any_of(boxes.begin(), boxes.end(), [](const OverlayBox& box) {
    return (box.flags & kOverlayBoxFilled) != 0;
  });
  count_ = boxes.size();
  version_ = version;
  return sent;
}

std::uint64_t OverlayBoxes::set_colors(std::span<const std::uint32_t> rgba, std::uint64_t version) {
  if (rgba.size() != count_) {
    throw std::invalid_argument(
        fmt::format("{} colours for {} boxes: there must be one a box", rgba.size(), count_));
  }
  if (color_version_ == version) return 0;
  const std::uint64_t sent = send(colors_, std::as_bytes(rgba));
  color_version_ = version;
  return sent;
}

void OverlayBoxes::bind() const {
  glActiveTexture(kDataUnit);
  glBindTexture(GL_TEXTURE_BUFFER, data_texture_);
  glActiveTexture(kColorUnit);
  glBindTexture(GL_TEXTURE_BUFFER, color_texture_);
}

}  // namespace encore::renderer
