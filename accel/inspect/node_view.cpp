#include "accel/inspect/node_selection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace encore::accel {

namespace {

HalfSpace through(const glm::dvec3& point, const glm::dvec3& normal) {
  return {normal, -glm::dot(normal, point)};
}

}  // namespace

NodeView3d perspective_view(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up,
                            double vertical_fov_degrees, int width, int height) {
  const glm::dvec3 right = glm::cross(forward, up);
  const double high = std::tan(vertical_fov_degrees * std::numbers::pi / 360.0);
  const double wide = high * width / height;
  NodeView3d view;
  view.eye = eye;
  view.forward = forward;
  view.pixels_per_unit = height / (2.0 * high);
  view.planes = {through(eye, forward * wide + right), through(eye, forward * wide - right),
                 through(eye, forward * high + up), through(eye, forward * high - up),
                 through(eye, forward)};
  return view;
}

NodeView3d orthographic_view(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up,
                             double units_high, int width, int height) {
  const glm::dvec3 right = glm::cross(forward, up);
  const double high = units_high / 2.0;
  const double wide = high * width / height;
  NodeView3d view;
  view.eye = eye;
  view.forward = forward;
  view.pixels_per_unit = height / units_high;
  view.orthographic = true;
  view.planes = {through(eye - right * wide, right), through(eye + right * wide, -right),
                 through(eye - up * high, up), through(eye + up * high, -up),
                 through(eye, forward)};
  return view;
}

// All of what follows is monotone in every coordinate of the box, rounding included: a box inside
// another one is never nearer nor larger. That is what lets a tree be cut off at a node.

float view_distance(const NodeView3d& view, const Bounds& box) {
  if (view.orthographic) {
    double nearest = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double corner = view.forward[a] > 0 ? box.min[a] : box.max[a];
      nearest += view.forward[a] * (corner - view.eye[a]);
    }
    return static_cast<float>(std::max(nearest, 0.0));
  }
  double squared = 0.0;
  for (int a = 0; a < 3; ++a) {
    const double gap =
        std::max({double{box.min[a]} - view.eye[a], view.eye[a] - double{box.max[a]}, 0.0});
    squared += gap * gap;
  }
  return static_cast<float>(std::sqrt(squared));
}

float size_in_pixels(const NodeView3d& view, const Bounds& box) {
  double squared = 0.0;
  for (int a = 0; a < 3; ++a) {
    const double side = std::max(double{box.max[a]} - double{box.min[a]}, 0.0);
    squared += side * side;
  }
  const double size = std::sqrt(squared) * view.pixels_per_unit;
  if (view.orthographic || size == 0.0) return static_cast<float>(size);
  return static_cast<float>(size / double{view_distance(view, box)});
}

}  // namespace encore::accel
