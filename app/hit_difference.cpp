#include "app/hit_difference.h"

#include "accel/exact_oracle.h"
#include "accel/verify.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace encore::app {

namespace {

using scene::Hit;
using scene::Ray;
using scene::Triangle;

// Double precision leaves about 2^-50 of a weight uncertain where the vertices are well apart; the
// oracle's comparison grants the same (accel/verify.cpp).
constexpr double kEdge = 0x1p-40;

bool same_weight(float a, float b) {
  return accel::within_one_rounding(a, b) || std::fabs(double(a) - double(b)) < kEdge;
}

bool same_place(const Hit& a, const Hit& b, const Ray& ray, const Triangle& triangle) {
  return accel::same_distance(a.t, b.t, ray, triangle) && same_weight(a.u, b.u) &&
         same_weight(a.v, b.v);
}

/// Where the ray meets the triangle's plane; NaN or infinite if it runs in it.
float plane_distance(const Triangle& triangle, const Ray& ray) {
  const glm::dvec3 corner(triangle.v0);
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(triangle.v1) - corner, glm::dvec3(triangle.v2) - corner);
  return static_cast<float>(glm::dot(normal, corner - glm::dvec3(ray.origin)) /
                            glm::dot(normal, glm::dvec3(ray.direction)));
}

/// Whether the ray really meets that triangle there, or passes its edge within rounding.
bool admissible(const Hit& hit, const Triangle& triangle, const Ray& ray) {
  const Hit exact = accel::exact_nearest_hit({&triangle, 1}, ray);
  if (exact.found() && same_place(exact, hit, ray, triangle)) return true;
  if (!(accel::edge_clearance(triangle, ray) < kEdge)) return false;
  // The oracle does not say where that would be.
  return hit.t > ray.t_min && hit.t <= ray.t_max &&
         accel::same_distance(plane_distance(triangle, ray), hit.t, ray, triangle);
}

/// Whether the ray hits another triangle where it passes this one's edge.
bool shared_edge(std::span<const Triangle> triangles, const Ray& ray, const Hit& hit) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Ray near = ray;
  near.t_min = std::nextafter(std::nextafter(hit.t, -kInfinity), -kInfinity);
  near.t_max = std::nextafter(hit.t, kInfinity);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (i == hit.triangle) continue;
    if (accel::exact_nearest_hit(triangles.subspan(i, 1), near).found()) return true;
  }
  return false;
}

/// Whether `found` is what lies behind a hit that a device may overlook.
bool right_behind(std::span<const Triangle> triangles, const Ray& ray, const Hit& overlooked,
                  const Hit& found) {
  if (shared_edge(triangles, ray, overlooked)) return false;
  Ray rest = ray;
  rest.t_min = overlooked.t;
  const Hit next = accel::exact_nearest_hit(triangles, rest);
  if (!found.found() || !next.found()) return found.found() == next.found();
  const Triangle& triangle = triangles[found.triangle];
  return accel::same_distance(next.t, found.t, ray, triangle) && admissible(found, triangle, ray);
}

Explanation explain(std::span<const Triangle> triangles, const Ray& ray, const Hit& expected,
                    const Hit& found, double clearance) {
  if (expected.triangle == found.triangle) {
    const bool same = same_place(expected, found, ray, triangles[found.triangle]);
    return same ? Explanation::rounding : Explanation::none;
  }
  const bool real = found.found() && admissible(found, triangles[found.triangle], ray);
  if (found.found() && !real) return Explanation::none;
  if (real && expected.found() && accel::within_one_rounding(found.t, expected.t)) {
    return Explanation::tie;
  }
  if (!(clearance < kEdge)) return Explanation::none;
  // One of the two saw an edge, the other did not.
  if (real && (!expected.found() || found.t < expected.t)) return Explanation::edge;
  return right_behind(triangles, ray, expected, found) ? Explanation::edge : Explanation::none;
}

}  // namespace

std::string_view to_string(Explanation explanation) {
  switch (explanation) {
    case Explanation::none:
      return "unexplained";
    case Explanation::rounding:
      return "one rounding apart";
    case Explanation::tie:
      return "a tie";
    case Explanation::edge:
      return "an edge passed within rounding";
  }
  return {};
}

HitDifference explain_difference(std::span<const Triangle> triangles, const Ray& ray,
                                 const Hit& expected, const Hit& found) {
  HitDifference result;
  result.oracle = accel::exact_nearest_hit(triangles, ray);
  const bool exists = found.triangle < triangles.size();
  if (!expected.found() && !exists) return result;
  const bool found_nearer = exists && (!expected.found() || found.t <= expected.t);
  result.clearance =
      accel::edge_clearance(triangles[found_nearer ? found.triangle : expected.triangle], ray);
  if (exists || !found.found()) {
    result.explanation = explain(triangles, ray, expected, found, *result.clearance);
  }
  return result;
}

}  // namespace encore::app
