#pragma once

#include "accel/acceleration_structure.h"
#include "shaders/shared/tolerance.h"

#include <cstdint>
#include <span>

namespace encore::accel {

/// How a structure's hits compare with the truth, ray by ray.
struct HitComparison {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;             ///< of the reference
  std::uint64_t missed = 0;           ///< the reference hits, the structure does not
  std::uint64_t invented = 0;         ///< the structure hits, the reference does not
  std::uint64_t wrong_triangle = 0;   ///< both hit, different triangles
  std::uint64_t wrong_distance = 0;   ///< the same triangle, or none, at another t, u or v
  std::uint64_t wrong_occlusion = 0;  ///< any-hit disagrees with the nearest hit
  /// The first ray that differs, and both answers; meaningful if mismatches() > 0.
  Ray first_ray;
  Hit first_expected;
  Hit first_found;

  [[nodiscard]] std::uint64_t mismatches() const {
    return missed + invented + wrong_triangle + wrong_distance + wrong_occlusion;
  }
  /// Files one pair of answers; `same_place` says whether t, u and v agree, should both be hits of
  /// the same triangle or both misses.
  void add(const Ray& ray, const Hit& expected, const Hit& found, bool same_place);
  HitComparison& operator+=(const HitComparison& other);
};

/// Equal, or neighbours among the floats.
bool within_one_rounding(float a, float b);

/// Whether two distances along a ray to a triangle are the same to single precision, or (for a ray
/// that starts almost on the triangle) to double precision of the coordinates involved.
bool same_distance(float a, float b, const Ray& ray, const Triangle& triangle);

/// Holds `structure` to `reference`: nearest hits bit for bit, and any-hit against them. Where the
/// two have different intersection modes, distances are the same within kModeDistance and
/// barycentrics are not compared; so brute force in the precise mode is a reference for all modes.
inline constexpr float kModeDistance = 4 * ENCORE_WATERTIGHT_DISTANCE;
HitComparison compare_hits(const AccelerationStructure& structure,
                           const AccelerationStructure& reference, std::span<const Ray> rays);

/// Holds `structure` to the exact oracle over `triangles`. Distances and barycentrics may differ by
/// one rounding, distances in modes other than precise by kModeDistance; a different triangle is
/// counted as wrong unless both are hit at the same rounded distance or the ray passes an edge
/// within double rounding (`edge_cases` counts those).
struct OracleComparison {
  HitComparison hits;
  std::uint64_t edge_cases = 0;
};
OracleComparison compare_with_oracle(const AccelerationStructure& structure,
                                     std::span<const Triangle> triangles,
                                     std::span<const Ray> rays);

}  // namespace encore::accel
