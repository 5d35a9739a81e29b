#pragma once

#include "accel/simd/floats.h"

namespace encore::accel::ENCORE_ISA {

/// N points or vectors by axis. Sums and products are taken in the order of the scalar testers
/// (accel/triangle_*.h), so results are theirs, bit for bit.
template <int N>
struct Points {
  Floats<N> x, y, z;

  /// The same one N times; anything with members x, y and z.
  template <class Vector>
  [[gnu::always_inline]] static Points all(const Vector& v) {
    return {Floats<N>::all(v.x), Floats<N>::all(v.y), Floats<N>::all(v.z)};
  }
  /// From x[N], y[N], z[N], one after the other, `stride` floats apart.
  [[gnu::always_inline]] static Points load(const float* from, int stride) {
    return {Floats<N>::load(from), Floats<N>::load(from + stride),
            Floats<N>::load(from + 2 * stride)};
  }
  [[gnu::always_inline]] friend Points operator-(const Points& a, const Points& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[gnu::always_inline]] friend Points cross(const Points& a, const Points& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  [[gnu::always_inline]] friend Floats<N> dot(const Points& a, const Points& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  /// The largest magnitude of the three.
  [[gnu::always_inline]] friend Floats<N> largest(const Points& a) {
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
  }
};

[[gnu::always_inline]] inline Points<8> beside(const Points<4>& low, const Points<4>& high) {
  return {beside(low.x, high.x), beside(low.y, high.y), beside(low.z, high.z)};
}

/// The corners of N triangles, or N times those of one.
template <int N>
struct Corners {
  Points<N> v0, v1, v2;
};
[[gnu::always_inline]] inline Corners<8> beside(const Corners<4>& low, const Corners<4>& high) {
  return {beside(low.v0, high.v0), beside(low.v1, high.v1), beside(low.v2, high.v2)};
}

}  // namespace encore::accel::ENCORE_ISA
