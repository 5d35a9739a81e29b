#pragma once

#include "renderer/overlay/overlay_items.h"
#include "scene/bounds.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace encore::renderer {

/// A corner of a face, as shaders/overlay_fill.vert takes it.
struct OverlayCorner {
  glm::vec3 position{0.0F};
  std::uint32_t rgba = 0;
};

/// The few things of an overlay that are given anew for every picture, as lists that can be drawn:
/// a point is a line without length, a quad two triangles and four edges. Memory is reused.
class OverlayGeometry {
 public:
  /// Takes all but the boxes. Whatever has a coordinate that is not finite is left out.
  void gather(const OverlayItems& items, float edge_px);

  [[nodiscard]] const std::vector<OverlayCorner>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<OverlaySegment>& lines() const { return lines_; }
  [[nodiscard]] const scene::Bounds& bounds() const { return bounds_; }

 private:
  void add_polygon(const glm::vec3* corners, int count, std::uint32_t rgba, float edge_px);
  void add_line(const OverlaySegment& line);

  std::vector<OverlayCorner> faces_;
  std::vector<OverlaySegment> lines_;
  scene::Bounds bounds_;
};

}  // namespace encore::renderer
