#pragma once

#include "accel/brute_force.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <ios>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace encore::test {

/// In hexadecimal floating point, so that a failure can be repeated to the bit.
inline std::string describe(const scene::Ray& ray) {
  std::ostringstream out;
  out << std::hexfloat << "origin " << ray.origin.x << ' ' << ray.origin.y << ' ' << ray.origin.z
      << " direction " << ray.direction.x << ' ' << ray.direction.y << ' ' << ray.direction.z
      << " in " << ray.t_min << ".." << ray.t_max;
  return out.str();
}

/// Expects the hits of brute force, bit for bit, of all three ways to trace a ray: plain, counted
/// and any-hit. `what` stands before the first three failures. Returns the number of hits.
inline std::size_t expect_oracle_hits(const accel::AccelerationStructure& structure,
                                      std::span<const scene::Triangle> triangles,
                                      std::span<const scene::Ray> rays, const std::string& what) {
  accel::BruteForce brute;
  brute.build(triangles);
  std::vector<scene::Hit> expected(rays.size());
  std::vector<scene::Hit> found(rays.size());
  std::vector<scene::Hit> counted(rays.size());
  std::vector<accel::TraceCounters> counters(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  brute.intersect(rays, expected);
  structure.intersect(rays, found);
  structure.intersect_counted(rays, counted, counters);
  structure.occluded(rays, blocked);

  std::size_t hits = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits += expected[i].found() ? 1 : 0;
    const bool same = std::memcmp(&expected[i], &found[i], sizeof(scene::Hit)) == 0 &&
                      std::memcmp(&expected[i], &counted[i], sizeof(scene::Hit)) == 0 &&
                      (blocked[i] != 0) == expected[i].found();
    if (same || ++wrong > 3) continue;
    ADD_FAILURE() << what << ": " << describe(rays[i]) << " expected " << expected[i].triangle
                  << " at " << expected[i].t << ", found " << found[i].triangle << " at "
                  << found[i].t << ", counted " << counted[i].triangle << ", blocked "
                  << int{blocked[i]};
  }
  EXPECT_EQ(wrong, 0U) << what << ", of " << rays.size();
  return hits;
}

}  // namespace encore::test
