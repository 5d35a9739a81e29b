#include "app/stability_tally.h"

#include "accel/exact_oracle.h"
#include "accel/verify.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace encore::app {

namespace {

using scene::Hit;
using scene::Ray;
using scene::Triangle;

constexpr double kSlack = 0x1p-20;       // 8 * 2^-23
constexpr double kDoubleEdge = 0x1p-40;  // as in accel/verify.cpp

double largest(const glm::dvec3& v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

bool same_distance(const Hit& truth, const Hit& found, const Ray& ray, const Triangle& triangle,
                   Exactness exactness) {
  switch (exactness) {
    case Exactness::bits:
      return std::memcmp(&truth, &found, sizeof(Hit)) == 0;
    case Exactness::twice:
      return accel::same_distance(truth.t, found.t, ray, triangle);
    case Exactness::single:
      break;
  }
  const double apart = std::fabs(double(truth.t) - double(found.t));
  return apart <= single_doubt(triangle, ray).distance;
}

/// Whether two different answers are what rounding makes of a tie or of an edge.
bool excusable(std::span<const Triangle> triangles, const Ray& ray, const Hit& truth,
               const Hit& found, Exactness exactness) {
  if (exactness == Exactness::bits) return false;
  if (found.found() && found.triangle >= triangles.size()) return false;
  const bool both = truth.found() && found.found();
  if (both && exactness == Exactness::twice && accel::within_one_rounding(truth.t, found.t)) {
    return true;
  }
  if (both && exactness == Exactness::single) {
    const double doubt = single_doubt(triangles[truth.triangle], ray).distance +
                         single_doubt(triangles[found.triangle], ray).distance;
    if (std::fabs(double(truth.t) - double(found.t)) <= doubt) return true;
  }
  const bool found_nearer = found.found() && (!truth.found() || found.t <= truth.t);
  const Triangle& suspect = triangles[found_nearer ? found.triangle : truth.triangle];
  const double open =
      exactness == Exactness::twice ? kDoubleEdge : single_doubt(suspect, ray).weight;
  // A ray that ends or begins at the triangle, but for rounding, is as open.
  const double t = found_nearer ? found.t : truth.t;
  const double doubt = single_doubt(suspect, ray).distance;
  const bool at_an_end =
      exactness == Exactness::single &&
      (std::fabs(t - double(ray.t_min)) <= doubt || std::fabs(t - double(ray.t_max)) <= doubt);
  return at_an_end || !(accel::edge_clearance(suspect, ray) > open);
}

}  // namespace

SingleDoubt single_doubt(const Triangle& triangle, const Ray& ray) {
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 a = glm::dvec3(triangle.v0) - origin;
  const glm::dvec3 b = glm::dvec3(triangle.v1) - origin;
  const glm::dvec3 c = glm::dvec3(triangle.v2) - origin;
  const double reach = std::max({largest(a), largest(b), largest(c)});
  const double edge = std::max({largest(b - a), largest(c - a), largest(c - b)});
  const double speed = largest(glm::dvec3(ray.direction));
  const glm::dvec3 along = glm::dvec3(ray.direction) / speed;
  // Divided by the edge first: products of huge or tiny coordinates leave even double's range.
  const double seen =
      edge > 0.0 ? std::fabs(glm::dot(glm::cross((b - a) / edge, (c - a) / edge), along)) : 0.0;
  if (!(seen > 0.0) || !std::isfinite(reach)) {
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  const double ratio = reach / edge / seen;
  return {kSlack * ratio, kSlack * reach * (1.0 + 1.0 / seen) / speed};
}

void StabilityTally::add(std::span<const Triangle> triangles, const Ray& ray, const Hit& truth,
                         const Hit& found, Exactness exactness) {
  ++rays;
  if (truth.found()) ++hits;
  if (!truth.found() && !found.found()) return;
  if (truth.triangle == found.triangle) {
    const double apart = std::fabs(double(truth.t) - double(found.t));
    if (apart > 0.0) largest_error = std::max(largest_error, apart / std::fabs(double(truth.t)));
    if (!same_distance(truth, found, ray, triangles[truth.triangle], exactness)) ++wrong_distance;
    return;
  }
  if (excusable(triangles, ray, truth, found, exactness)) {
    ++excused;
  } else if (!found.found()) {
    ++missed;
  } else if (!truth.found()) {
    ++invented;
  } else {
    ++wrong_triangle;
  }
}

}  // namespace encore::app
