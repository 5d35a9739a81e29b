#pragma once

#include "accel/kernels/points.h"
#include "accel/kernels/wide_tile_packet.h"

namespace encore::accel::ENCORE_ISA {

/// A few of a group's rays, so that all of them meet the four triangles of a block at once: lane
/// 4 i + k is ray i with triangle k. One step then does what takes one for each triangle otherwise.
class FewRays {
 public:
  static constexpr int kMost = kLanes / 4;

  /// `rays`: bit by bit those of the group, kMost at most and one at least.
  [[gnu::always_inline]] explicit FewRays(unsigned rays) {
#if defined(ENCORE_AVX512)
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i quarters = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    const __m512i packed = _mm512_maskz_compress_epi32(static_cast<__mmask16>(rays), lanes);
    from_ = _mm512_permutexvar_epi32(quarters, packed);
#endif
    int count = 0;
    for (; rays != 0; rays &= rays - 1) ray_[count++] = __builtin_ctz(rays);
    lanes_ = (1U << (4 * count)) - 1U;
    for (; count < kMost; ++count) ray_[count] = ray_[0];
  }

  /// Bits of the lanes that stand for a ray.
  [[nodiscard]] unsigned lanes() const {
    return lanes_;
  }
  /// Which of the group's rays a lane stands for.
  [[nodiscard]] int ray(int lane) const {
    return ray_[lane / 4];
  }

  /// Bit by bit those of the group's rays whose lane for triangle `k` is set.
  [[nodiscard]] unsigned rays_of(unsigned lanes, int k) const {
    unsigned rays = 0;
    for (int i = 0; i < kMost; ++i) rays |= (lanes >> (4 * i + k) & 1U) << ray_[i];
    return rays;
  }

  /// Of each ray the number that is its own among a group's, four times.
  [[gnu::always_inline]] Floats<kLanes> operator()(const float* group) const {
#if defined(ENCORE_AVX512)
    return {_mm512_permutexvar_ps(from_, Floats<kLanes>::load(group).v)};
#elif defined(__AVX2__)
    return {_mm256_insertf128_ps(_mm256_castps128_ps256(Floats<4>::all(group[ray_[0]]).v),
                                 Floats<4>::all(group[ray_[1]]).v, 1)};
#else
    return Floats<kLanes>::all(group[ray_[0]]);
#endif
  }
  /// The same for points, whose axes lie `stride` floats apart.
  [[gnu::always_inline]] Points<kLanes> points(const float* group, int stride) const {
    return {(*this)(group), (*this)(group + stride), (*this)(group + 2 * stride)};
  }

 private:
#if defined(ENCORE_AVX512)
  __m512i from_;
#endif
  int ray_[kMost] = {};
  unsigned lanes_;
};

/// Four numbers over and over.
[[gnu::always_inline]] inline Floats<kLanes> repeat_fours(const float* from) {
#if defined(ENCORE_AVX512)
  return {_mm512_broadcast_f32x4(_mm_loadu_ps(from))};
#elif defined(__AVX2__)
  return {_mm256_broadcast_ps(reinterpret_cast<const __m128*>(from))};
#else
  return Floats<kLanes>::load(from);
#endif
}

}  // namespace encore::accel::ENCORE_ISA
