#include "scene/rotation.h"

#include "scene/portable_math.h"

#include <cmath>

namespace encore::scene {

glm::dvec3 unit_or_zero(const glm::vec3& v) {
  const glm::dvec3 d(v);
  const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  if (!(length > 0.0) || !std::isfinite(length)) return glm::dvec3(0.0);
  return d / length;
}

Rotation rotation_around(const glm::vec3& axis, double degrees) {
  const glm::dvec3 a = unit_or_zero(axis);
  if (a == glm::dvec3(0.0) || !std::isfinite(degrees)) return {};
  const double s = portable_sin_degrees(degrees * 0.5);
  return {portable_cos_degrees(degrees * 0.5), a.x * s, a.y * s, a.z * s};
}

Rotation slerp(const Rotation& a, const Rotation& b, double u) {
  double dot = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
  // q and -q are the same rotation: take the one that is nearer.
  const double sign = dot < 0.0 ? -1.0 : 1.0;
  dot *= sign;
  double wa = 1.0 - u;
  double wb = u;
  // Nearly equal rotations: sin(angle) would be 0; the straight line is then exact enough.
  if (dot < 1.0 - 1e-12) {
    const double angle = portable_acos(dot);
    const double s = portable_sin(angle);
    wa = portable_sin((1.0 - u) * angle) / s;
    wb = portable_sin(u * angle) / s;
  }
  wb *= sign;
  Rotation r{wa * a.w + wb * b.w, wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z};
  const double length = std::sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
  return {r.w / length, r.x / length, r.y / length, r.z / length};
}

glm::dmat3 rotation_matrix(const Rotation& q) {
  const double xx = q.x * q.x;
  const double yy = q.y * q.y;
  const double zz = q.z * q.z;
  const double xy = q.x * q.y;
  const double xz = q.x * q.z;
  const double yz = q.y * q.z;
  const double wx = q.w * q.x;
  const double wy = q.w * q.y;
  const double wz = q.w * q.z;
  // glm stores columns.
  return {{1.0 - 2.0 * (yy + zz), 2.0 * (xy + wz), 2.0 * (xz - wy)},
          {2.0 * (xy - wz), 1.0 - 2.0 * (xx + zz), 2.0 * (yz + wx)},
          {2.0 * (xz + wy), 2.0 * (yz - wx), 1.0 - 2.0 * (xx + yy)}};
}

glm::dmat3 axis_angle_matrix(const glm::vec3& axis, double degrees) {
  const glm::dvec3 a = unit_or_zero(axis);
  if (a == glm::dvec3(0.0) || !std::isfinite(degrees)) return glm::dmat3(1.0);
  const double s = portable_sin_degrees(degrees);
  const double c = portable_cos_degrees(degrees);
  const double k = 1.0 - c;
  return {{c + k * a.x * a.x, k * a.x * a.y + s * a.z, k * a.x * a.z - s * a.y},
          {k * a.x * a.y - s * a.z, c + k * a.y * a.y, k * a.y * a.z + s * a.x},
          {k * a.x * a.z + s * a.y, k * a.y * a.z - s * a.x, c + k * a.z * a.z}};
}

}  // namespace encore::scene
