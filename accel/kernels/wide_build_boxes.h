#pragma once

#include "accel/simd/floats.h"
#include "accel/wide/wide_build_kernels.h"

namespace encore::accel::ENCORE_ISA {

using Box = Floats<8>;

inline Box empty_box() {
  return Box::all(__builtin_inff());
}

/// (lower x, y, z, -) and (-upper x, y, z, -)
inline Floats<4> lower_half(const Box& box) {
#if defined(__AVX2__)
  return {_mm256_castps256_ps128(box.v)};
#else
  return box.low;
#endif
}
inline Floats<4> upper_half(const Box& box) {
#if defined(__AVX2__)
  return {_mm256_extractf128_ps(box.v, 1)};
#else
  return box.high;
#endif
}
inline Box join(const Floats<4>& low, const Floats<4>& high) {
#if defined(__AVX2__)
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(low.v), high.v, 1)};
#else
  return {low, high};
#endif
}

/// The sign of all numbers turned.
inline Floats<4> minus(const Floats<4>& a) {
  return a ^ Floats<4>::all(-0.0F);
}

/// Twice the centre.
inline Floats<4> center(const Box& box) {
  return lower_half(box) - upper_half(box);
}
/// A point as a box.
inline Box point_box(const Floats<4>& p) {
  return join(p, minus(p));
}

inline void extend(WideBox& box, const Box& by) {
  min(Box::load(box.ends), by).store(box.ends);
}

/// Half the area of each of three boxes, and a number that means nothing.
inline Floats<4> half_areas(const Box& a, const Box& b, const Box& c) {
#if defined(__SSE4_2__)
  // Extents with the sign turned, whose products are those of the extents.
  const __m128 ea = (lower_half(a) + upper_half(a)).v;
  const __m128 eb = (lower_half(b) + upper_half(b)).v;
  const __m128 ec = (lower_half(c) + upper_half(c)).v;
  const __m128 xy_ab_low = _mm_unpacklo_ps(ea, ec);   // ax cx ay cy
  const __m128 z_ac = _mm_unpackhi_ps(ea, ec);        // az cz
  const __m128 xy_b = _mm_unpacklo_ps(eb, eb);        // bx bx by by
  const __m128 z_b = _mm_unpackhi_ps(eb, eb);         // bz bz
  const __m128 x = _mm_unpacklo_ps(xy_ab_low, xy_b);  // ax bx cx bx
  const __m128 y = _mm_unpackhi_ps(xy_ab_low, xy_b);  // ay by cy by
  const __m128 z = _mm_unpacklo_ps(z_ac, z_b);        // az bz cz bz
  return {_mm_add_ps(_mm_add_ps(_mm_mul_ps(x, y), _mm_mul_ps(y, z)), _mm_mul_ps(z, x))};
#else
  const Box* const boxes[3] = {&a, &b, &c};
  Floats<4> areas = Floats<4>::all(0.0F);
  for (int i = 0; i < 3; ++i) {
    const Floats<4> e = lower_half(*boxes[i]) + upper_half(*boxes[i]);
    areas.lane[i] = (e.lane[0] * e.lane[1] + e.lane[1] * e.lane[2]) + e.lane[2] * e.lane[0];
  }
  return areas;
#endif
}

inline float half_area(const float* ends) {
  const float x = ends[0] + ends[4], y = ends[1] + ends[5], z = ends[2] + ends[6];
  return (x * y + y * z) + z * x;
}

/// Where the first lane that differs makes itself felt nowhere: the box of a triangle, from its
/// corners' 16 bytes each.
inline Box triangle_box(const scene::Triangle& triangle) {
  const Floats<4> a = Floats<4>::load(&triangle.v0);
  const Floats<4> b = Floats<4>::load(&triangle.v1);
  const Floats<4> c = Floats<4>::load(&triangle.v2);
  return join(min(min(a, b), c), minus(max(max(a, b), c)));
}

}  // namespace encore::accel::ENCORE_ISA
