#include "energy/convergence/drift.h"

#include "tests/convergence/series.h"

#include <gtest/gtest.h>

#include <vector>

namespace encore::energy {
namespace {

std::vector<double> seconds(std::size_t count, double step = 1.0) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = 5.0 + step * static_cast<double>(i);
  return times;
}

TEST(Drift, AStraightLineIsFoundExactly) {
  const auto times = seconds(50, 0.5);
  std::vector<double> values;
  for (const double t : times) values.push_back(20.0 - 0.3 * t);
  const auto drift = linear_drift(times, values);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->per_second, -0.3, 1e-12);
  EXPECT_NEAR(drift->at_middle, 20.0 - 0.3 * (5.0 + 0.5 * 24.5), 1e-12);
  EXPECT_NEAR(drift->deviation, 0.0, 1e-9);
  EXPECT_TRUE(drift->significant);
}

TEST(Drift, EqualValuesDoNotDrift) {
  const auto drift = linear_drift(seconds(30), std::vector<double>(30, 0.1));
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->per_second, 0.0, 1e-15);
  EXPECT_FALSE(drift->significant);
}

TEST(Drift, FewValuesTellNothing) {
  EXPECT_FALSE(linear_drift(seconds(19), test::Ar1(0.0, 1).take(19)));
  EXPECT_FALSE(linear_drift(std::vector<double>(30, 1.0), test::Ar1(0.0, 1).take(30)));
}

TEST(Drift, SeriesWithoutDriftAreBlamedFiveTimesInAHundred) {
  struct Case {
    double phi;
    std::size_t samples;
  };
  for (const Case& c : {Case{0.0, 30}, Case{0.0, 500}, Case{0.5, 30}, Case{0.5, 200}, Case{0.8, 30},
                        Case{0.8, 500}, Case{0.95, 500}}) {
    int blamed = 0;
    int told = 0;
    const auto times = seconds(c.samples);
    for (unsigned run = 0; run < 1000; ++run) {
      const auto drift = linear_drift(times, test::Ar1(c.phi, run).take(c.samples));
      told += drift ? 1 : 0;
      blamed += drift && drift->significant ? 1 : 0;
    }
    EXPECT_LE(blamed, 80) << c.phi << ' ' << c.samples;
    if (c.phi < 0.7 && c.samples >= 200) {
      EXPECT_GE(told, 990) << c.phi << ' ' << c.samples;
    }
  }
}

TEST(Drift, IntervalHoldsTheSlope95TimesInAHundredAndFindsItWhenItMatters) {
  const auto times = seconds(400);
  int held = 0;
  int found = 0;
  for (unsigned run = 0; run < 500; ++run) {
    auto values = test::Ar1(0.5, run).take(400);
    // 400 s of it are three standard deviations.
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += 0.0075 * times[i];
    const auto drift = linear_drift(times, values);
    ASSERT_TRUE(drift);
    held += std::fabs(drift->per_second - 0.0075) <= drift->half_width ? 1 : 0;
    found += drift->significant ? 1 : 0;
  }
  EXPECT_GE(held, 500 * 92 / 100);
  EXPECT_GE(found, 500 * 95 / 100);
}

}  // namespace
}  // namespace encore::energy
