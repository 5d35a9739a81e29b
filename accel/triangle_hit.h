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
/// The ray is made the z axis by a permutation and a shear, and the edge functions of the sheared
/// vertices decide (Woop, Benthin and Wald 2013), all in double. A sheared vertex depends on ray
/// and vertex alone, and the sign of an edge function is exact for the two that it is given: so the
/// ray meets the vertices' picture as a plane mesh, and no ray passes between triangles that share
/// an edge, nor between all those around a vertex. (Edge functions whose signs are not exact can
/// all say that the ray passes on the same side of a vertex, which then belongs to no triangle.)
/// Triangles that are degenerate, or seen edge-on, to within the rounding of double precision are
/// not hit.
/// Every finite triangle is decided rightly, but structures find hits without fail only where
/// coordinates of triangles and origins stay within 2^126 (8.5e37): beyond 2^127 their differences,
/// from which plane distances come, may overflow single precision (of 151 rays through a scene of
/// 3e38 structures missed 3 to 5, and the exact oracle's box test some, too).
/// There is no absolute epsilon: scaling scene and ray by a power of two scales t exactly.
bool decide_hit(const scene::Ray& ray, const scene::Triangle& triangle, std::uint32_t index,
                scene::Hit& best);

}  // namespace encore::accel
