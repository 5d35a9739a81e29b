#include "renderer/overlay/overlay_view.h"

#include "renderer/raster_view.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace encore::renderer {

namespace {

constexpr float kDimmed = 0.25F;

float hidden_opacity(OverlayMode mode) {
  switch (mode) {
    case OverlayMode::x_ray:
      return 1.0F;
    case OverlayMode::hidden_line:
      return 0.0F;
    case OverlayMode::dimmed:
      return kDimmed;
  }
  return 1.0F;
}

/// The plane for points that are relative to the eye and scaled. In double precision: the plane may
/// be far from the origin, and close to the eye.
glm::vec4 section_of(const glm::vec4& plane, const glm::dvec3& eye, double scale) {
  const glm::dvec3 normal(plane);
  const double length = std::sqrt(glm::dot(normal, normal));
  if (!(length > 0.0) || !std::isfinite(length) || !std::isfinite(plane.w)) {
    throw std::invalid_argument("the section plane needs a direction and finite numbers");
  }
  const double offset = (glm::dot(normal, eye) + static_cast<double>(plane.w)) / length;
  return {glm::vec3(normal / length), static_cast<float>(offset * scale)};
}

/// Pixels to one unit of a scaled coordinate along `step`, which is a pixel's. Without perspective
/// no distance divides the scale away; lengths that are no floats are cut to some that are, for
/// pictures of a 2^-100th of the scene, which floats cannot resolve anyway.
glm::vec3 pixel_axis(const glm::dvec3& step, bool orthographic, float scale) {
  constexpr double kLongest = 0x1p100;
  const glm::dvec3 axis = step / glm::dot(step, step);
  if (!orthographic) return glm::vec3(axis);
  const double factor =
      std::min(1.0 / static_cast<double>(scale), kLongest / std::sqrt(glm::dot(axis, axis)));
  return glm::vec3(axis * factor);
}

void check(const OverlayView& view) {
  for (const float number : {view.edge_px, view.fill_opacity, view.depth_bias}) {
    if (!(number >= 0.0F) || !std::isfinite(number)) {
      throw std::invalid_argument(
          "an overlay's thickness, opacity and depth bias must be finite and not negative");
    }
  }
}

}  // namespace

OverlayBlock make_overlay_block(const OverlayView& view, const scene::Bounds& bounds,
                                bool has_depth) {
  check(view);
  const CameraFrame frame = make_camera_frame(view.camera, view.width, view.height);
  const RasterView raster = make_raster_view(frame, view.width, view.height, bounds);
  OverlayBlock block;
  block.eye = frame.origin;
  block.scale = raster.scale;
  block.across = pixel_axis(frame.right, frame.orthographic, block.scale);
  block.down = -pixel_axis(frame.up, frame.orthographic, block.scale);
  block.perspective = frame.orthographic ? 0.0F : 1.0F;
  block.near_depth = raster.near_plane;
  block.forward = glm::vec3(frame.forward);
  block.hidden_opacity = hidden_opacity(view.mode);
  block.right = glm::vec3(frame.right);
  block.up = glm::vec3(frame.up);
  block.reach = 1.0F + view.depth_bias;
  block.has_depth = has_depth && view.mode != OverlayMode::x_ray ? 1.0F : 0.0F;
  if (view.section_plane) {
    block.section = section_of(*view.section_plane, glm::dvec3(frame.origin), block.scale);
  }
  block.size = {view.width, view.height};
  block.center = {frame.center_x, frame.center_y};
  block.edge_px = view.edge_px;
  block.fill_opacity = view.fill_opacity;
  block.fill_all = view.fill_all ? 1.0F : 0.0F;
  return block;
}

std::optional<glm::vec2> overlay_pixel(const OverlayBlock& block, const glm::vec3& point) {
  const glm::vec3 d = (point - block.eye) * block.scale;
  const float depth = glm::dot(block.forward, d);
  if (!(depth >= block.near_depth)) return std::nullopt;
  const float divisor = block.perspective > 0.5F ? depth : 1.0F;
  return block.center + glm::vec2(glm::dot(block.across, d), glm::dot(block.down, d)) / divisor;
}

}  // namespace encore::renderer
