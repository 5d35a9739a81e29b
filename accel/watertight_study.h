#pragma once

#include "accel/acceleration_structure.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::accel {

/// A closed mesh and a ball inside it, to shoot rays at its edges and vertices from both sides.
struct WatertightCase {
  std::string name;
  std::vector<Triangle> triangles;
  glm::vec3 center{0.0F};
  float clearance = 0.0F;  ///< radius of a ball around `center` that lies strictly inside
  float radius = 0.0F;     ///< of one around `center` that contains everything
};

/// Whether every edge of the triangles is shared by exactly two of them that run along it in
/// opposite directions, between vertices that are equal bit for bit.
bool is_closed(std::span<const Triangle> triangles);

/// A case over a closed mesh that is seen whole from `center`; nothing if it is not closed or
/// `center` is not strictly inside it.
std::optional<WatertightCase> make_watertight_case(std::string name,
                                                   std::span<const Triangle> triangles,
                                                   const glm::vec3& center);

/// The cases of the suite: a sphere, a box, a sphere with bumps, one pulled to needles, one that
/// lies far away from the origin of all coordinates. The same on every machine.
std::vector<WatertightCase> watertight_cases();

/// What became of the rays of one case.
struct WatertightCounts {
  std::uint64_t rays = 0;
  std::uint64_t from_inside = 0;      ///< of them
  std::uint64_t hits = 0;             ///< of all rays
  std::uint64_t missed = 0;           ///< a hit is certain, none was found
  std::uint64_t invented = 0;         ///< the triangle found is not hit, or not there
  std::uint64_t wrong_occlusion = 0;  ///< any-hit disagrees with the nearest hit
  /// Triangle tests of a sample of the rays, and how many of them single precision leaves to double
  /// precision in the watertight mode, whatever the structure's own mode is.
  std::uint64_t sampled_tests = 0;
  std::uint64_t sampled_doubts = 0;
  Ray first_wrong;  ///< meaningful if wrong() > 0

  [[nodiscard]] std::uint64_t wrong() const { return missed + invented + wrong_occlusion; }
  [[nodiscard]] std::optional<double> doubt_share() const {
    if (sampled_tests == 0) return std::nullopt;
    return static_cast<double>(sampled_doubts) / static_cast<double>(sampled_tests);
  }
  WatertightCounts& operator+=(const WatertightCounts& other);
};

/// Shoots `rays` seeded rays, every other one from the ball inside, each aimed as exactly as single
/// precision can at a vertex or a point of an edge. `structure` must be built over the case's
/// triangles; its intersection mode is what is tested.
///
/// Brute force would take too long for many rays, so the truth comes from what is known anyway: a
/// ray from inside a closed mesh hits it. One from outside hits it if decide_hit() accepts one of
/// the triangles around the vertex or edge that it is aimed at. A hit is invented unless
/// decide_hit() accepts the triangle found, within 2^-14 of the distance found.
///
/// Takes one thread; a study over many shares the rays out under different seeds and adds up.
WatertightCounts run_watertight_case(const AccelerationStructure& structure,
                                     const WatertightCase& mesh, std::uint64_t rays,
                                     std::uint64_t seed);

}  // namespace encore::accel
