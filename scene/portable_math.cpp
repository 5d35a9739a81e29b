#include "scene/portable_math.h"

#include <cmath>
#include <limits>

namespace encore::scene {
namespace {

// pi/2 as a sum of three parts; the first two have 33 significant bits, so that their products
// with a quadrant number below 2^20 are exact.
constexpr double kHalfPiHigh = 0x1.921fb544p+0;
constexpr double kHalfPiMiddle = 0x1.0b4611a6p-34;
constexpr double kHalfPiLow = 0x1.3198a2e037073p-69;
constexpr double kLargestExact = 1e6;

/// An angle as quadrant * pi/2 + rest, with rest in [-pi/4, pi/4] and quadrant in 0..3.
struct Reduced {
  int quadrant;
  double rest;
};

Reduced reduce(double x) {
  if (std::fabs(x) > kLargestExact) x = std::fmod(x, 2.0 * kPi);
  const double n = std::floor(x * (2.0 / kPi) + 0.5);
  const double rest = ((x - n * kHalfPiHigh) - n * kHalfPiMiddle) - n * kHalfPiLow;
  return {static_cast<int>(static_cast<long long>(n) & 3), rest};
}

/// Taylor series up to x^15; the next term is below 5e-17 for |x| <= pi/4.
double sin_near_zero(double x) {
  const double s = x * x;
  double sum = 1.0;
  for (int k = 14; k >= 2; k -= 2) sum = 1.0 - s * sum / (k * (k + 1.0));
  return x * sum;
}

/// Taylor series up to x^16; the next term is below 1e-17 for |x| <= pi/4.
double cos_near_zero(double x) {
  const double s = x * x;
  double sum = 1.0;
  for (int k = 15; k >= 1; k -= 2) sum = 1.0 - s * sum / (k * (k + 1.0));
  return sum;
}

double sin_of_quadrant(int quadrant, double rest) {
  switch (quadrant & 3) {
    case 0:
      return sin_near_zero(rest);
    case 1:
      return cos_near_zero(rest);
    case 2:
      return -sin_near_zero(rest);
    default:
      return -cos_near_zero(rest);
  }
}

/// An angle in degrees, reduced without error: fmod and the subtraction are exact.
Reduced reduce_degrees(double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  const double n = std::floor(turn / 90.0 + 0.5);
  return {static_cast<int>(n) & 3, (turn - n * 90.0) * (kPi / 180.0)};
}

/// Arc sine for 0 <= x <= 1/2 by its series; the terms shrink by more than 4 each.
double asin_of_small(double x) {
  const double s = x * x;
  double term = x;
  double sum = x;
  for (int n = 0; n < 25; ++n) {
    const double odd = 2.0 * n + 1.0;
    term *= s * odd * odd / ((odd + 1.0) * (odd + 2.0));
    sum += term;
  }
  return sum;
}

}  // namespace

double portable_sin(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  const Reduced r = reduce(x);
  return sin_of_quadrant(r.quadrant, r.rest);
}

double portable_cos(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  const Reduced r = reduce(x);
  return sin_of_quadrant(r.quadrant + 1, r.rest);
}

double portable_sin_degrees(double degrees) {
  if (!std::isfinite(degrees)) return std::numeric_limits<double>::quiet_NaN();
  const Reduced r = reduce_degrees(degrees);
  return sin_of_quadrant(r.quadrant, r.rest) + 0.0;  // -0 becomes 0
}

double portable_cos_degrees(double degrees) {
  if (!std::isfinite(degrees)) return std::numeric_limits<double>::quiet_NaN();
  const Reduced r = reduce_degrees(degrees);
  return sin_of_quadrant(r.quadrant + 1, r.rest) + 0.0;
}

double portable_acos(double x) {
  if (std::isnan(x)) return x;
  if (x >= 1.0) return 0.0;
  if (x <= -1.0) return kPi;
  // Near the ends the half-angle form keeps the argument of the series small and accurate.
  if (x > 0.5) return 2.0 * asin_of_small(std::sqrt((1.0 - x) * 0.5));
  if (x < -0.5) return kPi - 2.0 * asin_of_small(std::sqrt((1.0 + x) * 0.5));
  return x >= 0.0 ? kPi * 0.5 - asin_of_small(x) : kPi * 0.5 + asin_of_small(-x);
}

}  // namespace encore::scene
