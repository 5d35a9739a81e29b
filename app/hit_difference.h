#pragma once

#include "scene/ray.h"
#include "scene/triangle.h"

#include <optional>
#include <span>
#include <string_view>

namespace encore::app {

/// Why two right devices may answer the same ray differently.
enum class Explanation {
  none,      ///< one of the two is wrong
  rounding,  ///< the same triangle; t, u and v off by one rounding
  tie,       ///< two triangles at the same distance, but for one rounding
  edge,      ///< the ray passes an edge within the rounding of double precision
};
std::string_view to_string(Explanation explanation);

/// What is known of a ray whose two answers differ.
struct HitDifference {
  Explanation explanation = Explanation::none;
  scene::Hit oracle;  ///< accel::exact_nearest_hit()
  /// accel::edge_clearance() of the nearer of the two triangles; none if neither answer names a
  /// triangle that exists.
  std::optional<double> clearance;
};

/// Looks into one ray to which the reference answered `expected` and a device `found`. The
/// reference is trusted. The device must have given an answer that rounding can give: a triangle
/// that the ray truly hits or whose edge it passes within 2^-40 of the triangle's size, at its true
/// distance, with nothing overlooked before it but an edge that no second triangle shares there
/// (a device that slips through between two neighbours is wrong). Slow: every triangle is tested.
HitDifference explain_difference(std::span<const scene::Triangle> triangles, const scene::Ray& ray,
                                 const scene::Hit& expected, const scene::Hit& found);

}  // namespace encore::app
