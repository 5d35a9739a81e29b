#pragma once

#include "shaders/shared/tolerance.h"

namespace encore::accel {

/// Rounding bounds of single precision (shaders/shared/tolerance.h), all relative: they scale with
/// the numbers they guard, so results do not depend on the scene's size.
///
/// Two plane distances that differ by less than kPlaneSlack relatively may be in either order; a
/// traversal must treat them as equal and visit both sides (Ize 2013 for boxes; we use the same
/// bound for kd and grid planes).
inline constexpr float kUnitRoundoff = ENCORE_UNIT_ROUNDOFF;
inline constexpr float kPlaneSlack = ENCORE_PLANE_SLACK;
inline constexpr float kWiden = 1.0F + kPlaneSlack;   ///< multiplies a positive exit distance
inline constexpr float kNarrow = 1.0F - kPlaneSlack;  ///< multiplies a positive entry distance
static_assert(kUnitRoundoff == 0x1p-24F && kPlaneSlack == 16 * kUnitRoundoff);

}  // namespace encore::accel
