#include "accel/exact_oracle.h"

#include "accel/box_hit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace encore::accel {

namespace {

#if defined(__SIZEOF_FLOAT128__)
__extension__ using Real = __float128;
#else
using Real = long double;
#endif

struct Vec {
  Real x, y, z;
};
Vec widen(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}
Vec operator-(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Real dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Where the ray's line meets the triangle's plane, and the barycentric weights of that point.
struct Crossing {
  bool exists = false;
  Real t = 0, u = 0, v = 0;
};

Crossing cross_plane(const scene::Triangle& triangle, const scene::Ray& ray) {
  const Vec v0 = widen(triangle.v0);
  const Vec edge1 = widen(triangle.v1) - v0;
  const Vec edge2 = widen(triangle.v2) - v0;
  const Vec normal = cross(edge1, edge2);
  const Vec direction = widen(ray.direction);
  const Real slope = dot(normal, direction);
  const Real area = dot(normal, normal);
  if (slope == 0 || area == 0) return {};
  const Vec origin = widen(ray.origin);
  const Real t = dot(normal, v0 - origin) / slope;
  // The point relative to v0, and its areas against the two edges.
  const Vec p{origin.x + t * direction.x - v0.x, origin.y + t * direction.y - v0.y,
              origin.z + t * direction.z - v0.z};
  return {true, t, dot(normal, cross(p, edge2)) / area, dot(normal, cross(edge1, p)) / area};
}

}  // namespace

scene::Hit exact_nearest_hit(std::span<const scene::Triangle> triangles, const scene::Ray& ray) {
  scene::Hit best{.t = ray.t_max};
  const BoxRay box_ray(ray);
  for (std::uint32_t index = 0; index < triangles.size(); ++index) {
    // The conservative box test only saves time.
    const scene::Bounds bounds = scene::bounds_of(triangles[index]);
    if (!box_stretch(bounds.min, bounds.max, box_ray, ray.t_min, best.t).hit()) continue;

    const Crossing c = cross_plane(triangles[index], ray);
    if (!c.exists || c.u < 0 || c.v < 0 || c.u + c.v > 1) continue;
    const auto t = static_cast<float>(c.t);
    if (!(t > ray.t_min) || !(t <= std::numeric_limits<float>::max())) continue;
    if (t < best.t || (t == best.t && index < best.triangle)) {
      best = {t, index, static_cast<float>(c.u), static_cast<float>(c.v)};
    }
  }
  return best;
}

double edge_clearance(const scene::Triangle& triangle, const scene::Ray& ray) {
  const Crossing c = cross_plane(triangle, ray);
  if (!c.exists) return 0.0;
  const double u = static_cast<double>(c.u);
  const double v = static_cast<double>(c.v);
  return std::fabs(std::min({u, v, 1.0 - u - v}));
}

}  // namespace encore::accel
