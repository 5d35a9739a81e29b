#include "energy/convergence/required_time.h"

#include "energy/convergence/correlation.h"
#include "tests/convergence/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace encore::energy {
namespace {

TEST(RequiredTime, EdgesOfOnePercentTake41UpdatePeriods) {
  EXPECT_NEAR(edge_bound(Seconds(0.001), 0.01).value, 0.041, 0.0005);  // RAPL
  EXPECT_NEAR(edge_bound(Seconds(0.1), 0.01).value, 4.1, 0.05);        // NVML
  EXPECT_NEAR(edge_bound(Seconds(4.0), 0.01).value, 163.0, 0.5);       // a battery
  EXPECT_DOUBLE_EQ(edge_error(Seconds(4.0), edge_bound(Seconds(4.0), 0.01)), 0.01);
}

TEST(RequiredTime, EdgeErrorIsThatOfTwoUniformEnds) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> late(0.0, 4.0);
  double squares = 0.0;
  constexpr int kRuns = 100000;
  for (int i = 0; i < kRuns; ++i) squares += std::pow((late(random) - late(random)) / 100.0, 2);
  EXPECT_NEAR(std::sqrt(squares / kRuns) / edge_error(Seconds(4), Seconds(100)), 1.0, 0.01);
}

TEST(RequiredTime, ScatterAloneFollowsTheFormula) {
  Pilot pilot;
  pilot.spacing = Seconds(4.0);
  pilot.relative_sd = 0.05;
  pilot.inflation = 2.2;
  pilot.settle = Seconds(12.0);
  const double z = 1.959963984540054;
  EXPECT_NEAR(required_time(pilot, 0.01).value, 4.0 * 2.2 * std::pow(z * 0.05 / 0.01, 2) + 12.0,
              1e-9);
}

TEST(RequiredTime, IsTheTimeAfterWhichTheTargetIsExpected) {
  Pilot pilot;
  pilot.spacing = Seconds(4.0);
  pilot.relative_sd = 0.03;
  pilot.inflation = 1.5;
  pilot.edge = Seconds(4.0);
  pilot.floor = 0.002;
  pilot.settle = Seconds(6.0);
  for (const double target : {0.005, 0.01, 0.1}) {
    const Seconds needed = required_time(pilot, target);
    EXPECT_NEAR(expected_half_width(pilot, needed), target, 1e-12);
    EXPECT_GT(needed, edge_bound(pilot.edge, target / 1.96) + pilot.settle);
  }
  EXPECT_TRUE(std::isinf(expected_half_width(pilot, Seconds(6.0))));
}

TEST(RequiredTime, NothingReachesBelowTheFloor) {
  Pilot pilot;
  pilot.spacing = Seconds(1.0);
  pilot.relative_sd = 0.01;
  pilot.floor = 0.01;
  EXPECT_TRUE(std::isinf(required_time(pilot, 0.019).value));
  EXPECT_TRUE(std::isfinite(required_time(pilot, 0.02).value));
  EXPECT_TRUE(std::isinf(required_time(pilot, 0.0).value));
}

TEST(RequiredTime, PilotTakesItsFiguresFromTheEstimate) {
  const std::vector<double> values{2, 4, 4, 4, 5, 5, 7, 9};
  const auto pilot = pilot_of(estimate_mean(values), Seconds(16));
  ASSERT_TRUE(pilot);
  EXPECT_DOUBLE_EQ(pilot->spacing.value, 2.0);
  EXPECT_DOUBLE_EQ(pilot->inflation, 1.0);
  EXPECT_NEAR(pilot->relative_sd, std::sqrt(32.0 / 7.0) / 5.0, 1e-9);
  EXPECT_FALSE(pilot_of(estimate_mean(std::vector<double>{1.0}), Seconds(1)));
  EXPECT_FALSE(pilot_of(estimate_mean(std::vector<double>{-1.0, 1.0}), Seconds(1)));
}

TEST(RequiredTime, PilotOfACorrelatedSeriesPredictsWithinAFactorOfTwo) {
  for (const double phi : {0.0, 0.5, 0.8}) {
    int good = 0;
    constexpr int kRuns = 300;
    const double inflation = (1.0 + phi) / (1.0 - phi);
    const auto samples = static_cast<std::size_t>(150 * inflation);
    const double needed = inflation * std::pow(1.96 * 0.1 / 0.005, 2);
    for (unsigned run = 0; run < kRuns; ++run) {
      auto values = test::Ar1(phi, run).take(samples);
      for (double& value : values) value = 1.0 + 0.1 * value;
      const auto pilot = pilot_of(cautious_mean(values, {}), Seconds(static_cast<double>(samples)));
      const double ratio = required_time(*pilot, 0.005).value / needed;
      good += ratio > 0.5 && ratio < 2.0 ? 1 : 0;
    }
    EXPECT_GE(good, kRuns * 90 / 100) << phi;
  }
}

}  // namespace
}  // namespace encore::energy
