#include "accel/triangle_box.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::accel {

namespace {

using glm::dvec3;

// Each quantity below is a sum of at most three products of rounded differences; its error is under
// 8 units of 2^-53 times the sum of the products' magnitudes. Twice that leaves room for the
// rounding of the bound itself.
constexpr double kRounding = 16 * 0x1p-53;

// An edge in the projection along one axis: E(p) = du * (p.w - w) - dw * (p.u - u) is 0 along the
// edge from (u, w) in direction (du, dw). True if the box's range of E certainly lies beside the
// triangle's, which runs between 0 (the edge) and E(third vertex).
bool edge_separates(int u, int w, const dvec3& start, const dvec3& edge, const dvec3& third,
                    const dvec3& low, const dvec3& high) {
  const double du = edge[u];
  const double dw = edge[w];
  const double third_w = du * (third[w] - start[w]);
  const double third_u = dw * (third[u] - start[u]);
  const double e_third = third_w - third_u;

  const double w0 = du * (low[w] - start[w]);
  const double w1 = du * (high[w] - start[w]);
  const double u0 = dw * (low[u] - start[u]);
  const double u1 = dw * (high[u] - start[u]);
  const double box_min = std::min(w0, w1) - std::max(u0, u1);
  const double box_max = std::max(w0, w1) - std::min(u0, u1);

  const double error =
      kRounding * (std::fabs(third_w) + std::fabs(third_u) +
                   std::max(std::fabs(w0), std::fabs(w1)) + std::max(std::fabs(u0), std::fabs(u1)));
  return box_min > std::max(0.0, e_third) + error || box_max < std::min(0.0, e_third) - error;
}

// True if the whole box certainly lies on one side of the triangle's plane.
bool plane_separates(const dvec3& v0, const dvec3& e0, const dvec3& e1, const dvec3& low,
                     const dvec3& high) {
  double nearest = 0.0;
  double farthest = 0.0;
  double magnitude = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int w = (axis + 2) % 3;
    const double plus = e0[u] * e1[w];
    const double minus = e0[w] * e1[u];
    const double normal = plus - minus;
    const double to_low = low[axis] - v0[axis];
    const double to_high = high[axis] - v0[axis];
    nearest += std::min(normal * to_low, normal * to_high);
    farthest += std::max(normal * to_low, normal * to_high);
    magnitude +=
        (std::fabs(plus) + std::fabs(minus)) * std::max(std::fabs(to_low), std::fabs(to_high));
  }
  const double error = kRounding * magnitude;
  return nearest > error || farthest < -error;
}

bool contains(const scene::Bounds& box, const glm::vec3& p) {
  return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y &&
         p.z >= box.min.z && p.z <= box.max.z;
}

}  // namespace

bool overlaps(const scene::Triangle& triangle, const scene::Bounds& box) {
  // The box's own normals: bounds against bounds, exact.
  const scene::Bounds bounds = scene::bounds_of(triangle);
  for (int axis = 0; axis < 3; ++axis) {
    if (bounds.min[axis] > box.max[axis] || bounds.max[axis] < box.min[axis]) return false;
  }

  // A vertex inside settles most of the rest.
  if (contains(box, triangle.v0) || contains(box, triangle.v1) || contains(box, triangle.v2)) {
    return true;
  }

  const dvec3 low(box.min);
  const dvec3 high(box.max);
  const std::array<dvec3, 3> v{dvec3(triangle.v0), dvec3(triangle.v1), dvec3(triangle.v2)};
  const std::array<dvec3, 3> e{v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  if (plane_separates(v[0], e[0], e[1], low, high)) return false;

  // The nine cross products: each edge in each of the three axis projections.
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3& third = v[(i + 2) % 3];
    for (int axis = 0; axis < 3; ++axis) {
      if (edge_separates((axis + 1) % 3, (axis + 2) % 3, v[i], e[i], third, low, high)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace encore::accel
