#pragma once

#include "accel/simd/floats.h"

namespace encore::accel::ENCORE_ISA {

#if defined(__SSE4_2__)

/// Doubles side by side, as many as a register of the instruction set holds. Every operation rounds
/// as the scalar one does.
#if defined(ENCORE_AVX512)
#define ENCORE_DOUBLES(NAME) _mm512_##NAME
inline constexpr int kDoubles = 8;
struct Doubles {
  __m512d v;
#elif defined(__AVX2__)
#define ENCORE_DOUBLES(NAME) _mm256_##NAME
inline constexpr int kDoubles = 4;
struct Doubles {
  __m256d v;
#else
#define ENCORE_DOUBLES(NAME) _mm_##NAME
inline constexpr int kDoubles = 2;
struct Doubles {
  __m128d v;
#endif
  static Doubles all(double x) {
    return {ENCORE_DOUBLES(set1_pd)(x)};
  }
  /// From the lower or the upper half of as many floats as a register holds, and back from both.
  template <int kHalf>
  [[gnu::always_inline]] static Doubles of_half(const Floats<2 * kDoubles>& from) {
#if defined(ENCORE_AVX512)
    return {_mm512_cvtps_pd(_mm512_extractf32x8_ps(from.v, kHalf))};
#elif defined(__AVX2__)
    return {_mm256_cvtps_pd(_mm256_extractf128_ps(from.v, kHalf))};
#else
    return {_mm_cvtps_pd(kHalf == 0 ? from.v : _mm_movehl_ps(from.v, from.v))};
#endif
  }
  [[gnu::always_inline]] static Floats<2 * kDoubles> round(Doubles low, Doubles high) {
#if defined(ENCORE_AVX512)
    return {_mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(low.v)),
                               _mm512_cvtpd_ps(high.v), 1)};
#elif defined(__AVX2__)
    return {_mm256_set_m128(_mm256_cvtpd_ps(high.v), _mm256_cvtpd_ps(low.v))};
#else
    return {_mm_movelh_ps(_mm_cvtpd_ps(low.v), _mm_cvtpd_ps(high.v))};
#endif
  }
  friend Doubles operator+(Doubles a, Doubles b) {
    return {ENCORE_DOUBLES(add_pd)(a.v, b.v)};
  }
  friend Doubles operator-(Doubles a, Doubles b) {
    return {ENCORE_DOUBLES(sub_pd)(a.v, b.v)};
  }
  friend Doubles operator*(Doubles a, Doubles b) {
    return {ENCORE_DOUBLES(mul_pd)(a.v, b.v)};
  }
  friend Doubles operator/(Doubles a, Doubles b) {
    return {ENCORE_DOUBLES(div_pd)(a.v, b.v)};
  }
  friend Doubles largest(Doubles a, Doubles b) {
    return {ENCORE_DOUBLES(max_pd)(a.v, b.v)};
  }
  friend Doubles abs(Doubles a) {
    return {ENCORE_DOUBLES(andnot_pd)(ENCORE_DOUBLES(set1_pd)(-0.0), a.v)};
  }
  /// Bit i where a < b, or a == b, in lane i.
  friend unsigned less(Doubles a, Doubles b) {
#if defined(ENCORE_AVX512)
    return _mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ);
#elif defined(__AVX2__)
    return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)));
#else
    return static_cast<unsigned>(_mm_movemask_pd(_mm_cmplt_pd(a.v, b.v)));
#endif
  }
  friend unsigned equal(Doubles a, Doubles b) {
#if defined(ENCORE_AVX512)
    return _mm512_cmp_pd_mask(a.v, b.v, _CMP_EQ_OQ);
#elif defined(__AVX2__)
    return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_EQ_OQ)));
#else
    return static_cast<unsigned>(_mm_movemask_pd(_mm_cmpeq_pd(a.v, b.v)));
#endif
  }
};
#undef ENCORE_DOUBLES

#endif

}  // namespace encore::accel::ENCORE_ISA
