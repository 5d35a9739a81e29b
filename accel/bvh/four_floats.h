#pragma once

#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace encore::accel {

/// Four floats side by side, in portable C++. FourFloatsSse below does the same with SSE2, bit for
/// bit; code is written as a template on either, or on FourFloats, the faster one of this machine.
///
/// min(a, b) and max(a, b) return `b` where either is NaN: callers pass what may be NaN first and
/// so drop it. Loads take any 16 bytes; lanes that hold integers may ride along through load,
/// store, min, max and the shuffles, but not through arithmetic, where small integers look like
/// denormal numbers and cost a hundred cycles on some machines.
struct FourFloatsPortable {
  float lane[4];

  static FourFloatsPortable load(const void* from) {
    FourFloatsPortable r;
    std::memcpy(r.lane, from, sizeof r.lane);
    return r;
  }
  static FourFloatsPortable all(float v) { return {{v, v, v, v}}; }
  static FourFloatsPortable of(float a, float b, float c, float d) { return {{a, b, c, d}}; }
  void store(void* to) const { std::memcpy(to, lane, sizeof lane); }
  template <int I>
  [[nodiscard]] float get() const {
    return lane[I];
  }

  friend FourFloatsPortable operator-(const FourFloatsPortable& a, const FourFloatsPortable& b) {
    return each(a, b, [](float x, float y) { return x - y; });
  }
  friend FourFloatsPortable operator*(const FourFloatsPortable& a, const FourFloatsPortable& b) {
    return each(a, b, [](float x, float y) { return x * y; });
  }
  friend FourFloatsPortable min(const FourFloatsPortable& a, const FourFloatsPortable& b) {
    return each(a, b, [](float x, float y) { return x < y ? x : y; });
  }
  friend FourFloatsPortable max(const FourFloatsPortable& a, const FourFloatsPortable& b) {
    return each(a, b, [](float x, float y) { return x > y ? x : y; });
  }
  /// (a0, b0, a1, b1)
  friend FourFloatsPortable interleave_low(const FourFloatsPortable& a,
                                           const FourFloatsPortable& b) {
    return {{a.lane[0], b.lane[0], a.lane[1], b.lane[1]}};
  }
  /// (a2, b2, a3, b3)
  friend FourFloatsPortable interleave_high(const FourFloatsPortable& a,
                                            const FourFloatsPortable& b) {
    return {{a.lane[2], b.lane[2], a.lane[3], b.lane[3]}};
  }
  /// (a0, a1, b0, b1)
  friend FourFloatsPortable low_halves(const FourFloatsPortable& a, const FourFloatsPortable& b) {
    return {{a.lane[0], a.lane[1], b.lane[0], b.lane[1]}};
  }
  /// (a2, a3, a2, a3)
  friend FourFloatsPortable high_half(const FourFloatsPortable& a) {
    return {{a.lane[2], a.lane[3], a.lane[2], a.lane[3]}};
  }
  /// Bit i is set where a <= b in lane i.
  friend unsigned less_equal(const FourFloatsPortable& a, const FourFloatsPortable& b) {
    unsigned bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits |= unsigned{a.lane[i] <= b.lane[i]} << i;
    return bits;
  }
  /// Bit i is set where a != b in lane i.
  friend unsigned not_equal(const FourFloatsPortable& a, const FourFloatsPortable& b) {
    unsigned bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits |= unsigned{a.lane[i] != b.lane[i]} << i;
    return bits;
  }

 private:
  template <class F>
  static FourFloatsPortable each(const FourFloatsPortable& a, const FourFloatsPortable& b, F f) {
    return {{f(a.lane[0], b.lane[0]), f(a.lane[1], b.lane[1]), f(a.lane[2], b.lane[2]),
             f(a.lane[3], b.lane[3])}};
  }
};

#if defined(__SSE2__)
/// The same on SSE2 registers.
struct FourFloatsSse {
  __m128 v;

  static FourFloatsSse load(const void* from) {
    return {_mm_loadu_ps(static_cast<const float*>(from))};
  }
  static FourFloatsSse all(float x) { return {_mm_set1_ps(x)}; }
  static FourFloatsSse of(float a, float b, float c, float d) { return {_mm_setr_ps(a, b, c, d)}; }
  void store(void* to) const { _mm_storeu_ps(static_cast<float*>(to), v); }
  template <int I>
  [[nodiscard]] float get() const {
    return _mm_cvtss_f32(_mm_shuffle_ps(v, v, _MM_SHUFFLE(I, I, I, I)));
  }

  friend FourFloatsSse operator-(FourFloatsSse a, FourFloatsSse b) {
    return {_mm_sub_ps(a.v, b.v)};
  }
  friend FourFloatsSse operator*(FourFloatsSse a, FourFloatsSse b) {
    return {_mm_mul_ps(a.v, b.v)};
  }
  friend FourFloatsSse min(FourFloatsSse a, FourFloatsSse b) { return {_mm_min_ps(a.v, b.v)}; }
  friend FourFloatsSse max(FourFloatsSse a, FourFloatsSse b) { return {_mm_max_ps(a.v, b.v)}; }
  friend FourFloatsSse interleave_low(FourFloatsSse a, FourFloatsSse b) {
    return {_mm_unpacklo_ps(a.v, b.v)};
  }
  friend FourFloatsSse interleave_high(FourFloatsSse a, FourFloatsSse b) {
    return {_mm_unpackhi_ps(a.v, b.v)};
  }
  friend FourFloatsSse low_halves(FourFloatsSse a, FourFloatsSse b) {
    return {_mm_movelh_ps(a.v, b.v)};
  }
  friend FourFloatsSse high_half(FourFloatsSse a) { return {_mm_movehl_ps(a.v, a.v)}; }
  friend unsigned less_equal(FourFloatsSse a, FourFloatsSse b) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a.v, b.v)));
  }
  friend unsigned not_equal(FourFloatsSse a, FourFloatsSse b) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpneq_ps(a.v, b.v)));
  }
};
using FourFloats = FourFloatsSse;
#else
using FourFloats = FourFloatsPortable;
#endif

}  // namespace encore::accel
