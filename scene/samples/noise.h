#pragma once

#include "scene/samples/vector_math.h"

#include <cstdint>

/// Seeded noise of integer hashing and IEEE basic operations only.
namespace encore::scene::samples {

/// A well mixed 32-bit hash of three lattice coordinates and a seed.
std::uint32_t hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

/// A small generator of reproducible choices: the n-th number of a seed.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : seed_(seed) {}
  /// The next number, uniform in [low, high). One roll a statement: the order in which arguments
  /// are evaluated is the compiler's choice.
  double roll(double low, double high);

 private:
  std::uint32_t seed_;
  std::int32_t count_ = 0;
};

/// Gradient noise with a lattice of spacing 1, about in [-1, 1], continuous to second order.
double gradient_noise(const Vec& p, std::uint32_t seed);

/// Sum of `octaves` gradient noises, each of twice the frequency and half the height.
double fractal_noise(const Vec& p, int octaves, std::uint32_t seed);

/// Distances to the nearest and second nearest of one random point a lattice cell.
struct Cellular {
  double nearest;
  double second;
};
Cellular cellular_noise(const Vec& p, std::uint32_t seed);

}  // namespace encore::scene::samples
