#pragma once

#include "scene/triangle.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace encore::accel::stability {

using scene::Triangle;
using Triangles = std::vector<Triangle>;

/// Seeded numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1), a multiple of 2^-24.
  float unit() { return static_cast<float>(engine_() >> 40) * 0x1p-24F; }
  float between(float low, float high) { return low + (high - low) * unit(); }
  /// In the cube [-half, half)^3.
  glm::vec3 point(float half);

 private:
  std::mt19937_64 engine_;
};

// Shapes that structures stumble over, of about `count` triangles (exactly so many, but for the
// ball) and of the order of 1 in size, seeded and the same on every machine.

/// A closed ball of radius 1 around `centre`: an octahedron whose faces are divided and blown up.
/// Neighbours share their vertices bit for bit. 8 n^2 triangles, the most that are within `count`.
Triangles ball(std::size_t count, const glm::vec3& centre, float radius);
/// Small triangles at random places.
Triangles soup(std::size_t count, std::uint64_t seed);
/// Every triangle as large as the scene.
Triangles spanning(std::size_t count, std::uint64_t seed);
/// Needles 10^8 times as long as wide, in all directions.
Triangles needles(std::size_t count, std::uint64_t seed);
/// Needles from one corner of the scene to the other: the boxes of all touch every cell.
Triangles corner_to_corner(std::size_t count, std::uint64_t seed);
/// A third are points, a third are lines, the rest are ordinary.
Triangles without_area(std::size_t count, std::uint64_t seed);
/// One triangle again and again, and one behind it.
Triangles repeated(std::size_t count);
/// Triangles of all sizes and directions around the same centroid.
Triangles same_centroid(std::size_t count, std::uint64_t seed);
/// Triangles in the plane y = 0, overlapping: all planes, boxes and costs of one axis are equal.
Triangles coplanar(std::size_t count, std::uint64_t seed);
/// Small triangles in a row along the main diagonal.
Triangles diagonal(std::size_t count, std::uint64_t seed);
/// A dense ball in a hall 10^6 times as large.
Triangles ball_in_hall(std::size_t count);
/// Squares of two triangles on a lattice of powers of two, in all three directions, so that the
/// structures' planes run through their edges.
Triangles lattice(std::size_t count);
/// Triangle k begins where the median falls once those before it are gone: a split at the median
/// takes away one triangle at a time.
Triangles one_a_level(std::size_t count);

}  // namespace encore::accel::stability
