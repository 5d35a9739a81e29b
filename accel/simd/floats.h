#pragma once

#include "accel/simd/masks.h"

#include <cstdint>
#include <cstring>

namespace encore::accel::ENCORE_ISA {

/// N floats side by side, N = 4, 8 or 16, in registers of the instruction set that the file is
/// compiled for; in two halves where those are narrower. Every operation rounds as the scalar one
/// does, nothing is ever fused, so results are the same for every instruction set.
///
/// min(a, b) and max(a, b) return `b` where either is NaN. Lanes that hold integers may ride along
/// through load, store, select and all_bits, but not through arithmetic.
template <int N>
struct Floats;

#if defined(__SSE4_2__)

// The operations of one register width; the three differ in nothing but the names.
#define ENCORE_FLOATS_ARITHMETIC(N, REGISTER, PREFIX)            \
  REGISTER v;                                                    \
  static Floats load(const void* from) {                         \
    return {PREFIX##_loadu_ps(static_cast<const float*>(from))}; \
  }                                                              \
  void store(void* to) const {                                   \
    PREFIX##_storeu_ps(static_cast<float*>(to), v);              \
  }                                                              \
  static Floats all(float x) {                                   \
    return {PREFIX##_set1_ps(x)};                                \
  }                                                              \
  static Floats all_bits(std::uint32_t x) {                      \
    return all(__builtin_bit_cast(float, x));                    \
  }                                                              \
  friend Floats operator+(Floats a, Floats b) {                  \
    return {PREFIX##_add_ps(a.v, b.v)};                          \
  }                                                              \
  friend Floats operator-(Floats a, Floats b) {                  \
    return {PREFIX##_sub_ps(a.v, b.v)};                          \
  }                                                              \
  friend Floats operator*(Floats a, Floats b) {                  \
    return {PREFIX##_mul_ps(a.v, b.v)};                          \
  }                                                              \
  friend Floats operator/(Floats a, Floats b) {                  \
    return {PREFIX##_div_ps(a.v, b.v)};                          \
  }                                                              \
  friend Floats min(Floats a, Floats b) {                        \
    return {PREFIX##_min_ps(a.v, b.v)};                          \
  }                                                              \
  friend Floats max(Floats a, Floats b) {                        \
    return {PREFIX##_max_ps(a.v, b.v)};                          \
  }                                                              \
  friend Floats operator&(Floats a, Floats b) {                  \
    return {PREFIX##_and_ps(a.v, b.v)};                          \
  }                                                              \
  friend Floats operator^(Floats a, Floats b) {                  \
    return {PREFIX##_xor_ps(a.v, b.v)};                          \
  }                                                              \
  friend Floats operator|(Floats a, Floats b) {                  \
    return {PREFIX##_or_ps(a.v, b.v)};                           \
  }                                                              \
  friend Floats abs(Floats a) {                                  \
    return {PREFIX##_andnot_ps(all(-0.0F).v, a.v)};              \
  }

#if defined(ENCORE_AVX512)
#define ENCORE_FLOATS_COMPARISONS(N, PREFIX)             \
  friend Mask<N> operator<(Floats a, Floats b) {         \
    return {PREFIX##_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; \
  }                                                      \
  friend Mask<N> operator<=(Floats a, Floats b) {        \
    return {PREFIX##_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; \
  }                                                      \
  friend Mask<N> operator>(Floats a, Floats b) {         \
    return b < a;                                        \
  }                                                      \
  friend Mask<N> operator>=(Floats a, Floats b) {        \
    return b <= a;                                       \
  }                                                      \
  friend Mask<N> operator==(Floats a, Floats b) {        \
    return {PREFIX##_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; \
  }
#define ENCORE_SAME_BITS(N, PREFIX, TO_INTEGERS)                                                  \
  friend Mask<N> same_bits(Floats a, Floats b) {                                                  \
    return {PREFIX##_cmpeq_epi32_mask(PREFIX##_##TO_INTEGERS(a.v), PREFIX##_##TO_INTEGERS(b.v))}; \
  }
#define ENCORE_SELECT(N, PREFIX, MASK)                                 \
  friend Floats select(Mask<N> m, Floats a, Floats b) {                \
    return {PREFIX##_mask_blend_ps(static_cast<MASK>(m.m), b.v, a.v)}; \
  }
template <>
struct Floats<4> {
  ENCORE_FLOATS_ARITHMETIC(4, __m128, _mm)
  ENCORE_FLOATS_COMPARISONS(4, _mm)
  ENCORE_SAME_BITS(4, _mm, castps_si128)
  ENCORE_SELECT(4, _mm, __mmask8)
};
template <>
struct Floats<8> {
  ENCORE_FLOATS_ARITHMETIC(8, __m256, _mm256)
  ENCORE_FLOATS_COMPARISONS(8, _mm256)
  ENCORE_SAME_BITS(8, _mm256, castps_si256)
  ENCORE_SELECT(8, _mm256, __mmask8)
};
template <>
struct Floats<16> {
  ENCORE_FLOATS_ARITHMETIC(16, __m512, _mm512)
  ENCORE_FLOATS_COMPARISONS(16, _mm512)
  ENCORE_SAME_BITS(16, _mm512, castps_si512)
  ENCORE_SELECT(16, _mm512, __mmask16)
};
#else
template <>
struct Floats<4> {
  ENCORE_FLOATS_ARITHMETIC(4, __m128, _mm)
  friend Mask<4> operator<(Floats a, Floats b) { return {_mm_cmplt_ps(a.v, b.v)}; }
  friend Mask<4> operator<=(Floats a, Floats b) { return {_mm_cmple_ps(a.v, b.v)}; }
  friend Mask<4> operator>(Floats a, Floats b) { return b < a; }
  friend Mask<4> operator>=(Floats a, Floats b) { return b <= a; }
  friend Mask<4> operator==(Floats a, Floats b) { return {_mm_cmpeq_ps(a.v, b.v)}; }
  /// Where all bits are the same, whatever they stand for.
  friend Mask<4> same_bits(Floats a, Floats b) {
    return {_mm_castsi128_ps(_mm_cmpeq_epi32(_mm_castps_si128(a.v), _mm_castps_si128(b.v)))};
  }
  /// a where m, else b
  friend Floats select(Mask<4> m, Floats a, Floats b) { return {_mm_blendv_ps(b.v, a.v, m.m)}; }
};
#if defined(__AVX2__)
template <>
struct Floats<8> {
  ENCORE_FLOATS_ARITHMETIC(8, __m256, _mm256)
  friend Mask<8> operator<(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
  friend Mask<8> operator<=(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
  friend Mask<8> operator>(Floats a, Floats b) { return b < a; }
  friend Mask<8> operator>=(Floats a, Floats b) { return b <= a; }
  friend Mask<8> operator==(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)}; }
  friend Mask<8> same_bits(Floats a, Floats b) {
    const __m256i x = _mm256_castps_si256(a.v), y = _mm256_castps_si256(b.v);
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(x, y))};
  }
  friend Floats select(Mask<8> m, Floats a, Floats b) { return {_mm256_blendv_ps(b.v, a.v, m.m)}; }
};
#endif
#endif

#else  // no SSE4.2: plain C++
template <>
struct Floats<4> {
  float lane[4];
  static Floats load(const void* from) {
    Floats r;
    std::memcpy(r.lane, from, sizeof r.lane);
    return r;
  }
  void store(void* to) const { std::memcpy(to, lane, sizeof lane); }
  static Floats all(float x) { return {{x, x, x, x}}; }
  static Floats all_bits(std::uint32_t x) { return all(__builtin_bit_cast(float, x)); }
  friend Floats operator+(const Floats& a, const Floats& b) {
    return each(a, b, [](float x, float y) { return x + y; });
  }
  friend Floats operator-(const Floats& a, const Floats& b) {
    return each(a, b, [](float x, float y) { return x - y; });
  }
  friend Floats operator*(const Floats& a, const Floats& b) {
    return each(a, b, [](float x, float y) { return x * y; });
  }
  friend Floats operator/(const Floats& a, const Floats& b) {
    return each(a, b, [](float x, float y) { return x / y; });
  }
  friend Floats min(const Floats& a, const Floats& b) {
    return each(a, b, [](float x, float y) { return x < y ? x : y; });
  }
  friend Floats max(const Floats& a, const Floats& b) {
    return each(a, b, [](float x, float y) { return x > y ? x : y; });
  }
  friend Floats operator&(const Floats& a, const Floats& b) {
    return each_bits(a, b, [](std::uint32_t x, std::uint32_t y) { return x & y; });
  }
  friend Floats operator|(const Floats& a, const Floats& b) {
    return each_bits(a, b, [](std::uint32_t x, std::uint32_t y) { return x | y; });
  }
  friend Floats operator^(const Floats& a, const Floats& b) {
    return each_bits(a, b, [](std::uint32_t x, std::uint32_t y) { return x ^ y; });
  }
  friend Floats abs(const Floats& a) { return a & all_bits(0x7FFFFFFFU); }
  friend Mask<4> operator<(const Floats& a, const Floats& b) {
    return ask(a, b, [](float x, float y) { return x < y; });
  }
  friend Mask<4> operator<=(const Floats& a, const Floats& b) {
    return ask(a, b, [](float x, float y) { return x <= y; });
  }
  friend Mask<4> operator>(const Floats& a, const Floats& b) { return b < a; }
  friend Mask<4> operator>=(const Floats& a, const Floats& b) { return b <= a; }
  friend Mask<4> operator==(const Floats& a, const Floats& b) {
    return ask(a, b, [](float x, float y) { return x == y; });
  }
  friend Mask<4> same_bits(const Floats& a, const Floats& b) {
    return ask(a, b, [](float x, float y) {
      return __builtin_bit_cast(std::uint32_t, x) == __builtin_bit_cast(std::uint32_t, y);
    });
  }
  friend Floats select(const Mask<4>& m, const Floats& a, const Floats& b) {
    Floats r = b;
    for (unsigned i = 0; i < 4; ++i) {
      if ((m.m >> i & 1U) != 0) r.lane[i] = a.lane[i];
    }
    return r;
  }

 private:
  template <class F>
  static Floats each(const Floats& a, const Floats& b, F f) {
    return {{f(a.lane[0], b.lane[0]), f(a.lane[1], b.lane[1]), f(a.lane[2], b.lane[2]),
             f(a.lane[3], b.lane[3])}};
  }
  template <class F>
  static Floats each_bits(const Floats& a, const Floats& b, F f) {
    return each(a, b, [f](float x, float y) {
      return __builtin_bit_cast(
          float, f(__builtin_bit_cast(std::uint32_t, x), __builtin_bit_cast(std::uint32_t, y)));
    });
  }
  template <class F>
  static Mask<4> ask(const Floats& a, const Floats& b, F f) {
    unsigned bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits |= unsigned{f(a.lane[i], b.lane[i])} << i;
    return {bits};
  }
};
#endif

#if !defined(ENCORE_AVX512)
template <int N>
struct Floats {
  Floats<N / 2> low, high;
  static Floats load(const void* from) {
    return {Floats<N / 2>::load(from),
            Floats<N / 2>::load(static_cast<const float*>(from) + N / 2)};
  }
  void store(void* to) const {
    low.store(to);
    high.store(static_cast<float*>(to) + N / 2);
  }
  static Floats all(float x) { return {Floats<N / 2>::all(x), Floats<N / 2>::all(x)}; }
  static Floats all_bits(std::uint32_t x) {
    return {Floats<N / 2>::all_bits(x), Floats<N / 2>::all_bits(x)};
  }
#define ENCORE_HALVES(RESULT, NAME)                      \
  friend RESULT NAME(const Floats& a, const Floats& b) { \
    return {NAME(a.low, b.low), NAME(a.high, b.high)};   \
  }
  ENCORE_HALVES(Floats, operator+)
  ENCORE_HALVES(Floats, operator-)
  ENCORE_HALVES(Floats, operator*)
  ENCORE_HALVES(Floats, operator/)
  ENCORE_HALVES(Floats, min)
  ENCORE_HALVES(Floats, max)
  ENCORE_HALVES(Floats, operator&)
  ENCORE_HALVES(Floats, operator|)
  ENCORE_HALVES(Floats, operator^)
  ENCORE_HALVES(Mask<N>, operator<)
  ENCORE_HALVES(Mask<N>, operator<=)
  ENCORE_HALVES(Mask<N>, operator>)
  ENCORE_HALVES(Mask<N>, operator>=)
  ENCORE_HALVES(Mask<N>, operator==)
  ENCORE_HALVES(Mask<N>, same_bits)
#undef ENCORE_HALVES
  friend Floats abs(const Floats& a) {
    return {abs(a.low), abs(a.high)};
  }
  friend Floats select(const Mask<N>& m, const Floats& a, const Floats& b) {
    return {select(m.low, a.low, b.low), select(m.high, a.high, b.high)};
  }
};
#endif

// ---------------------------------------------------------------------------------------- halves

/// Eight of twice four, and the four that are its lower or its upper half.
#if defined(__AVX2__)
inline Floats<8> beside(Floats<4> low, Floats<4> high) {
  return {_mm256_insertf128_ps(_mm256_castps128_ps256(low.v), high.v, 1)};
}
inline Floats<4> low_half(Floats<8> x) {
  return {_mm256_castps256_ps128(x.v)};
}
inline Floats<4> high_half(Floats<8> x) {
  return {_mm256_extractf128_ps(x.v, 1)};
}
#else
inline Floats<8> beside(const Floats<4>& low, const Floats<4>& high) {
  return {low, high};
}
inline Floats<4> low_half(const Floats<8>& x) {
  return x.low;
}
inline Floats<4> high_half(const Floats<8>& x) {
  return x.high;
}
#endif

#undef ENCORE_FLOATS_ARITHMETIC
#undef ENCORE_FLOATS_COMPARISONS
#undef ENCORE_SAME_BITS
#undef ENCORE_SELECT

}  // namespace encore::accel::ENCORE_ISA
