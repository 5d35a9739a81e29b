#pragma once

#include "renderer/camera_rays.h"
#include "scene/bounds.h"

#include <glm/vec3.hpp>

namespace encore::renderer {

/// A camera as rasterisation needs it: how points become clip coordinates.
///
/// A point is taken relative to the eye and by `scale`, a power of two that brings the farthest
/// corner of the scene to between a half and one away; so neither far eyes nor scenes of 1e18 or
/// 1e-18 units cost precision. With d = (point - eye) * scale its clip coordinates are
/// (dot(clip_x, d), dot(clip_y, d), near_plane, dot(forward, d)): an infinite far plane and depths
/// of near / distance in (0, 1], greater is nearer, which single precision resolves equally well at
/// every distance (Lapidous and Jiao 1999). Orthographic clip coordinates are
/// (dot(clip_x, d), dot(clip_y, d), 1 - dot(forward, d) / 2, 1): depths fall evenly from 1 at the
/// plane through the eye, in steps of 2^-24, and no corner lies as far as 0. Clip y counts
/// downwards, so that row 0 of the picture is row 0 of the texture.
struct RasterView {
  glm::vec3 eye{0.0F};
  float scale = 1.0F;
  glm::vec3 clip_x{0.0F};
  glm::vec3 clip_y{0.0F};
  glm::vec3 forward{0.0F, 0.0F, -1.0F};
  float near_plane = 1.0F;  ///< perspective: distance of the near plane after scaling
  bool orthographic = false;
};

/// The view through `frame`, made for width x height pixels, of a scene with these bounds (which
/// may be empty). The grid of pixels is that of camera_rays().
RasterView make_raster_view(const CameraFrame& frame, int width, int height,
                            const scene::Bounds& bounds);

}  // namespace encore::renderer
