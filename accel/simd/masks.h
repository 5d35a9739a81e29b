#pragma once

#include "accel/simd/intrinsics.h"

namespace encore::accel::ENCORE_ISA {

/// N truths, N = 4, 8 or 16, as the comparisons of Floats (accel/simd/floats.h) give them.
/// bits(): bit i is lane i.
template <int N>
struct Mask;

#if defined(__AVX512VL__) && defined(__AVX512DQ__)
#define ENCORE_AVX512 1
#endif

#if defined(ENCORE_AVX512)
template <int N>
struct Mask {
  unsigned m;
  [[nodiscard]] unsigned bits() const { return m; }
  static Mask of_bits(unsigned bits) { return {bits & ((1U << N) - 1U)}; }
  friend Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
  friend Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
  /// a and not b
  friend Mask without(Mask a, Mask b) { return {a.m & ~b.m}; }
};
#elif defined(__SSE4_2__)
template <>
struct Mask<4> {
  __m128 m;
  [[nodiscard]] unsigned bits() const { return static_cast<unsigned>(_mm_movemask_ps(m)); }
  static Mask of_bits(unsigned bits) {
    const __m128i lanes = _mm_setr_epi32(1, 2, 4, 8);
    const __m128i set = _mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), lanes);
    return {_mm_castsi128_ps(_mm_cmpeq_epi32(set, lanes))};
  }
  friend Mask operator&(Mask a, Mask b) { return {_mm_and_ps(a.m, b.m)}; }
  friend Mask operator|(Mask a, Mask b) { return {_mm_or_ps(a.m, b.m)}; }
  friend Mask without(Mask a, Mask b) { return {_mm_andnot_ps(b.m, a.m)}; }
};
#else
template <>
struct Mask<4> {
  unsigned m;
  [[nodiscard]] unsigned bits() const { return m; }
  static Mask of_bits(unsigned bits) { return {bits & 0xFU}; }
  friend Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
  friend Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
  friend Mask without(Mask a, Mask b) { return {a.m & ~b.m}; }
};
#endif

#if !defined(ENCORE_AVX512)
#if defined(__AVX2__)
template <>
struct Mask<8> {
  __m256 m;
  [[nodiscard]] unsigned bits() const { return static_cast<unsigned>(_mm256_movemask_ps(m)); }
  static Mask of_bits(unsigned bits) {
    const __m256i lanes = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lanes);
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lanes))};
  }
  friend Mask operator&(Mask a, Mask b) { return {_mm256_and_ps(a.m, b.m)}; }
  friend Mask operator|(Mask a, Mask b) { return {_mm256_or_ps(a.m, b.m)}; }
  friend Mask without(Mask a, Mask b) { return {_mm256_andnot_ps(b.m, a.m)}; }
};
#endif

template <int N>
struct Mask {
  Mask<N / 2> low, high;
  [[nodiscard]] unsigned bits() const { return low.bits() | high.bits() << (N / 2); }
  static Mask of_bits(unsigned bits) {
    return {Mask<N / 2>::of_bits(bits), Mask<N / 2>::of_bits(bits >> (N / 2))};
  }
  friend Mask operator&(const Mask& a, const Mask& b) { return {a.low & b.low, a.high & b.high}; }
  friend Mask operator|(const Mask& a, const Mask& b) { return {a.low | b.low, a.high | b.high}; }
  friend Mask without(const Mask& a, const Mask& b) {
    return {without(a.low, b.low), without(a.high, b.high)};
  }
};
#endif

}  // namespace encore::accel::ENCORE_ISA
