#pragma once

#include "scene/bounds.h"
#include "scene/triangle.h"

namespace encore::accel {

/// Whether a triangle and a closed box have a point in common: the separating-axis test of
/// Akenine-Möller (2001) over the box's three normals, the triangle's normal and the nine cross
/// products of their edges.
///
/// Conservative: false means certainly apart. Unlike the paper, every axis carries a bound of its
/// own rounding error, and an axis separates only beyond it, so a triangle that merely touches the
/// box is never turned away; one that comes within about 2^-50 of the sizes involved may be kept.
/// Degenerate triangles (segments, points) are tested just as sharply. The bounds are relative, and
/// the arithmetic is double on float input, which neither overflows nor underflows here, so the
/// answer is the same at any scale. All coordinates must be finite, and the box not empty.
[[nodiscard]] bool overlaps(const scene::Triangle& triangle, const scene::Bounds& box);

}  // namespace encore::accel
