#pragma once

#include <cstdint>

namespace encore::accel {

/// Nodes of bvh-median at this depth and below are split into halves by number, whatever their
/// triangles look like.
inline constexpr std::uint32_t kBvhMostSpatialDepth = 216;
/// No node lies deeper. Spatial medians alone give no such bound: a triangle goes by its lower end,
/// so a row of long ones that begin just below the middle loses one triangle a level. Halves of
/// less than 2^32 triangles are single ones after at most 32 levels.
inline constexpr std::uint32_t kBvhMostDepth = kBvhMostSpatialDepth + 32;

}  // namespace encore::accel
