#include "scene/triangulate.h"

#include "scene/load_watch.h"

#include <glm/vec2.hpp>

#include <cmath>
#include <cstdint>
#include <utility>

namespace encore::scene {

namespace {

using Point = glm::dvec2;

constexpr std::uint64_t kTestsPerCorner = 1024;

double cross(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Projects along the largest component of Newell's normal so that the outline turns left. Doubles,
// relative to the first corner: differences of floats are then exact in all but absurd cases.
// Returns false if the polygon has no area.
bool project(std::span<const glm::vec3> polygon, std::vector<Point>& points) {
  glm::dvec3 normal(0.0);
  const glm::dvec3 origin(polygon.front());
  glm::dvec3 a = glm::dvec3(polygon.back()) - origin;
  for (const glm::vec3& corner : polygon) {
    const glm::dvec3 b = glm::dvec3(corner) - origin;
    normal.x += (a.y - b.y) * (a.z + b.z);
    normal.y += (a.z - b.z) * (a.x + b.x);
    normal.z += (a.x - b.x) * (a.y + b.y);
    a = b;
  }
  int axis = 2;
  if (std::abs(normal.x) > std::abs(normal[axis])) axis = 0;
  if (std::abs(normal.y) > std::abs(normal[axis])) axis = 1;
  if (!(std::abs(normal[axis]) > 0.0)) return false;

  int first = (axis + 1) % 3;
  int second = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(first, second);
  points.resize(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 p = glm::dvec3(polygon[i]) - origin;
    points[i] = Point(p[first], p[second]);
  }
  return true;
}

bool is_convex(std::span<const Point> points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0.0) return false;
  }
  return true;
}

void fan(std::uint32_t corners, std::vector<glm::uvec3>& triangles) {
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.emplace_back(0U, i, i + 1);
}

// Ear clipping on a ring of corners. Only corners that turn right can lie in an ear, so only these
// are tested; cutting an ear never makes another corner of a simple outline turn right.
class EarClipper {
 public:
  EarClipper(std::span<const Point> points, std::vector<glm::uvec3>& triangles)
      : points_(points), triangles_(triangles) {
    const auto n = static_cast<std::uint32_t>(points.size());
    previous_.resize(n);
    next_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      previous_[i] = (i + n - 1) % n;
      next_[i] = (i + 1) % n;
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      if (turn(i) < 0.0) reflex_.push_back(i);
    }
    gone_.resize(n, false);
    budget_ = kTestsPerCorner * n;
  }

  bool run() {
    auto left = static_cast<std::uint32_t>(points_.size());
    std::uint32_t at = 0;
    std::uint32_t misses = 0;
    while (left > 3) {
      if (budget_ == 0) {
        fan_rest(at, left);
        return false;
      }
      // After a whole round without an ear the outline crosses itself: cut here all the same.
      if (is_ear(at) || misses >= left) {
        cut(at);
        --left;
        misses = 0;
        // Skipping one corner spreads the cuts, so that no corner collects all the slivers.
        at = next_[next_[at]];
      } else {
        ++misses;
        at = next_[at];
      }
    }
    triangles_.emplace_back(previous_[at], at, next_[at]);
    return true;
  }

 private:
  double turn(std::uint32_t i) const {
    return cross(points_[previous_[i]], points_[i], points_[next_[i]]);
  }

  void spend() {
    if (budget_ > 0) --budget_;
    if (budget_ % 65536 == 0) check_load();
  }

  bool is_ear(std::uint32_t i) {
    spend();
    const double area = turn(i);
    if (area < 0.0) return false;
    if (area == 0.0) return true;
    for (std::size_t k = 0; k < reflex_.size();) {
      const std::uint32_t r = reflex_[k];
      spend();
      if (gone_[r] || turn(r) >= 0.0) {
        reflex_[k] = reflex_.back();
        reflex_.pop_back();
        continue;
      }
      if (r != previous_[i] && r != next_[i] && blocks(r, i)) return false;
      ++k;
    }
    return true;
  }

  // Whether corner r lies in or on the ear at i. Where r touches a corner of the ear (the doubled
  // edge to a hole), it blocks only if the outline goes on from there into the ear.
  bool blocks(std::uint32_t r, std::uint32_t i) const {
    const Point& p = points_[r];
    const Point corners[3] = {points_[previous_[i]], points_[i], points_[next_[i]]};
    for (int c = 0; c < 3; ++c) {
      if (p != corners[c]) continue;
      return enters(p, points_[next_[r]], corners[(c + 1) % 3], corners[(c + 2) % 3]) ||
             enters(p, points_[previous_[r]], corners[(c + 1) % 3], corners[(c + 2) % 3]);
    }
    return cross(corners[0], corners[1], p) >= 0.0 && cross(corners[1], corners[2], p) >= 0.0 &&
           cross(corners[2], corners[0], p) >= 0.0;
  }

  static bool enters(const Point& from, const Point& to, const Point& right, const Point& left) {
    return cross(from, right, to) > 0.0 && cross(from, to, left) > 0.0;
  }

  void cut(std::uint32_t i) {
    triangles_.emplace_back(previous_[i], i, next_[i]);
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    gone_[i] = true;
  }

  void fan_rest(std::uint32_t first, std::uint32_t left) {
    std::uint32_t b = next_[first];
    for (std::uint32_t i = 0; i + 2 < left; ++i) {
      triangles_.emplace_back(first, b, next_[b]);
      b = next_[b];
    }
  }

  std::span<const Point> points_;
  std::vector<glm::uvec3>& triangles_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> reflex_;
  std::vector<bool> gone_;
  std::uint64_t budget_ = 0;
};

}  // namespace

bool triangulate(std::span<const glm::vec3> polygon, std::vector<glm::uvec3>& triangles) {
  if (polygon.size() < 3) return true;
  const auto corners = static_cast<std::uint32_t>(polygon.size());
  if (corners == 3) {
    triangles.emplace_back(0U, 1U, 2U);
    return true;
  }
  std::vector<Point> points;
  if (!project(polygon, points) || is_convex(points)) {
    fan(corners, triangles);
    return true;
  }
  return EarClipper(points, triangles).run();
}

}  // namespace encore::scene
