#include "renderer/portable_power.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace encore::renderer {

namespace {

/// log2 of a positive, finite number.
double log2_of(double x) {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  // Split into 2^exponent and a mantissa in [1, 2), then move that around 1.
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52U) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFULL) | 0x3FF0000000000000ULL);
  if (mantissa > 1.4142135623730951) {
    mantissa *= 0.5;
    ++exponent;
  }
  // ln m = 2 artanh(s) with |s| <= 0.172: eleven terms of the series leave less than 1e-17.
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  const double s2 = s * s;
  double sum = 0.0;
  for (int k = 21; k >= 1; k -= 2) sum = sum * s2 + 1.0 / k;
  constexpr double kTwoOverLn2 = 2.8853900817779268;
  return exponent + s * sum * kTwoOverLn2;
}

/// 2^y for any y.
double exp2_of(double y) {
  if (y >= 1024.0) return std::numeric_limits<double>::infinity();
  if (y < -1022.0) return 0.0;
  const double whole = std::floor(y + 0.5);
  constexpr double kLn2 = 0.6931471805599453;
  const double x = (y - whole) * kLn2;
  // The exponential series on |x| <= 0.347; the term of x^14 is below 1e-17.
  double sum = 1.0;
  for (int k = 13; k >= 1; --k) sum = sum * x * (1.0 / k) + 1.0;
  // 2^1024 has no bit pattern of its own although sum / 2 * 2^1024 may be finite: scale in two
  // steps.
  const auto half = static_cast<int>(whole) / 2;
  const auto power_of_two = [](int n) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52U);
  };
  return sum * power_of_two(half) * power_of_two(static_cast<int>(whole) - half);
}

/// base^exponent by repeated squaring: at most 20 multiplications.
double whole_power(double base, unsigned exponent) {
  double power = (exponent & 1U) != 0 ? base : 1.0;
  for (exponent >>= 1U; exponent != 0; exponent >>= 1U) {
    base *= base;
    if ((exponent & 1U) != 0) power *= base;
  }
  return power;
}

}  // namespace

double portable_power(double base, double exponent) {
  if (!(base >= 0.0)) return std::numeric_limits<double>::quiet_NaN();
  // Phong exponents are nearly always small whole numbers.
  constexpr double kLargestWhole = 1023.0;
  if (exponent >= 0.0 && exponent <= kLargestWhole) {
    const auto whole = static_cast<unsigned>(exponent);
    if (static_cast<double>(whole) == exponent) return whole_power(base, whole);
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (base == 0.0) return exponent > 0.0 ? 0.0 : kInfinity;
  if (base == kInfinity) return exponent > 0.0 ? kInfinity : 0.0;
  return exp2_of(exponent * log2_of(base));
}

}  // namespace encore::renderer
