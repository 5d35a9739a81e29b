#pragma once

#include "accel/settings.h"
#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstdint>
#include <span>

namespace encore::app {

/// What an answer is held to.
enum class Exactness {
  bits,    ///< the same bits: two structures in double precision on the CPU
  twice,   ///< one rounding of t, and edges passed within 2^-40: another formula or device
  single,  ///< what single precision leaves open, see single_doubt()
};

/// What single precision can tell of a ray and a triangle. Differences of coordinates are off by
/// at most 2^-23 of the largest distance `reach` between the ray's origin and a vertex (all in the
/// largest component); a barycentric weight is a ratio of areas seen from the ray, and so off by
/// about 2^-23 reach edge / area seen; both with a factor of 8 for the sums of products.
struct SingleDoubt {
  double weight = 0.0;    ///< of a barycentric weight; infinite for a triangle seen edge-on
  double distance = 0.0;  ///< of t
};
SingleDoubt single_doubt(const scene::Triangle& triangle, const scene::Ray& ray);

/// Answers against the truth, summed.
struct StabilityTally {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;             ///< of the truth
  std::uint64_t missed = 0;           ///< the truth hits, the answer does not
  std::uint64_t invented = 0;         ///< the answer hits, the truth does not
  std::uint64_t wrong_triangle = 0;   ///< both hit, different triangles
  std::uint64_t wrong_distance = 0;   ///< the same triangle, t beyond what the exactness allows
  std::uint64_t wrong_occlusion = 0;  ///< any-hit disagrees with the nearest hit
  std::uint64_t excused = 0;   ///< other answers within the exactness: not in the figures above
  double largest_error = 0.0;  ///< of t, relative, where both hit the same triangle

  [[nodiscard]] std::uint64_t wrong() const {
    return missed + invented + wrong_triangle + wrong_distance + wrong_occlusion;
  }
  /// Files one ray.
  void add(std::span<const scene::Triangle> triangles, const scene::Ray& ray,
           const scene::Hit& truth, const scene::Hit& found, Exactness exactness);
};

}  // namespace encore::app
