#pragma once

#include "tests/bvh/test_scenes.h"

namespace encore::accel::test {

/// Every vertex moved by up to `distance` along each axis.
inline Triangles moved(Triangles triangles, float distance, std::uint32_t seed) {
  Random random(seed);
  for (Triangle& t : triangles) {
    for (vec3* vertex : {&t.v0, &t.v1, &t.v2}) *vertex += random.point(distance);
  }
  return triangles;
}

/// Frames in each of which one triangle alone, the first, the middle or the last, is not as it was.
inline std::vector<Triangles> one_moved_each(const Triangles& start) {
  std::vector<Triangles> frames;
  for (const std::size_t which : {std::size_t{0}, start.size() / 2, start.size() - 1}) {
    frames.push_back(start);
    frames.back()[which].v1 *= 1.5F;
  }
  return frames;
}

}  // namespace encore::accel::test
