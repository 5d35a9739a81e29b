#pragma once

#include "accel/triangle_hit.h"
#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstdint>

namespace encore::accel::ENCORE_ISA {

/// decide_hit()'s distance (accel/triangle_hit.h) of a triangle that the ray is known to hit,
/// operation for operation; not `known` where only it can tell.
struct ExactDistance {
  float t;
  bool known;
};
[[gnu::always_inline]] inline ExactDistance exact_distance(const scene::Ray& ray,
                                                           const scene::Triangle& triangle) {
  struct Vector {
    double x, y, z;
  };
  const auto vector = [](const glm::vec3& v) {
    const float* const p = &v.x;
    return Vector{p[0], p[1], p[2]};
  };
  const auto minus = [](const Vector& a, const Vector& b) {
    return Vector{a.x - b.x, a.y - b.y, a.z - b.z};
  };
  const auto dot = [](const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  };
  const auto largest = [](const Vector& a) {
    const double x = __builtin_fabs(a.x), y = __builtin_fabs(a.y), z = __builtin_fabs(a.z);
    const double more = y > z ? y : z;
    return x > more ? x : more;
  };
  const Vector v0 = vector(triangle.v0), direction = vector(ray.direction);
  const Vector e1 = minus(vector(triangle.v1), v0), e2 = minus(vector(triangle.v2), v0);
  const Vector normal{e1.y * e2.z - e2.y * e1.z, e1.z * e2.x - e2.z * e1.x,
                      e1.x * e2.y - e2.x * e1.y};
  const double slope = dot(direction, normal);
  const auto t = static_cast<float>(dot(minus(v0, vector(ray.origin)), normal) / slope);
  // Steepness below twice the limit takes the box.
  const bool known =
      (__builtin_fabs(slope) > 0x1p-19 * (largest(direction) * largest(e1) * largest(e2))) &
      (t > ray.t_min) & (t < ray.t_max);
  return {t, known};
}

/// Which of two triangles that the ray is known to hit decide_hit() prefers.
enum class Preferred { first, second, unknown };
[[gnu::noinline]] inline Preferred exactly_preferred(const scene::Ray& ray,
                                                     const scene::Triangle* triangles,
                                                     std::uint32_t first, std::uint32_t second) {
  const ExactDistance a = exact_distance(ray, triangles[first]);
  const ExactDistance b = exact_distance(ray, triangles[second]);
  if (!a.known || !b.known) return Preferred::unknown;
  const bool nearer = a.t < b.t || (a.t == b.t && first < second);
  return nearer ? Preferred::first : Preferred::second;
}

/// decide_hit() for a triangle that the ray is known to hit, operation for operation, without what
/// only doubts need. False where it has to be asked itself.
[[gnu::always_inline]] inline bool exact_hit(const scene::Ray& ray, const scene::Triangle& triangle,
                                             std::uint32_t index, scene::Hit& hit) {
  const float* const to = &ray.direction.x;
  const float* const from = &ray.origin.x;
  const float* const p0 = &triangle.v0.x;
  const float* const p1 = &triangle.v1.x;
  const float* const p2 = &triangle.v2.x;

  const float sx = __builtin_fabsf(to[0]), sy = __builtin_fabsf(to[1]), sz = __builtin_fabsf(to[2]);
  const int kz = sx > sy ? (sx > sz ? 0 : 2) : (sy > sz ? 1 : 2);
  const int kx = kz == 2 ? 0 : kz + 1;
  const int ky = kx == 2 ? 0 : kx + 1;
  const double shear_x = double{to[kx]} / double{to[kz]};
  const double shear_y = double{to[ky]} / double{to[kz]};
  struct Sheared {
    double x, y;
  };
  const auto shear = [&](const float* p) {
    const double z = double{p[kz]} - double{from[kz]};
    return Sheared{double{p[kx]} - double{from[kx]} - shear_x * z,
                   double{p[ky]} - double{from[ky]} - shear_y * z};
  };
  const Sheared a = shear(p0), b = shear(p1), c = shear(p2);
  const auto edge = [](const Sheared& p, const Sheared& q) { return p.x * q.y - p.y * q.x; };
  const double weight_a = edge(c, b), weight_b = edge(a, c), weight_c = edge(b, a);

  const ExactDistance distance = exact_distance(ray, triangle);
  // Edge functions of exactly 0 take more precision.
  const bool plain = distance.known & (weight_a != 0.0) & (weight_b != 0.0) & (weight_c != 0.0) &
                     ((weight_a > 0.0) == (weight_b > 0.0)) &
                     ((weight_a > 0.0) == (weight_c > 0.0));
  const double inverse_sum = 1.0 / (weight_a + weight_b + weight_c);
  hit.t = distance.t;
  hit.triangle = index;
  hit.u = static_cast<float>(weight_b * inverse_sum);
  hit.v = static_cast<float>(weight_c * inverse_sum);
  return plain;
}

}  // namespace encore::accel::ENCORE_ISA
