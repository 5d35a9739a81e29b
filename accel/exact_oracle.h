#pragma once

#include "scene/ray.h"
#include "scene/triangle.h"

#include <span>

namespace encore::accel {

/// Nearest hit by exhaustive search in (at least) quadruple precision, by another formula than
/// decide_hit(): plane first, then the signed areas of the hit point. Single-precision input makes
/// every decision here exact for all practical purposes. Slow; the truth that `brute` is held to.
scene::Hit exact_nearest_hit(std::span<const scene::Triangle> triangles, const scene::Ray& ray);

/// How far a ray passes from the nearest edge of a triangle it crosses, or from its border if it
/// misses, as a share of the triangle's size seen from the ray; 0 on an edge. Tells a rounding edge
/// from a real mistake.
double edge_clearance(const scene::Triangle& triangle, const scene::Ray& ray);

}  // namespace encore::accel
