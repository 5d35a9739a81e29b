#include "energy/battery_life/exponential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace encore::energy {
namespace {

/// (1 - e^-x) / x and its complement by the series in extended precision, good for x up to 20.
long double series_decay(long double x) {
  long double term = 1.0L;
  long double sum = 0.0L;
  for (int n = 2; n < 200; ++n) {
    sum += term;
    term *= -x / n;
  }
  return sum;
}

long double series_rise(long double x) {
  long double term = x / 2.0L;
  long double sum = 0.0L;
  for (int n = 3; n < 200; ++n) {
    sum += term;
    term *= -x / n;
  }
  return sum;
}

TEST(Exponential, AgreesWithTheSeriesInExtendedPrecision) {
  for (double x = 1e-18; x < 8.0; x *= 1.37) {
    const auto decay = static_cast<double>(series_decay(x));
    const auto rise = static_cast<double>(series_rise(x));
    EXPECT_NEAR(mean_decay(x) / decay, 1.0, 1e-15) << x;
    EXPECT_NEAR(mean_rise(x) / rise, 1.0, 2e-15) << x;
  }
}

TEST(Exponential, TheComplementIsSmoothWhereTheFormulaChanges) {
  const double below = std::nextafter(1.0, 0.0);
  EXPECT_NEAR(mean_rise(below), mean_rise(1.0), 1e-15);
}

TEST(Exponential, EndsAreExact) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(mean_decay(0.0), 1.0);
  EXPECT_EQ(mean_rise(0.0), 0.0);
  EXPECT_EQ(mean_decay(kInfinity), 0.0);
  EXPECT_EQ(mean_rise(kInfinity), 1.0);
  EXPECT_EQ(mean_rise(std::numeric_limits<double>::denorm_min() * 4),
            std::numeric_limits<double>::denorm_min() * 2);
}

TEST(Exponential, ApproachTakesEveryTimeConstant) {
  EXPECT_EQ(approach(1.0, 0.0), 1.0);
  EXPECT_EQ(approach(0.0, 0.0), 0.0);
  EXPECT_EQ(approach(1e-3, 1e-9), 1.0);
  EXPECT_NEAR(approach(1e-3, 1e9) / (1e-12 - 0.5e-24), 1.0, 1e-15);
  EXPECT_DOUBLE_EQ(approach(2.0, 2.0), 1.0 - std::exp(-1.0));
}

}  // namespace
}  // namespace encore::energy
