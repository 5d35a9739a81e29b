#pragma once

#include "scene/ray.h"
#include "scene/triangle.h"

#include <cstdint>

namespace encore::accel {

/// Decides in double precision whether a ray hits a triangle, and where: the one definition of a
/// hit that every structure shares, so that all of them return the same answer.
///
/// Accepts the triangle into `best` and returns true if the ray crosses it (edges and vertices
/// included, from either side), t_min < t, and t < best.t, or t == best.t and `index` is lower than
/// best.triangle. Distances and barycentrics are computed in double and rounded once.
///
/// The edge functions are triple products direction . ((P - Q) x (P + Q)) of origin-relative
/// vertices (Plücker coordinates, as in Embree's robust mode; compare Woop, Benthin and Wald 2013).
/// Differences of vertices and origin are exact in double unless their exponents differ by more
/// than 29, and swapping P and Q flips the sign bit for bit, so two triangles that share an edge
/// never both miss a ray through it. Triangles
/// that are degenerate, or seen edge-on, to within the rounding of double precision are not hit.
/// There is no absolute epsilon: scaling scene and ray by a power of two scales t exactly.
bool decide_hit(const scene::Ray& ray, const scene::Triangle& triangle, std::uint32_t index,
                scene::Hit& best);

}  // namespace encore::accel
