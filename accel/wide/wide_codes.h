#pragma once

#include "accel/wide/wide_build_memory.h"

namespace encore::accel {

/// Shares out the bits of a code over centres (twice) from `lower` to `upper`, which must be within
/// [-2, 2]: from the highest on to the axis with the longest cells each time.
void set_morton(WideMorton& morton, float unit, const float* lower, const float* upper);
/// Fills in the tables that spread bytes of places.
void spread_morton(WideMorton& morton);

/// Sorts memory.keys[0] by the upper 32 bits of each; equal ones stay in their order. Uses keys[1].
void sort_wide_keys(WideBuildRun& run);

/// Where more triangles than a leaf holds have the same code, gives them codes of a grid over their
/// own centres, in keys[1], sorted; keys[0] has them in the same order. So a small dense object in
/// a large scene is built as if it were alone.
void refine_wide_keys(WideBuildRun& run);

}  // namespace encore::accel
