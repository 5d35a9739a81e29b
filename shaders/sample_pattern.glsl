// Where in its pixel a camera ray goes through (twin of renderer/paths/sample_pattern.cpp, which
// says what this is; sample_pattern.h why).
uint mixed(uint value) {
  value ^= value >> 16u;
  value *= 0x85EBCA6Bu;
  value ^= value >> 13u;
  value *= 0xC2B2AE35u;
  value ^= value >> 16u;
  return value;
}

uint pixel_hash(ivec2 pixel, uint seed, uint dimension) {
  uint value = mixed(seed + 0x9E3779B9u * (dimension + 1u));
  value = mixed(value + uint(pixel.x));
  return mixed(value + uint(pixel.y));
}

uint sobol2(uint index) {
  uint sum = 0u;
  for (uint direction = 0x80000000u; index != 0u; index >>= 1u) {
    if ((index & 1u) != 0u) sum ^= direction;
    direction ^= direction >> 1u;
  }
  return sum;
}

// Exact, in single precision as in double.
double fraction(uint bits) {
  return double(float(bits >> 8u) * uintBitsToFloat(0x33800000u));  // 2^-24
}

// Of one of several samples.
dvec2 sample_offset(ivec2 pixel, uint number, uint seed) {
  return dvec2(fraction(bitfieldReverse(number) ^ pixel_hash(pixel, seed, 0u)),
               fraction(sobol2(number) ^ pixel_hash(pixel, seed, 1u)));
}
