#pragma once

namespace encore::accel {

/// Rounding bounds of single precision, all relative: they scale with the numbers they guard, so
/// results do not depend on the scene's size.
///
/// A plane distance t = (plane - origin) * (1 / direction) takes three correctly rounded
/// operations, so it is off by at most 1.5 ulp (relative 3 * 2^-24) from the exact value, however
/// far the origin is away. Two distances that differ by less than kPlaneSlack relatively may
/// therefore be in either order; a traversal must treat them as equal and visit both sides
/// (Ize 2013 for boxes; we use the same bound for kd and grid planes).
inline constexpr float kUnitRoundoff = 0x1p-24F;
inline constexpr float kPlaneSlack = 8 * kUnitRoundoff;
inline constexpr float kWiden = 1.0F + kPlaneSlack;   ///< multiplies a positive exit distance
inline constexpr float kNarrow = 1.0F - kPlaneSlack;  ///< multiplies a positive entry distance

}  // namespace encore::accel
