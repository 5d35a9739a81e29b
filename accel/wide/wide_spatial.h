#pragma once

#include "accel/wide/wide_build_kernels.h"
#include "scene/triangle.h"

#include <cstdint>

namespace encore::accel {

/// What spatial splits need (Stich, Friedrich and Dietrich 2009): nodes whose halves would overlap
/// much are divided by a plane instead, and what lies across it goes to both sides, each with the
/// box of its part. Items' coordinates are the triangles' own.
struct WideSpatial {
  const scene::Triangle* triangles;
  float root_area;  ///< half the area of everything's box
};

/// Divides the items of `range` by a plane if that costs less than `object_cost` (half areas times
/// blocks) and there is room; they go to `to`, where every position belongs to this range from
/// `begin` up to `room`. False: nothing has changed.
bool split_wide_space(const WideSpatial& spatial, const WideItem* items, float object_cost,
                      WideItem* to, WideRange& range, WideRange& other);

/// Where the right items of a range begin when `left` go left: what room is left is shared out by
/// the items.
[[gnu::always_inline]] inline std::uint32_t wide_right_begin(const WideRange& range,
                                                             std::uint32_t left) {
  const std::uint64_t spare = range.room - range.end;
  return range.begin + left + static_cast<std::uint32_t>(spare * left / (range.end - range.begin));
}

/// Whether halves overlap enough for it to be tried.
[[gnu::always_inline]] inline bool wide_halves_overlap(const WideSpatial& spatial, float area,
                                                       const WideBox* halves) {
  float size[3];
  for (int axis = 0; axis < 3; ++axis) {
    const float* const a = halves[0].ends;
    const float* const b = halves[1].ends;
    const float lower = a[axis] > b[axis] ? a[axis] : b[axis];
    const float minus_upper = a[axis + 4] > b[axis + 4] ? a[axis + 4] : b[axis + 4];
    size[axis] = -minus_upper - lower;
    if (!(size[axis] >= 0.0F)) return false;
  }
  const float overlap = size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  return overlap > 0.2F * area && overlap > 1e-5F * spatial.root_area;
}

}  // namespace encore::accel
