#include "scene/samples/noise.h"

namespace encore::scene::samples {

namespace {

double unit(std::uint32_t h) {
  return double(h) / 4294967296.0;
}

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

/// Slope at a lattice point along `d`: one of the twelve directions to a cube's edge centres (four
/// of them twice, so that four bits choose).
double slope(std::uint32_t h, const Vec& d) {
  const std::uint32_t choice = h >> 28U;
  const double u = choice < 8U ? d.x : d.y;
  const double v = choice < 4U ? d.y : (choice == 12U || choice == 14U ? d.x : d.z);
  return ((choice & 1U) != 0U ? -u : u) + ((choice & 2U) != 0U ? -v : v);
}

}  // namespace

std::uint32_t hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9E3779B1U;
  // Each coordinate is folded in with its own odd factor, then all bits are mixed downwards.
  h ^= std::uint32_t(x) * 0x8DA6B343U;
  h ^= std::uint32_t(y) * 0xD8163841U;
  h ^= std::uint32_t(z) * 0xCB1AB31FU;
  h ^= h >> 16U;
  h *= 0x7FEB352DU;
  h ^= h >> 15U;
  h *= 0x846CA68BU;
  h ^= h >> 16U;
  return h;
}

double Dice::roll(double low, double high) {
  return mix(low, high, unit(hash(count_++, 0, 0, seed_)));
}

double gradient_noise(const Vec& p, std::uint32_t seed) {
  const Vec base(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const Vec f = p - base;
  const auto x = std::int32_t(base.x);
  const auto y = std::int32_t(base.y);
  const auto z = std::int32_t(base.z);
  const auto corner = [&](std::int32_t dx, std::int32_t dy, std::int32_t dz) {
    return slope(hash(x + dx, y + dy, z + dz, seed), f - Vec(dx, dy, dz));
  };
  const Vec t(fade(f.x), fade(f.y), fade(f.z));
  const double near_z = mix(mix(corner(0, 0, 0), corner(1, 0, 0), t.x),
                            mix(corner(0, 1, 0), corner(1, 1, 0), t.x), t.y);
  const double far_z = mix(mix(corner(0, 0, 1), corner(1, 0, 1), t.x),
                           mix(corner(0, 1, 1), corner(1, 1, 1), t.x), t.y);
  return mix(near_z, far_z, t.z);
}

double fractal_noise(const Vec& p, int octaves, std::uint32_t seed) {
  double sum = 0.0;
  double height = 1.0;
  Vec q = p;
  for (int i = 0; i < octaves; ++i) {
    sum += height * gradient_noise(q, seed + std::uint32_t(i));
    height *= 0.5;
    q = q * 2.0;
  }
  return sum;
}

Cellular cellular_noise(const Vec& p, std::uint32_t seed) {
  const auto x = std::int32_t(std::floor(p.x));
  const auto y = std::int32_t(std::floor(p.y));
  const auto z = std::int32_t(std::floor(p.z));
  double nearest = 1e9;
  double second = 1e9;
  for (std::int32_t i = 0; i < 27; ++i) {
    const std::int32_t cx = x + i % 3 - 1;
    const std::int32_t cy = y + i / 3 % 3 - 1;
    const std::int32_t cz = z + i / 9 - 1;
    // Three ten-bit slices of one hash place the point within its cell.
    const std::uint32_t h = hash(cx, cy, cz, seed);
    const Vec point(cx + double(h & 1023U) / 1024.0, cy + double((h >> 10U) & 1023U) / 1024.0,
                    cz + double((h >> 20U) & 1023U) / 1024.0);
    const Vec d = p - point;
    const double squared = dot(d, d);
    if (squared < nearest) {
      second = nearest;
      nearest = squared;
    } else if (squared < second) {
      second = squared;
    }
  }
  return {std::sqrt(nearest), std::sqrt(second)};
}

}  // namespace encore::scene::samples
