#pragma once

#include "scene/portable_math.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cmath>

/// Vector helpers of the sample scenes. They are spelled out here instead of taken from GLM so that
/// the order of every rounding is ours: the scenes must be the same bit for bit everywhere.
namespace encore::scene::samples {

using Vec = glm::dvec3;

inline constexpr Vec kX(1.0, 0.0, 0.0);
inline constexpr Vec kY(0.0, 1.0, 0.0);
inline constexpr Vec kZ(0.0, 0.0, 1.0);

inline double dot(const Vec& a, const Vec& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(const Vec& a) {
  return std::sqrt(dot(a, a));
}

/// The zero vector stays zero.
inline Vec normalize(const Vec& a) {
  const double l = length(a);
  return l > 0.0 ? Vec(a.x / l, a.y / l, a.z / l) : a;
}

inline double mix(double a, double b, double t) {
  return a + (b - a) * t;
}
inline Vec mix(const Vec& a, const Vec& b, double t) {
  return a + (b - a) * t;
}

inline double clamp(double x, double low, double high) {
  return x < low ? low : (x > high ? high : x);
}

/// 0 below `low`, 1 above `high`, a smooth cubic between them.
inline double smoothstep(double low, double high, double x) {
  const double t = clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// `v` turned around the unit vector `axis` by `degrees`, right-handed.
inline Vec rotate(const Vec& v, const Vec& axis, double degrees) {
  const double c = portable_cos_degrees(degrees);
  const double s = portable_sin_degrees(degrees);
  return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1.0 - c));
}

/// A right-handed orthonormal frame with an origin, to place and orient shapes.
struct Frame {
  Vec origin{0.0};
  Vec x{1.0, 0.0, 0.0};
  Vec y{0.0, 1.0, 0.0};
  Vec z{0.0, 0.0, 1.0};

  /// Coordinates of the point `p` in this frame.
  [[nodiscard]] Vec local(const Vec& p) const {
    const Vec d = p - origin;
    return {dot(d, x), dot(d, y), dot(d, z)};
  }
  /// The point with local coordinates `p`.
  [[nodiscard]] Vec world(const Vec& p) const { return origin + x * p.x + y * p.y + z * p.z; }
  /// This frame turned around its own origin.
  [[nodiscard]] Frame turned(const Vec& axis, double degrees) const {
    return {origin, rotate(x, axis, degrees), rotate(y, axis, degrees), rotate(z, axis, degrees)};
  }
};

/// The frame at `origin` whose y axis is `up`; x and z are chosen perpendicular to it.
inline Frame frame_along(const Vec& origin, const Vec& up) {
  const Vec y = normalize(up);
  const Vec helper = std::abs(y.x) < 0.9 ? Vec(1.0, 0.0, 0.0) : Vec(0.0, 0.0, 1.0);
  const Vec z = normalize(cross(helper, y));
  return {origin, cross(y, z), y, z};
}

/// The matrix of scaling uniformly, then turning into `frame`.
inline glm::mat4 matrix_of(const Frame& frame, double scale = 1.0) {
  const auto column = [](const Vec& v, float w) {
    return glm::vec4(float(v.x), float(v.y), float(v.z), w);
  };
  return {column(frame.x * scale, 0.0F), column(frame.y * scale, 0.0F),
          column(frame.z * scale, 0.0F), column(frame.origin, 1.0F)};
}

}  // namespace encore::scene::samples
