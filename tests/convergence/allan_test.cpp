#include "energy/convergence/allan.h"

#include "tests/convergence/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace encore::energy {
namespace {

TEST(Allan, EqualsTheFormulaOnFewValues) {
  const std::vector<double> values{1, 3, 2, 6, 4};
  const auto points = allan_deviation(values);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].m, 1U);
  EXPECT_EQ(points[0].pairs, 4U);
  EXPECT_DOUBLE_EQ(points[0].deviation, std::sqrt((4.0 + 1.0 + 16.0 + 4.0) / 8.0));
  EXPECT_EQ(points[1].m, 2U);
  EXPECT_EQ(points[1].pairs, 1U);
  EXPECT_DOUBLE_EQ(points[1].deviation, std::sqrt(2.0 * 2.0 / 2.0));
  EXPECT_TRUE(allan_deviation(std::vector<double>{1.0}).empty());
}

TEST(Allan, IndependentValuesFallAsTheRoot) {
  const auto points = allan_deviation(test::Ar1(0.0, 1).take(1U << 16U));
  for (const AllanPoint& point : points) {
    if (point.pairs < 100) break;
    const double expected = 1.0 / std::sqrt(static_cast<double>(point.m));
    EXPECT_NEAR(point.deviation / expected, 1.0, 4.0 * point.relative_error()) << point.m;
  }
  EXPECT_NEAR(*allan_slope(points), -0.5, 0.02);
}

TEST(Allan, DriftRisesInProportion) {
  constexpr double kStep = 0.25;
  std::vector<double> values(1024);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 7.0 + kStep * static_cast<double>(i);
  const auto points = allan_deviation(values);
  for (const AllanPoint& point : points) {
    EXPECT_DOUBLE_EQ(point.deviation, kStep * static_cast<double>(point.m) / std::sqrt(2.0));
  }
  EXPECT_NEAR(*allan_slope(points), 1.0, 1e-12);
}

TEST(Allan, RandomWalkEqualsTheClosedForm) {
  // Steps of variance 1: sigma^2(m) = (2 m^2 + 1) / (6 m).
  auto values = test::Ar1(0.0, 2).take(1U << 16U);
  for (std::size_t i = 1; i < values.size(); ++i) values[i] += values[i - 1];
  const auto points = allan_deviation(values);
  for (const AllanPoint& point : points) {
    if (point.pairs < 100) break;
    const auto m = static_cast<double>(point.m);
    const double expected = std::sqrt((2.0 * m * m + 1.0) / (6.0 * m));
    EXPECT_NEAR(point.deviation / expected, 1.0, 4.0 * point.relative_error()) << point.m;
  }
  EXPECT_NEAR(*allan_slope(points, 3), 0.5, 0.05);
}

TEST(Allan, MinimumLiesWhereDriftOvertakesScatter) {
  // sigma^2(m) = 1 / m + (d m)^2 / 2 is least at m^3 = 1 / d^2: 46 for d = 0.0032.
  auto values = test::Ar1(0.0, 3).take(8192);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 0.0032 * static_cast<double>(i);
  const auto minimum = allan_minimum(allan_deviation(values));
  ASSERT_TRUE(minimum);
  EXPECT_GE(minimum->m, 32U);
  EXPECT_LE(minimum->m, 64U);
}

TEST(Allan, SeriesWithoutDriftSeldomShowAMinimum) {
  int white = 0;
  int correlated = 0;
  constexpr int kRuns = 400;
  for (unsigned run = 0; run < kRuns; ++run) {
    white += allan_minimum(allan_deviation(test::Ar1(0.0, run).take(512))) ? 1 : 0;
    correlated += allan_minimum(allan_deviation(test::Ar1(0.8, run).take(512))) ? 1 : 0;
  }
  EXPECT_LE(white, kRuns / 100);
  EXPECT_LE(correlated, kRuns / 50);
  EXPECT_FALSE(allan_minimum({}));
}

}  // namespace
}  // namespace encore::energy
