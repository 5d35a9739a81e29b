#pragma once

#include "scene/bounds.h"
#include "scene/triangle.h"

#include <glm/vec3.hpp>

#include <vector>

namespace encore::accel::test {

/// Whether clipping a triangle to a box (Sutherland and Hodgman 1974, in double) leaves anything.
/// `margin` grows the box by that share of its size on every side, or shrinks it if negative.
inline bool clip_leaves_something(const scene::Triangle& t, const scene::Bounds& box,
                                  double margin) {
  std::vector<glm::dvec3> polygon{glm::dvec3(t.v0), glm::dvec3(t.v1), glm::dvec3(t.v2)};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min[axis];
    const double high = box.max[axis];
    for (const double side : {1.0, -1.0}) {
      // Kept where side * p >= limit.
      const double limit = (side > 0 ? low : -high) - margin * (high - low);
      std::vector<glm::dvec3> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double da = side * a[axis] - limit;
        const double db = side * b[axis] - limit;
        if (da >= 0) kept.push_back(a);
        if ((da < 0) != (db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
      }
      polygon = std::move(kept);
      if (polygon.empty()) return false;
    }
  }
  return true;
}

}  // namespace encore::accel::test
