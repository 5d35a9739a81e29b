#pragma once

#include "scene/bounds.h"
#include "scene/triangle.h"

namespace encore::accel {

/// The bounds of a triangle's parts on the two sides of a plane; empty() where there is none.
struct SplitExtent {
  scene::Bounds lower;
  scene::Bounds upper;
};

/// Cuts the part of `triangle` that lies in the closed `box` by the plane at `position` on `axis`
/// and returns the bounds of both halves: the triangle's true extent in the two children of a
/// kd-tree node ("perfect splits", Havran and Bittner 2002).
///
/// `extent` holds bounds of that part known before; the result never exceeds them, nor the box, nor
/// the plane. The bounds are conservative: no point of the exact triangle in the closed half boxes
/// is ever left out. The triangle is clipped polygon against plane (Sutherland and Hodgman 1974) in
/// double precision with planes moved outwards by a multiple of the rounding error, relative to the
/// triangle's coordinates; corners of the triangle itself stay exact, and computed corners are
/// rounded outwards to float.
SplitExtent split_extent(const scene::Triangle& triangle, const scene::Bounds& box,
                         const scene::Bounds& extent, int axis, float position);

}  // namespace encore::accel
