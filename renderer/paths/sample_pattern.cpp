#include "renderer/paths/sample_pattern.h"

namespace encore::renderer {

namespace {

/// Mixes 32 bits one to one (the last step of MurmurHash3, Appleby 2008): every bit of the result
/// depends on every bit of the value.
std::uint32_t mix(std::uint32_t value) {
  value ^= value >> 16U;
  value *= 0x85EBCA6BU;
  value ^= value >> 13U;
  value *= 0xC2B2AE35U;
  value ^= value >> 16U;
  return value;
}

/// Sums and products wrap at 2^32; x and y as two's complement.
std::uint32_t pixel_hash(int x, int y, std::uint32_t seed, std::uint32_t dimension) {
  std::uint32_t value = mix(seed + 0x9E3779B9U * (dimension + 1U));
  value = mix(value + static_cast<std::uint32_t>(x));
  return mix(value + static_cast<std::uint32_t>(y));
}

/// The bits of `index` in reverse.
std::uint32_t van_der_corput(std::uint32_t index) {
  index = (index << 16U) | (index >> 16U);
  index = ((index & 0x00FF00FFU) << 8U) | ((index & 0xFF00FF00U) >> 8U);
  index = ((index & 0x0F0F0F0FU) << 4U) | ((index & 0xF0F0F0F0U) >> 4U);
  index = ((index & 0x33333333U) << 2U) | ((index & 0xCCCCCCCCU) >> 2U);
  return ((index & 0x55555555U) << 1U) | ((index & 0xAAAAAAAAU) >> 1U);
}

/// The second dimension of Sobol's sequence: primitive polynomial x + 1, so that each direction
/// number is the one before xored with its half.
std::uint32_t sobol2(std::uint32_t index) {
  std::uint32_t sum = 0;
  for (std::uint32_t direction = 0x80000000U; index != 0U; index >>= 1U) {
    if ((index & 1U) != 0U) sum ^= direction;
    direction ^= direction >> 1U;
  }
  return sum;
}

/// Exact in single precision, too.
double fraction(std::uint32_t bits) {
  return static_cast<double>(bits >> 8U) * 0x1p-24;
}

}  // namespace

glm::dvec2 sample_offset(int x, int y, std::uint32_t sample, std::uint32_t samples,
                         std::uint32_t seed) {
  if (samples <= 1U) return {0.5, 0.5};
  return {fraction(van_der_corput(sample) ^ pixel_hash(x, y, seed, 0U)),
          fraction(sobol2(sample) ^ pixel_hash(x, y, seed, 1U))};
}

}  // namespace encore::renderer
