// The ratio of two figures and its interval.
#include "app/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace encore::app {
namespace {

using Figures = std::vector<RunFigure>;

TEST(Change, RatioAndIntervalEqualTheClosedForms) {
  const FigureChange change =
      change_of(Figures{{10.0, 0.3}}, Figures{{8.0, 0.32}}, {}, std::nullopt);
  EXPECT_NEAR(change.ratio, 0.8, 1e-12);
  const double half = std::hypot(0.03, 0.04);
  EXPECT_NEAR(*change.low, 0.8 * std::exp(-half), 1e-12);
  EXPECT_NEAR(*change.high, 0.8 * std::exp(half), 1e-12);
  EXPECT_EQ(change.verdict, Verdict::lower);
}

TEST(Change, VerdictsFollowTheInterval) {
  const auto verdict = [](double b, std::optional<double> half) {
    return change_of(Figures{{10.0, 0.3}}, Figures{{b, half}}, {}, std::nullopt).verdict;
  };
  EXPECT_EQ(verdict(9.0, 0.3), Verdict::lower);
  EXPECT_EQ(verdict(11.0, 0.3), Verdict::higher);
  EXPECT_EQ(verdict(10.2, 0.3), Verdict::noise);
  EXPECT_EQ(verdict(10.2, 0.0), Verdict::noise);
  EXPECT_EQ(verdict(20.0, std::nullopt), Verdict::unknown);
}

TEST(Change, RegressionNeedsTheWholeIntervalBeyondTheTolerance) {
  const auto regression = [](double b, double half, std::optional<double> tolerance) {
    return change_of(Figures{{10.0, 0.0}}, Figures{{b, half}}, {}, tolerance).regression;
  };
  EXPECT_FALSE(regression(10.6, 0.0, std::nullopt));
  EXPECT_TRUE(regression(10.6, 0.0, 0.05));
  EXPECT_FALSE(regression(10.4, 0.0, 0.05));
  EXPECT_FALSE(regression(10.6, 0.2, 0.05)) << "1.06 times exp(-0.019) is below 1.05";
  EXPECT_TRUE(regression(10.6, 0.05, 0.05));
  EXPECT_FALSE(regression(5.0, 0.0, 0.05)) << "better is no regression";
}

TEST(Change, WithoutAnIntervalThereIsNoRegression) {
  const FigureChange change = change_of(Figures{{10.0, {}}}, Figures{{100.0, 1.0}}, {}, 0.05);
  EXPECT_FALSE(change.low);
  EXPECT_FALSE(change.regression);
}

TEST(Change, SpreadIsPooledOverConfigurations) {
  // Two groups whose logarithms differ by +-0.1 and +-0.2 about their means.
  const std::vector<Figures> groups{{{std::exp(0.1), {}}, {std::exp(-0.1), {}}},
                                    {{5.0 * std::exp(0.2), {}}, {5.0 * std::exp(-0.2), {}}},
                                    {{7.0, {}}},
                                    {}};
  const RunSpread spread = pool_spread(groups);
  EXPECT_EQ(spread.degrees_of_freedom, 2U);
  EXPECT_NEAR(spread.deviation, std::sqrt((0.02 + 0.08) / 2.0), 1e-12);
}

TEST(Change, SpreadBetweenRunsWidensTheInterval) {
  const Figures a{{10.0, 0.01}, {10.2, 0.01}, {9.8, 0.01}};
  const Figures b{{10.3, 0.01}, {10.5, 0.01}};
  EXPECT_EQ(change_of(a, b, {}, std::nullopt).verdict, Verdict::higher);
  const RunSpread spread{0.02, 3};
  const FigureChange change = change_of(a, b, spread, std::nullopt);
  EXPECT_EQ(change.verdict, Verdict::noise);
  // t(0.975, 3) = 3.182446305.
  EXPECT_NEAR(std::log(*change.high / change.ratio),
              3.182446305 * 0.02 * std::sqrt(1.0 / 3.0 + 1.0 / 2.0), 1e-9);
}

TEST(Change, IntervalHoldsTheTrueRatio95TimesIn100) {
  // Four configurations, three runs each, 3 % between runs and 1 % within.
  std::mt19937_64 random(21);
  std::normal_distribution<double> normal;
  int held = 0;
  constexpr int kTrials = 3000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Figures> groups;
    for (int group = 0; group < 8; ++group) {
      Figures runs;
      const double truth = group % 2 == 0 ? 10.0 : 12.0;
      for (int run = 0; run < 3; ++run) {
        const double off = 0.03 * normal(random) + 0.01 * normal(random);
        runs.push_back({truth * std::exp(off), 0.0196 * truth});
      }
      groups.push_back(std::move(runs));
    }
    const FigureChange change = change_of(groups[0], groups[1], pool_spread(groups), std::nullopt);
    held += *change.low <= 1.2 && 1.2 <= *change.high ? 1 : 0;
  }
  EXPECT_GE(held, 0.935 * kTrials);
  EXPECT_LE(held, 0.965 * kTrials);
}

}  // namespace
}  // namespace encore::app
