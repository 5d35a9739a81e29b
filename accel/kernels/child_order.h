#pragma once

#include "accel/simd/floats.h"
#include "accel/wide/wide_tree.h"

#include <cstdint>

namespace encore::accel::ENCORE_ISA {

/// Puts the children that are met onto a stack, the nearest one last, and returns how many there
/// are. What lies behind them, up to eight places, is overwritten.
///
/// A child goes by its distance without the last three bits, in which its number stands: so order
/// is the same with every instruction set, and distances are never too large.
[[gnu::always_inline]] inline std::uint32_t push_in_order(const Floats<8>& enter,
                                                          const Mask<8>& met,
                                                          const std::uint32_t* children,
                                                          float* enters, std::uint32_t* places) {
  constexpr std::uint32_t kNumber = 7;
#if defined(__AVX2__)
  const auto count = static_cast<std::uint32_t>(__builtin_popcount(met.bits()));
  const __m256i numbers = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i not_met = _mm256_set1_epi32(-0x7FFFFFFF - 1);
  // No distance but -0 could be taken for a child that is not met.
  __m256i key = _mm256_castps_si256(enter.v);
  key = _mm256_or_si256(_mm256_andnot_si256(_mm256_set1_epi32(kNumber), key), numbers);
#if defined(ENCORE_AVX512)
  key = _mm256_mask_compress_epi32(not_met, static_cast<__mmask8>(met.m), key);
#define ENCORE_SORT_STEP(SHUFFLED, LOWER)                                         \
  {                                                                               \
    const __m256i other = SHUFFLED;                                               \
    key = _mm256_mask_min_epi32(_mm256_max_epi32(key, other), LOWER, key, other); \
  }
#else
  key = _mm256_blendv_epi8(not_met, key, _mm256_castps_si256(met.m));
#define ENCORE_SORT_STEP(SHUFFLED, LOWER)                                                        \
  {                                                                                              \
    const __m256i other = SHUFFLED;                                                              \
    key = _mm256_blend_epi32(_mm256_max_epi32(key, other), _mm256_min_epi32(key, other), LOWER); \
  }
#endif
  // A bitonic network (Batcher 1968), the largest first.
  ENCORE_SORT_STEP(_mm256_shuffle_epi32(key, 0xB1), 0xAA)
  ENCORE_SORT_STEP(_mm256_shuffle_epi32(key, 0x1B), 0xCC)
  ENCORE_SORT_STEP(_mm256_shuffle_epi32(key, 0xB1), 0xAA)
#if defined(ENCORE_AVX512)
  // Four at most stand in one half.
  if (count > 4) [[unlikely]]
#endif
  {
    ENCORE_SORT_STEP(_mm256_permutevar8x32_epi32(key, _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0)),
                     0xF0)
    ENCORE_SORT_STEP(_mm256_shuffle_epi32(key, 0x4E), 0xCC)
    ENCORE_SORT_STEP(_mm256_shuffle_epi32(key, 0xB1), 0xAA)
  }
#undef ENCORE_SORT_STEP
  const __m256i child = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(children));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(places), _mm256_permutevar8x32_epi32(child, key));
  _mm256_storeu_ps(enters,
                   _mm256_castsi256_ps(_mm256_andnot_si256(_mm256_set1_epi32(kNumber), key)));
  return count;
#else
  alignas(32) std::int32_t bits[8];
  enter.store(bits);
  std::uint32_t count = 0;
  for (unsigned left = met.bits(); left != 0; left &= left - 1) {
    const auto number = static_cast<std::uint32_t>(__builtin_ctz(left));
    const auto key =
        static_cast<std::int32_t>((static_cast<std::uint32_t>(bits[number]) & ~kNumber) | number);
    std::uint32_t place = count++;
    for (; place > 0 && static_cast<std::int32_t>(places[place - 1]) < key; --place) {
      places[place] = places[place - 1];
    }
    places[place] = static_cast<std::uint32_t>(key);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t key = places[i];
    enters[i] = __builtin_bit_cast(float, key & ~kNumber);
    places[i] = children[key & kNumber];
  }
  return count;
#endif
}

#if defined(__AVX2__) && !defined(ENCORE_AVX512)
/// For every mask the numbers of its bits, one a byte.
struct PackingTable {
  alignas(64) std::uint8_t numbers[256][8];

  constexpr PackingTable() : numbers{} {
    for (unsigned mask = 0; mask < 256; ++mask) {
      unsigned count = 0;
      for (unsigned bit = 0; bit < 8; ++bit) {
        if ((mask >> bit & 1U) != 0) numbers[mask][count++] = static_cast<std::uint8_t>(bit);
      }
    }
  }
};
inline constexpr PackingTable kPacking;
#endif

/// The same in the node's own order, for whoever takes any hit (accel/wide/wide_child_order.h).
[[gnu::always_inline]] inline std::uint32_t push_as_they_are(const Mask<8>& met,
                                                             const std::uint32_t* children,
                                                             std::uint32_t* places) {
  const unsigned bits = met.bits();
#if defined(ENCORE_AVX512)
  _mm256_storeu_si256(
      reinterpret_cast<__m256i*>(places),
      _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits),
                                  _mm256_loadu_si256(reinterpret_cast<const __m256i*>(children))));
  return static_cast<std::uint32_t>(__builtin_popcount(bits));
#elif defined(__AVX2__)
  const __m256i order = _mm256_cvtepu8_epi32(
      _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kPacking.numbers[bits])));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(places),
                      _mm256_permutevar8x32_epi32(
                          _mm256_loadu_si256(reinterpret_cast<const __m256i*>(children)), order));
  return static_cast<std::uint32_t>(__builtin_popcount(bits));
#else
  std::uint32_t count = 0;
  for (unsigned left = bits; left != 0; left &= left - 1) {
    places[count++] = children[__builtin_ctz(left)];
  }
  return count;
#endif
}

}  // namespace encore::accel::ENCORE_ISA
