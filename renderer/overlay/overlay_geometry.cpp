#include "renderer/overlay/overlay_geometry.h"

#include "scene/triangle.h"

#include <algorithm>

namespace encore::renderer {

namespace {

constexpr std::uint32_t kOpaque = 0xFF000000U;

}  // namespace

void OverlayGeometry::gather(const OverlayItems& items, float edge_px) {
  faces_.clear();
  lines_.clear();
  bounds_ = {};
  for (const OverlayQuad& quad : items.quads) add_polygon(quad.corners, 4, quad.rgba, edge_px);
  for (const OverlayTriangle& triangle : items.triangles) {
    add_polygon(triangle.corners, 3, triangle.rgba, edge_px);
  }
  for (const OverlaySegment& segment : items.segments) add_line(segment);
  for (const OverlayPoint& p : items.points) {
    add_line({p.position, p.position, p.rgba, p.diameter_px});
  }
}

void OverlayGeometry::add_polygon(const glm::vec3* corners, int count, std::uint32_t rgba,
                                  float edge_px) {
  if (!std::all_of(corners, corners + count,
                   [](const glm::vec3& c) { return scene::is_finite(c); }))
    return;
  for (int i = 1; i + 1 < count; ++i) {
    for (const glm::vec3& corner : {corners[0], corners[i], corners[i + 1]}) {
      faces_.push_back({corner, rgba});
    }
  }
  for (int i = 0; i < count; ++i) {
    add_line({corners[i], corners[(i + 1) % count], rgba | kOpaque, edge_px});
  }
}

void OverlayGeometry::add_line(const OverlaySegment& line) {
  if (!scene::is_finite(line.from) || !scene::is_finite(line.to)) return;
  bounds_.extend(line.from);
  bounds_.extend(line.to);
  lines_.push_back(line);
}

}  // namespace encore::renderer
