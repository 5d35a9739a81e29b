#pragma once

#include "accel/wide/wide_build_kernels.h"
#include "scene/triangle.h"

namespace encore::accel {

/// Bounds of the triangle's parts below and above a plane within an item's box, rounded so that
/// they contain what they stand for. A side that the triangle does not reach within the box has a
/// lower end above its upper one along some axis.
void clip_wide_item(const scene::Triangle& triangle, const WideItem& item, int axis, float plane,
                    WideItem sides[2]);

inline bool is_empty(const WideItem& item) {
  return item.lower[0] > -item.minus_upper[0] || item.lower[1] > -item.minus_upper[1] ||
         item.lower[2] > -item.minus_upper[2];
}

}  // namespace encore::accel
