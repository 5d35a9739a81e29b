#pragma once

#include <cstdint>

namespace encore::app::bench {

/// Numbers that look random and depend on seed and place alone (Steele, Lea and Flood 2014).
inline std::uint64_t scramble(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ x >> 30U) * 0xBF58476D1CE4E5B9U;
  x = (x ^ x >> 27U) * 0x94D049BB133111EBU;
  return x ^ x >> 31U;
}

/// In [0, 1), of 24 bits.
inline float random_unit(std::uint64_t seed, std::uint64_t place) {
  return static_cast<float>(scramble(scramble(seed) ^ place) >> 40U) * 0x1p-24F;
}

}  // namespace encore::app::bench
