#include "renderer/overlay/overlay_renderer.h"

#include "renderer/gl/error.h"
#include "renderer/overlay/overlay_state.h"
#include "renderer/overlay/screen_texture.h"
#include "scene/ray.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace encore::renderer {

namespace {

constexpr int kBlockBinding = 2;       ///< as in shaders/overlay_view.glsl
constexpr GLint kLinearValues = 0;     ///< the uniform of shaders/overlay_backdrop.frag
constexpr int kEdgeVertices = 12 * 6;  ///< of a box
constexpr int kFaceVertices = 6 * 6;

// Large sets go to the device in several calls, so that none keeps it busy for long.
constexpr std::size_t kBoxesPerDraw = 1U << 15U;

template <class Value>
std::uint64_t send_all(gl::Buffer& buffer, std::span<const Value> values) {
  if (values.empty()) return 0;
  buffer.reserve(values.size_bytes(), UINT64_MAX);
  buffer.write(std::as_bytes(values));
  return values.size_bytes();
}

void bind_array(std::uint32_t& array, const gl::Buffer& buffer, int stride) {
  if (array == 0) glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glBindVertexBuffer(0, buffer.id(), 0, stride);
}

void floats(GLuint attribute, int count, std::size_t offset) {
  glEnableVertexAttribArray(attribute);
  glVertexAttribFormat(attribute, count, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  glVertexAttribBinding(attribute, 0);
}

void integer(GLuint attribute, std::size_t offset) {
  glEnableVertexAttribArray(attribute);
  glVertexAttribIFormat(attribute, 1, GL_UNSIGNED_INT, static_cast<GLuint>(offset));
  glVertexAttribBinding(attribute, 0);
}

/// 0xAABBGGRR as four numbers, opaque.
std::array<float, 4> opaque_color(std::uint32_t rgba) {
  const auto channel = [&](int shift) {
    return static_cast<float>(rgba >> shift & 0xFFU) / 255.0F;
  };
  return {channel(0), channel(8), channel(16), 1.0F};
}

}  // namespace

OverlayRenderer::OverlayRenderer(std::shared_ptr<gl::Context> context)
    : context_(gl::made_current(std::move(context))) {
  gl::ProgramCache& programs = context_->programs();
  backdrop_ = programs.graphics("overlay_backdrop.vert", "overlay_backdrop.frag", {});
  box_faces_ = programs.graphics("overlay_fill.vert", "overlay_fill.frag", {"BOXES"});
  box_edges_ = programs.graphics("overlay_edge.vert", "overlay_edge.frag", {"BOXES"});
  faces_ = programs.graphics("overlay_fill.vert", "overlay_fill.frag", {});
  edges_ = programs.graphics("overlay_edge.vert", "overlay_edge.frag", {});
}

OverlayRenderer::~OverlayRenderer() {
  try {
    context_->make_current();  // the members' memory is this context's
  } catch (const gl::GlError&) {
    return;  // it went with the context
  }
  for (const std::uint32_t array : {box_array_, face_array_, line_array_}) {
    if (array != 0) glDeleteVertexArrays(1, &array);
  }
  if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
}

void OverlayRenderer::set_boxes(std::span<const OverlayBox> boxes, std::uint64_t version) {
  context_->make_current();
  unreported_bytes_ += boxes_.set(boxes, version);
}

void OverlayRenderer::set_box_colors(std::span<const std::uint32_t> rgba, std::uint64_t version) {
  context_->make_current();
  unreported_bytes_ += boxes_.set_colors(rgba, version);
}

void OverlayRenderer::set_depth(std::span<const float> distances, int width, int height) {
  context_->make_current();
  const auto wanted =
      static_cast<std::size_t>(std::max(width, 0)) * static_cast<std::size_t>(std::max(height, 0));
  if (distances.size() != wanted) {
    throw std::invalid_argument(fmt::format("{} distances for {} x {} pixels; give one a pixel",
                                            distances.size(), width, height));
  }
  depth_.resize(width, height, context_->capabilities().texture_size);
  depth_.write(distances);
  unreported_bytes_ += distances.size_bytes();
}

void OverlayRenderer::set_depth(std::span<const scene::Hit> hits, int width, int height) {
  distances_.resize(hits.size());
  std::transform(hits.begin(), hits.end(), distances_.begin(),
                 [](const scene::Hit& hit) { return hit.t; });
  set_depth(std::span<const float>(distances_), width, height);
}

void OverlayRenderer::clear_depth() {
  context_->make_current();
  depth_.release();
}

std::uint32_t OverlayRenderer::draw(const OverlayView& view, const OverlayItems& items) {
  static const std::string doing = "drawing the structure over the picture";
  check_indices(items.boxes);
  context_->make_current();
  geometry_.gather(items, view.edge_px);
  send(view, items);
  if (view.width != target_.width() || view.height != target_.height()) {
    framebuffer_texture_ = 0;  // another texture may come to have the same name
    target_.resize(view.width, view.height, context_->capabilities().texture_size);
  }
  {
    const OverlayState state(view.width, view.height, context_->capabilities().clip_control);
    attach_target(view);
    block_.bind_uniform(kBlockBinding);
    draw_backdrop(view);
    glEnable(GL_BLEND);
    if (has_depth()) {
      glActiveTexture(GL_TEXTURE1);
      glBindTexture(GL_TEXTURE_2D, depth_.id());
    }
    const bool faces = view.fill_opacity > 0.0F && (view.fill_all || boxes_.any_filled());
    draw_faces(faces ? items.boxes.size() : 0);
    draw_edges(view.edge_px > 0.0F ? items.boxes.size() : 0);
  }
  context_->check(doing);
  return target_.id();
}

void OverlayRenderer::read(std::vector<std::uint8_t>& rgba) {
  if (texture() == 0) throw std::logic_error("no overlay has been drawn yet");
  context_->make_current();
  rgba.resize(4 * target_.pixels());
  target_.read(rgba);
}

void OverlayRenderer::read(Image& image) {
  std::vector<std::uint8_t> rgba;
  read(rgba);
  image.resize(target_.width(), target_.height());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = {srgb8_to_linear(rgba[4 * i]), srgb8_to_linear(rgba[4 * i + 1]),
                       srgb8_to_linear(rgba[4 * i + 2])};
  }
}

void OverlayRenderer::check_indices(std::span<const std::uint32_t> boxes) const {
  if (boxes.empty()) return;
  const std::uint32_t largest = *std::max_element(boxes.begin(), boxes.end());
  if (largest < boxes_.count()) return;
  throw std::invalid_argument(
      fmt::format("there is no box {} to draw: set_boxes() was given {}", largest, boxes_.count()));
}

void OverlayRenderer::attach_target(const OverlayView& view) {
  if (framebuffer_ == 0) glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
  if (framebuffer_texture_ != 0) return;
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target_.id(), 0);
  const GLenum status = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  framebuffer_texture_ = status == GL_FRAMEBUFFER_COMPLETE ? target_.id() : 0;
  if (framebuffer_texture_ != 0) return;
  throw gl::GlError(fmt::format(
      "the driver cannot draw into a picture of {} x {} pixels with four bytes each (framebuffer "
      "status {:#06x}); a smaller one may do",
      view.width, view.height, status));
}

void OverlayRenderer::send(const OverlayView& view, const OverlayItems& items) {
  scene::Bounds bounds = geometry_.bounds();
  if (!items.boxes.empty()) bounds.extend(boxes_.bounds());
  const OverlayBlock block = make_overlay_block(view, bounds, has_depth());
  std::uint64_t sent = send_all(block_, std::span(&block, 1));
  sent += send_all(index_buffer_, items.boxes);
  sent += send_all(face_buffer_, std::span(geometry_.faces()));
  sent += send_all(line_buffer_, std::span(geometry_.lines()));
  report_.depth_missing = view.mode != OverlayMode::x_ray && !has_depth();
  report_.boxes = static_cast<std::uint32_t>(items.boxes.size());
  report_.uploaded_bytes = sent + std::exchange(unreported_bytes_, 0);
}

void OverlayRenderer::draw_backdrop(const OverlayView& view) {
  glClearBufferfv(GL_COLOR, 0, opaque_color(view.background_rgba).data());
  if (view.background_texture == 0) return;
  if (line_array_ == 0) glGenVertexArrays(1, &line_array_);
  backdrop_->use();
  glUniform1i(kLinearValues, view.background_is_linear ? 1 : 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, view.background_texture);
  glBindVertexArray(line_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void OverlayRenderer::draw_faces(std::size_t boxes) {
  glEnable(GL_CLIP_DISTANCE0);
  glEnable(GL_CLIP_DISTANCE1);
  if (boxes > 0) {
    box_faces_->use();
    draw_boxes(boxes, kFaceVertices);
  }
  if (!geometry_.faces().empty()) {
    faces_->use();
    bind_array(face_array_, face_buffer_, sizeof(OverlayCorner));
    floats(0, 3, offsetof(OverlayCorner, position));
    integer(1, offsetof(OverlayCorner, rgba));
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(geometry_.faces().size()));
  }
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_CLIP_DISTANCE1);
}

void OverlayRenderer::draw_edges(std::size_t boxes) {
  if (boxes > 0) {
    box_edges_->use();
    draw_boxes(boxes, kEdgeVertices);
  }
  if (geometry_.lines().empty()) return;
  edges_->use();
  bind_array(line_array_, line_buffer_, sizeof(OverlaySegment));
  floats(0, 3, offsetof(OverlaySegment, from));
  floats(1, 3, offsetof(OverlaySegment, to));
  integer(2, offsetof(OverlaySegment, rgba));
  floats(3, 1, offsetof(OverlaySegment, width_px));
  glVertexBindingDivisor(0, 1);
  glDrawArraysInstanced(GL_TRIANGLES, 0, 6, static_cast<GLsizei>(geometry_.lines().size()));
}

void OverlayRenderer::draw_boxes(std::size_t count, int vertices) {
  boxes_.bind();
  bind_array(box_array_, index_buffer_, sizeof(std::uint32_t));
  integer(0, 0);
  glVertexBindingDivisor(0, 1);
  for (std::size_t first = 0; first < count; first += kBoxesPerDraw) {
    if (first > 0) glFlush();
    const std::size_t drawn = std::min(kBoxesPerDraw, count - first);
    glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, vertices, static_cast<GLsizei>(drawn),
                                      static_cast<GLuint>(first));
  }
}

}  // namespace encore::renderer
