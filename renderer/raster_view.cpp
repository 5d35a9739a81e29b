#include "renderer/raster_view.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace encore::renderer {

namespace {

// Depths are relative to the distance, so a near plane costs no precision however near it is. This
// one leaves all depths of a scene far above the smallest normal number.
constexpr float kNear = 0x1p-64F;

/// The power of two that brings the farthest corner of `bounds` to within [0.5, 1) of the eye.
float scale_to_one(const glm::dvec3& eye, const scene::Bounds& bounds) {
  if (bounds.empty()) return 1.0F;
  const glm::dvec3 reach =
      glm::max(glm::abs(glm::dvec3(bounds.min) - eye), glm::abs(glm::dvec3(bounds.max) - eye));
  int exponent = 0;
  (void)std::frexp(std::max({reach.x, reach.y, reach.z}), &exponent);
  return std::ldexp(1.0F, std::clamp(-exponent, -126, 126));
}

/// What takes `scale` back out of the clip axes of an orthographic view: no distance divides it
/// away. Smaller where the axes would leave the range of floats, for pictures of a 2^-100th of the
/// scene's size, which floats cannot resolve anyway.
double orthographic_factor(const CameraFrame& frame, float scale) {
  constexpr double kLongestAxis = 0x1p100;
  const double length =
      2.0 / (2.0 * std::min(frame.center_x, frame.center_y) * glm::length(frame.right));
  return std::min(1.0 / static_cast<double>(scale), kLongestAxis / length);
}

}  // namespace

RasterView make_raster_view(const CameraFrame& frame, int width, int height,
                            const scene::Bounds& bounds) {
  RasterView view;
  view.eye = frame.origin;
  view.scale = scale_to_one(glm::dvec3(frame.origin), bounds);
  view.orthographic = frame.orthographic;
  // A point lies dot(right, d) / dot(right, right) / distance pixels (orthographic: not divided)
  // from the middle, and half the picture's pixels are one unit of clip coordinates.
  const double per_x = 2.0 / (width * glm::dot(frame.right, frame.right));
  const double per_y = 2.0 / (height * glm::dot(frame.up, frame.up));
  const double unscaled = frame.orthographic ? orthographic_factor(frame, view.scale) : 1.0;
  view.clip_x = glm::vec3(frame.right * (per_x * unscaled));
  view.clip_y = glm::vec3(frame.up * (-per_y * unscaled));
  view.forward = glm::vec3(frame.forward);
  view.near_plane = kNear;
  return view;
}

}  // namespace encore::renderer
