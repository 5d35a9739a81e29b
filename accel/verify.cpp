#include "accel/verify.h"

#include "accel/exact_oracle.h"

#include <cmath>
#include <cstring>

namespace encore::accel {

void HitComparison::add(const Ray& ray, const Hit& expected, const Hit& found, bool same_place) {
  const std::uint64_t before = mismatches();
  ++rays;
  if (expected.found()) ++hits;
  if (expected.found() && !found.found()) {
    ++missed;
  } else if (!expected.found() && found.found()) {
    ++invented;
  } else if (expected.triangle != found.triangle) {
    ++wrong_triangle;
  } else if (!same_place) {
    ++wrong_distance;
  }
  if (before == 0 && mismatches() > 0) {
    first_ray = ray;
    first_expected = expected;
    first_found = found;
  }
}

bool within_one_rounding(float a, float b) {
  return a == b || std::nextafter(a, b) == b;
}

namespace {

bool same_between_modes(float a, float b) {
  return a == b || std::fabs(a - b) <= kModeDistance * std::fabs(a);
}

}  // namespace

bool same_distance(float a, float b, const Ray& ray, const Triangle& triangle) {
  if (within_one_rounding(a, b)) return true;
  double coordinate = 0.0;
  double direction = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const glm::vec3& p : {ray.origin, triangle.v0, triangle.v1, triangle.v2}) {
      coordinate = std::fmax(coordinate, std::fabs(p[axis]));
    }
    direction = std::fmax(direction, std::fabs(ray.direction[axis]));
  }
  return std::fabs(double(a) - double(b)) * direction <= 0x1p-44 * coordinate;
}

HitComparison& HitComparison::operator+=(const HitComparison& other) {
  if (mismatches() == 0 && other.mismatches() > 0) {
    first_ray = other.first_ray;
    first_expected = other.first_expected;
    first_found = other.first_found;
  }
  rays += other.rays;
  hits += other.hits;
  missed += other.missed;
  invented += other.invented;
  wrong_triangle += other.wrong_triangle;
  wrong_distance += other.wrong_distance;
  wrong_occlusion += other.wrong_occlusion;
  return *this;
}

HitComparison compare_hits(const AccelerationStructure& structure,
                           const AccelerationStructure& reference, std::span<const Ray> rays) {
  std::vector<Hit> expected(rays.size());
  std::vector<Hit> found(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  reference.intersect(rays, expected);
  structure.intersect(rays, found);
  structure.occluded(rays, blocked);

  const bool one_mode = structure.intersection() == reference.intersection();
  HitComparison comparison;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool same_place = one_mode ? std::memcmp(&expected[i], &found[i], sizeof(Hit)) == 0
                                     : same_between_modes(expected[i].t, found[i].t);
    comparison.add(rays[i], expected[i], found[i], same_place);
    if ((blocked[i] != 0) != expected[i].found()) {
      if (comparison.mismatches() == 0) {
        comparison.first_ray = rays[i];
        comparison.first_expected = expected[i];
        comparison.first_found = found[i];
      }
      ++comparison.wrong_occlusion;
    }
  }
  return comparison;
}

OracleComparison compare_with_oracle(const AccelerationStructure& structure,
                                     std::span<const Triangle> triangles,
                                     std::span<const Ray> rays) {
  std::vector<Hit> found(rays.size());
  structure.intersect(rays, found);
  const bool precise = structure.intersection() == IntersectionMode::precise;
  OracleComparison comparison;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit expected = exact_nearest_hit(triangles, rays[i]);
    Hit answer = found[i];
    if (expected.triangle != answer.triangle) {
      // Which of the two triangles' edges does the ray pass, and how close?
      const std::uint32_t suspect = answer.found() && (!expected.found() || answer.t <= expected.t)
                                        ? answer.triangle
                                        : expected.triangle;
      const bool tie = answer.found() && expected.found() &&
                       (within_one_rounding(answer.t, expected.t) ||
                        (!precise && same_between_modes(expected.t, answer.t)));
      if (tie || edge_clearance(triangles[suspect], rays[i]) < 0x1p-40) {
        ++comparison.edge_cases;
        answer = expected;
      }
    }
    const bool same_place =
        !expected.found() ||
        same_distance(expected.t, answer.t, rays[i], triangles[expected.triangle]) ||
        (!precise && same_between_modes(expected.t, answer.t));
    comparison.hits.add(rays[i], expected, answer, same_place);
  }
  return comparison;
}

}  // namespace encore::accel
