#include "accel/kdtree/triangle_clip.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

namespace encore::accel {

namespace {

using glm::dvec3;
using glm::vec3;
using scene::Bounds;
using scene::Triangle;

/// Interpolating a corner is off by less than 8 * 2^-53 times the triangle's largest coordinate on
/// that axis. Six cuts in a row add up to at most 48 of those units, a cut of the halves one step
/// more; planes and results are moved by 128. A point of the exact part thus stays inside every
/// moved plane by more than the error gathered so far, and no cut can lose it.
constexpr double kMargin = 0x1p-46;

struct Corner {
  dvec3 point;
  double computed;  ///< 1 if interpolated, 0 if it is a vertex of the triangle
};

/// A convex polygon. Rounding may bend it a little, and a bent one of n corners has at most
/// floor(1.5 n) after a cut: 28 after the six of a box.
struct Polygon {
  Corner corners[28];
  int count = 0;
  void add(const Corner& corner) { corners[count++] = corner; }
};

/// Where the edge from a to b meets the plane; the corners lie strictly on different sides.
Corner cross(const Corner& a, const Corner& b, int axis, double plane) {
  const double to_a = a.point[axis] - plane;
  const double to_b = b.point[axis] - plane;
  Corner corner{a.point + (to_a / (to_a - to_b)) * (b.point - a.point), 1.0};
  corner.point[axis] = plane;
  return corner;
}

/// Keeps what lies on the plane's `side`: +1 above, -1 below.
void cut(const Polygon& from, Polygon& to, int axis, double plane, double side) {
  to.count = 0;
  for (int i = 0; i < from.count; ++i) {
    const Corner& a = from.corners[i];
    const Corner& b = from.corners[i + 1 < from.count ? i + 1 : 0];
    const double inside_a = side * (a.point[axis] - plane);
    const double inside_b = side * (b.point[axis] - plane);
    if (inside_a >= 0.0) to.add(a);
    if ((inside_a > 0.0 && inside_b < 0.0) || (inside_a < 0.0 && inside_b > 0.0)) {
      to.add(cross(a, b, axis, plane));
    }
  }
}

/// Bounds in double of the corners added, computed ones widened by the margin.
struct WideBounds {
  dvec3 min{std::numeric_limits<double>::infinity()};
  dvec3 max{-std::numeric_limits<double>::infinity()};
  void extend(const Corner& corner, const dvec3& margin) {
    const dvec3 widened = margin * corner.computed;
    min = glm::min(min, corner.point - widened);
    max = glm::max(max, corner.point + widened);
  }
};

float round_down(double value) {
  const auto nearest = static_cast<float>(value);
  if (double(nearest) <= value) return nearest;
  const auto bits = std::bit_cast<std::uint32_t>(nearest);
  if (nearest > 0.0F) return std::bit_cast<float>(bits - 1);
  if (nearest < 0.0F) return std::bit_cast<float>(bits + 1);
  return -std::numeric_limits<float>::denorm_min();
}

float round_up(double value) {
  return -round_down(-value);
}

/// Rounds outwards to float, within `limit`. Clamping comes first, so the conversions are in range.
Bounds narrow(const WideBounds& wide, const Bounds& limit) {
  Bounds bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::max(wide.min[axis], double(limit.min[axis]));
    const double high = std::min(wide.max[axis], double(limit.max[axis]));
    if (!(low <= high)) return Bounds{};
    bounds.min[axis] = round_down(low);
    bounds.max[axis] = round_up(high);
  }
  return bounds;
}

/// Adds the corners of the polygon's parts below `low_plane` and above `high_plane` to the bounds.
void halve(const Polygon& polygon, int axis, double low_plane, double high_plane,
           const dvec3& margin, WideBounds& lower, WideBounds& upper) {
  for (int i = 0; i < polygon.count; ++i) {
    const Corner& a = polygon.corners[i];
    const Corner& b = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const double at_a = a.point[axis];
    const double at_b = b.point[axis];
    if (at_a <= low_plane) lower.extend(a, margin);
    if (at_a >= high_plane) upper.extend(a, margin);
    if ((at_a < low_plane) != (at_b < low_plane) && at_a != low_plane && at_b != low_plane) {
      lower.extend(cross(a, b, axis, low_plane), margin);
    }
    if ((at_a < high_plane) != (at_b < high_plane) && at_a != high_plane && at_b != high_plane) {
      upper.extend(cross(a, b, axis, high_plane), margin);
    }
  }
}

}  // namespace

SplitExtent split_extent(const Triangle& triangle, const Bounds& box, const Bounds& extent,
                         int axis, float position) {
  const Bounds whole = scene::bounds_of(triangle);
  const dvec3 margin = kMargin * dvec3(glm::max(glm::abs(whole.min), glm::abs(whole.max)));

  // Cut the triangle down to the box, by those planes only that it crosses.
  Polygon buffers[2];
  Polygon* polygon = &buffers[0];
  Polygon* next = &buffers[1];
  for (const vec3& vertex : {triangle.v0, triangle.v1, triangle.v2}) {
    polygon->add({dvec3(vertex), 0.0});
  }
  bool cut_before = false;
  for (int k = 0; k < 3; ++k) {
    if (whole.min[k] < box.min[k]) {
      cut(*polygon, *next, k, double(box.min[k]) - margin[k], 1.0);
      std::swap(polygon, next);
      cut_before = true;
    }
    if (whole.max[k] > box.max[k]) {
      cut(*polygon, *next, k, double(box.max[k]) + margin[k], -1.0);
      std::swap(polygon, next);
      cut_before = true;
    }
  }

  // Halve the rest. An uncut triangle is exact, so that its plane need not be moved.
  const double moved = cut_before ? margin[axis] : 0.0;
  WideBounds lower;
  WideBounds upper;
  halve(*polygon, axis, double(position) + moved, double(position) - moved, margin, lower, upper);
  Bounds lower_limit = extent;
  Bounds upper_limit = extent;
  lower_limit.max[axis] = std::min(extent.max[axis], position);
  upper_limit.min[axis] = std::max(extent.min[axis], position);
  return {narrow(lower, lower_limit), narrow(upper, upper_limit)};
}

}  // namespace encore::accel
