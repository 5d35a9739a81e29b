#include "accel/triangle_hit.h"

#include "accel/box_hit.h"
#include "shaders/shared/tolerance.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

namespace encore::accel {

namespace {

using glm::dvec3;

double largest(const dvec3& v) {
  return std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
}

// The plane's normal and the slope of the ray against it are off by a few units of 2^-53 times the
// product of the factors' largest components; below this multiple not even the sign is known.
constexpr double kSlopeRounding = ENCORE_SLOPE_ROUNDING;
// Above this multiple the distance is exact to far below single precision.
constexpr double kSlopeSafe = ENCORE_SLOPE_SAFE;
static_assert(kSlopeRounding == 0x1p-48 && kSlopeSafe == 0x1p-20);

/// Keeps the distance of a triangle that is almost degenerate or edge-on inside its own box's
/// stretch of the ray, so that structures, which only know boxes and planes, find it where it is.
/// False if the ray misses the box.
bool confine_to_box(const scene::Ray& ray, const scene::Triangle& triangle, float& t) {
  const scene::Bounds bounds = scene::bounds_of(triangle);
  const BoxStretch stretch =
      box_stretch(bounds.min, bounds.max, BoxRay(ray), 0.0F, std::numeric_limits<float>::max());
  if (!stretch.hit()) return false;
  t = std::fmax(stretch.enter, std::fmin(t, stretch.leave));
  return true;
}

}  // namespace

bool decide_hit(const scene::Ray& ray, const scene::Triangle& triangle, std::uint32_t index,
                scene::Hit& best) {
  // Vertices relative to the origin, and the (doubled) signed volumes that the ray's line spans
  // with each edge: the unnormalised barycentric weights of the opposite vertices. P x Q is taken
  // as (P - Q) x (P + Q) / 2, which keeps its precision when the origin is far away: the edge is
  // small and exact, where P and Q would cancel.
  const dvec3 v0(triangle.v0);
  const dvec3 v1(triangle.v1);
  const dvec3 v2(triangle.v2);
  const dvec3 origin(ray.origin);
  const dvec3 direction(ray.direction);
  const dvec3 a = v0 - origin;
  const dvec3 b = v1 - origin;
  const dvec3 c = v2 - origin;
  const double weight_a = glm::dot(direction, glm::cross(v2 - v1, c + b));
  const double weight_b = glm::dot(direction, glm::cross(v0 - v2, a + c));
  const double weight_c = glm::dot(direction, glm::cross(v1 - v0, b + a));

  // Inside if no two of them disagree in sign.
  const bool any_negative = weight_a < 0 || weight_b < 0 || weight_c < 0;
  const bool any_positive = weight_a > 0 || weight_b > 0 || weight_c > 0;
  if (any_negative == any_positive) return false;

  // The plane, from edges taken between the exact vertices: its precision does not depend on how
  // far away the origin is.
  const dvec3 edge1 = v1 - v0;
  const dvec3 edge2 = v2 - v0;
  const dvec3 normal = glm::cross(edge1, edge2);
  const double slope = glm::dot(direction, normal);
  const double steepness =
      std::fabs(slope) / (largest(direction) * largest(edge1) * largest(edge2));
  if (!(steepness > kSlopeRounding)) return false;

  auto t = static_cast<float>(glm::dot(a, normal) / slope);
  if (steepness < kSlopeSafe && !confine_to_box(ray, triangle, t)) return false;
  if (!(t > ray.t_min) || !(t <= std::numeric_limits<float>::max())) return false;
  if (!(t < best.t || (t == best.t && index < best.triangle))) return false;

  const double inverse_sum = 1.0 / (weight_a + weight_b + weight_c);
  best.t = t;
  best.triangle = index;
  best.u = static_cast<float>(weight_b * inverse_sum);
  best.v = static_cast<float>(weight_c * inverse_sum);
  return true;
}

}  // namespace encore::accel
