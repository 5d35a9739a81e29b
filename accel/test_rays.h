#pragma once

#include "accel/acceleration_structure.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace encore::accel {

/// The kinds of rays that a structure must answer right, each a way to go wrong.
enum class RayKind {
  outside,  ///< from a sphere around the scene, aimed at points inside it
  inside,   ///< from random points inside the scene's box, in random directions
  far,      ///< from a million scene sizes away
  axis,     ///< along an axis, the other components +0 or -0
  plane,    ///< exactly inside, or starting on, the structure's own cell, split and box planes
  surface,  ///< starting on a triangle
  edge,     ///< aimed exactly at vertices and at points of edges
  limited,  ///< with t_min and t_max that cut hits off
};
std::string_view to_string(RayKind kind);
std::span<const RayKind> all_ray_kinds();

/// `count` seeded rays of a kind for these triangles; `structure` gives the planes of
/// RayKind::plane. Empty if there are no triangles. The same on every machine.
std::vector<Ray> test_rays(RayKind kind, std::size_t count, std::uint64_t seed,
                           std::span<const Triangle> triangles,
                           const AccelerationStructure& structure);

}  // namespace encore::accel
