#include "accel/triangle_hit.h"

#include "accel/box_hit.h"
#include "shaders/shared/tolerance.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

namespace encore::accel {

namespace {

using glm::dvec2;
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

/// Makes the ray the z axis: where a point relative to its origin lies beside it.
class Shear {
 public:
  explicit Shear(const dvec3& direction) {
    const dvec3 size{std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)};
    kz_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    kx_ = kz_ == 2 ? 0 : kz_ + 1;
    ky_ = kx_ == 2 ? 0 : kx_ + 1;
    x_ = direction[kx_] / direction[kz_];
    y_ = direction[ky_] / direction[kz_];
  }
  dvec2 operator()(const dvec3& p) const { return {p[kx_] - x_ * p[kz_], p[ky_] - y_ * p[kz_]}; }

 private:
  int kx_, ky_, kz_;
  double x_, y_;
};

/// What rounding took from a product, exactly (Dekker 1971).
double rest_of_product(double a, double b, double product) {
  constexpr double kSplit = 0x1p27 + 1;
  const double a_scaled = kSplit * a;
  const double b_scaled = kSplit * b;
  const double a_high = a_scaled - (a_scaled - a);
  const double b_high = b_scaled - (b_scaled - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  return a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/// On which side of the edge from p to q the ray passes. The sign is exact for these p and q:
/// rounding keeps the order of two products unless it makes them equal.
double edge_function(const dvec2& p, const dvec2& q) {
  const double forward = p.x * q.y;
  const double backward = p.y * q.x;
  if (forward != backward) return forward - backward;
  return rest_of_product(p.x, q.y, forward) - rest_of_product(p.y, q.x, backward);
}

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
  const dvec3 v0(triangle.v0);
  const dvec3 v1(triangle.v1);
  const dvec3 v2(triangle.v2);
  const dvec3 origin(ray.origin);
  const dvec3 direction(ray.direction);
  const dvec3 a = v0 - origin;
  // The unnormalised barycentric weights of the vertices.
  const Shear shear(direction);
  const dvec2 sheared_a = shear(a);
  const dvec2 sheared_b = shear(v1 - origin);
  const dvec2 sheared_c = shear(v2 - origin);
  const double weight_a = edge_function(sheared_c, sheared_b);
  const double weight_b = edge_function(sheared_a, sheared_c);
  const double weight_c = edge_function(sheared_b, sheared_a);

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
