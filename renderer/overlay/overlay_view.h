#pragma once

#include "renderer/camera_rays.h"
#include "scene/bounds.h"
#include "scene/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <optional>

namespace encore::renderer {

/// What becomes of the parts that lie behind the scene's surface.
enum class OverlayMode {
  x_ray,        ///< drawn like all others
  hidden_line,  ///< not drawn
  dimmed,       ///< drawn at a quarter of their opacity
};

/// How an overlay is looked at.
struct OverlayView {
  scene::Camera camera;
  int width = 0;
  int height = 0;
  OverlayMode mode = OverlayMode::x_ray;

  /// (n, d): what lies where dot(n, p) + d > 0 is cut away. n need not have unit length.
  std::optional<glm::vec4> section_plane;

  /// A two-dimensional texture of the context that is drawn below, stretched to the picture without
  /// filtering; 0: `background_rgba` is. Row 0 is the top.
  std::uint32_t background_texture = 0;
  bool background_is_linear = false;  ///< linear RGB, as renderers' textures; else sRGB codes
  std::uint32_t background_rgba = 0xFF202020U;

  float edge_px = 1.25F;       ///< thickness of boxes', quads' and triangles' edges
  float fill_opacity = 0.15F;  ///< boxes' faces: a factor on the opacity of their colours
  bool fill_all = false;       ///< faces of all boxes, not only of those flagged

  /// How much farther than the surface a point may be and still count as on it, relative to its
  /// distance. Rounding alone would ask for some 2^-22. But a line is drawn up to half its width
  /// beside its true place, where a slanted surface that touches it (a leaf's box does) is nearer:
  /// by the angle of a pixel, about 1e-3, times the tangent of the slant.
  float depth_bias = 4e-3F;
};

/// What the shaders know of a view: the twin of the block in shaders/overlay_view.glsl (std140).
///
/// A point p is taken as d = (p - eye) * scale, scale a power of two that brings the farthest thing
/// to about 1 (RasterView says why). Its pixel is center + (dot(across, d), dot(down, d)) / w where
/// w is dot(forward, d) or, without perspective, 1: the grid of camera_rays().
struct OverlayBlock {
  glm::vec3 eye{0.0F};
  float scale = 1.0F;
  glm::vec3 across{0.0F};
  float near_depth = 0.0F;
  glm::vec3 down{0.0F};
  float perspective = 1.0F;
  glm::vec3 forward{0.0F};
  float hidden_opacity = 1.0F;
  glm::vec3 right{0.0F};
  float reach = 1.0F;
  glm::vec3 up{0.0F};
  float has_depth = 0.0F;
  glm::vec4 section{0.0F, 0.0F, 0.0F, -1.0F};
  glm::vec2 size{0.0F};
  glm::vec2 center{0.0F};
  float edge_px = 1.0F;
  float fill_opacity = 0.0F;
  float fill_all = 0.0F;
  float bold = 2.0F;
};
static_assert(sizeof(OverlayBlock) == 144, "as std140 lays it out");

/// The block for a view of things within `bounds` (which may be empty), over a surface that is
/// known or not. Throws std::invalid_argument for a camera or a size that make_camera_frame()
/// rejects, a section plane without a direction, and numbers that are negative or not finite.
OverlayBlock make_overlay_block(const OverlayView& view, const scene::Bounds& bounds,
                                bool has_depth);

/// Where the block's shaders place a point, in pixels from the picture's top left; nothing if it is
/// not before the eye. The same formula in the same precision: for picking and for tests.
std::optional<glm::vec2> overlay_pixel(const OverlayBlock& block, const glm::vec3& point);

}  // namespace encore::renderer
