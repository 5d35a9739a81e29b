#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace encore::renderer {

// Colours of an overlay are four bytes, red in the lowest (as Dear ImGui's): sRGB codes as they go
// to the screen, and a straight opacity. They are blended as codes, as window toolkits do.

/// For OverlayBox::flags.
inline constexpr std::uint32_t kOverlayBoxFilled = 1;  ///< its faces are drawn too
inline constexpr std::uint32_t kOverlayBoxBold = 2;    ///< its edges are drawn twice as thick

/// A box; one that is empty (min > max) or not finite is left out. Other bits of `flags` are the
/// caller's.
struct OverlayBox {
  glm::vec3 min{0.0F};
  std::uint32_t rgba = 0xFFFFFFFFU;
  glm::vec3 max{0.0F};
  std::uint32_t flags = 0;
};
static_assert(sizeof(OverlayBox) == 32, "two texels of the device's copy");

/// A flat quadrilateral, corners in order around it: a kd-tree's plane within its node. Its fill
/// has the colour as given, its edges are opaque.
struct OverlayQuad {
  glm::vec3 corners[4];
  std::uint32_t rgba = 0x40FFFFFFU;
};

/// A part of a line, with round ends: a ray's way. A width below 1 is drawn a pixel wide and so
/// much fainter.
struct OverlaySegment {
  glm::vec3 from{0.0F};
  glm::vec3 to{0.0F};
  std::uint32_t rgba = 0xFFFFFFFFU;
  float width_px = 1.5F;
};

/// A disc: where a ray hits.
struct OverlayPoint {
  glm::vec3 position{0.0F};
  std::uint32_t rgba = 0xFFFFFFFFU;
  float diameter_px = 7.0F;
};

/// A triangle that is pointed out: filled as given, edges opaque.
struct OverlayTriangle {
  glm::vec3 corners[3];
  std::uint32_t rgba = 0x8000FFFFU;
};

/// What one picture shows, in this order of drawing: faces (boxes, quads, triangles), then edges of
/// boxes, of quads and of triangles, then segments, then points. Within a kind, the order given.
struct OverlayItems {
  std::span<const std::uint32_t> boxes{};  ///< indices into what OverlayRenderer::set_boxes() got
  std::span<const OverlayQuad> quads{};
  std::span<const OverlaySegment> segments{};
  std::span<const OverlayPoint> points{};
  std::span<const OverlayTriangle> triangles{};
};

}  // namespace encore::renderer
