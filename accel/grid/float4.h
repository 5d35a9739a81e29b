#pragma once

namespace encore::accel {

/// Four floats that the compiler keeps in one vector register where the machine has one (an
/// extension that GCC and Clang share, on every architecture). Comparisons give lanes of 0 or -1.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

inline Float4 broadcast(float x) {
  return Float4{x, x, x, x};
}
inline Float4 min4(Float4 a, Float4 b) {
  return a < b ? a : b;
}
inline Float4 max4(Float4 a, Float4 b) {
  return a > b ? a : b;
}
inline Float4 abs4(Float4 a) {
  return a < 0.0F ? -a : a;
}

/// (y, z, x, w) of (x, y, z, w).
inline Float4 next_axis(Float4 a) {
  return Float4{a[1], a[2], a[0], a[3]};
}

/// Bit i: lane i is set.
inline unsigned lane_bits(Int4 lanes) {
#if defined(__SSE2__)
  return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<Float4>(lanes)));
#else
  return (lanes[0] & 1U) | (lanes[1] & 2U) | (lanes[2] & 4U) | (lanes[3] & 8U);
#endif
}

}  // namespace encore::accel
