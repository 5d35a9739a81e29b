#pragma once

#include "accel/build_watch.h"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace encore::accel {

/// Maps finite floats to integers in the same order; -0 and +0 are the same key.
inline std::uint32_t key_of_float(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0F);
  const std::uint32_t sign = 0U - (bits >> 31);  // all ones if negative
  return bits ^ (sign | 0x80000000U);
}
inline float float_of_key(std::uint32_t key) {
  const std::uint32_t positive = 0U - (key >> 31);
  return std::bit_cast<float>(key ^ (~positive | 0x80000000U));
}

/// Sorts keys ascending. `spare` has room for `count` more and is overwritten. Long lists are
/// sorted by digits (least significant first, digits that all keys share skipped) in O(count). A
/// meter may end the work by BuildCancelled, which leaves the keys in disorder.
void sort_keys(std::uint32_t* keys, std::uint32_t* spare, std::size_t count,
               BuildMeter* meter = nullptr);

}  // namespace encore::accel
