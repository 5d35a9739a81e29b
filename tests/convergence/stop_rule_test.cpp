#include "energy/convergence/stop_rule.h"

#include "tests/convergence/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

namespace encore::energy {
namespace {

constexpr double kRow = 0.01;

/// Rows whose times are an AR(1) series of this relative deviation about kRow, until the rule
/// stops; nothing if it does not in 200000 rows.
struct Stopped {
  double rows = 0.0;
  ConvergencePoint point;
  std::optional<double> early_prediction;  ///< s, at the first assessment after `pilot_rows`
};
std::optional<Stopped> run_until(const StopRule& rule, double phi, double deviation, unsigned seed,
                                 int pilot_rows = 0) {
  ConvergenceTracker tracker(Seconds(0));
  test::Ar1 noise(phi, seed);
  Stopped stopped;
  double clock = 0.0;
  for (int i = 1; i <= 200000; ++i) {
    const double row = kRow * (1.0 + deviation * noise.next());
    clock += row;
    if (!tracker.add_row(Seconds(clock), 1.0, Seconds(row))) continue;
    const StopOutlook now = outlook(rule, tracker);
    if (i >= pilot_rows && !stopped.early_prediction && now.predicted) {
      stopped.early_prediction = now.predicted->value;
    }
    if (now.state != StopState::reached) continue;
    stopped.rows = i;
    stopped.point = tracker.latest(rule.quantity)->point;
    return stopped;
  }
  return std::nullopt;
}

TEST(StopRule, IntervalAtTheStopStaysHonest) {
  StopRule rule;
  rule.target = 0.01;
  constexpr int kRuns = 500;
  for (const double phi : {0.0, 0.5, 0.8}) {
    int held = 0;
    for (unsigned run = 0; run < kRuns; ++run) {
      const auto stopped = run_until(rule, phi, 0.03, 1000 + run);
      ASSERT_TRUE(stopped);
      EXPECT_LE(*stopped->point.relative, rule.target);
      EXPECT_GE(stopped->point.effective_samples, rule.least_effective_samples);
      held += std::fabs(stopped->point.mean - kRow) <= *stopped->point.half_width ? 1 : 0;
    }
    EXPECT_GE(held, kRuns * 92 / 100) << phi;
  }
}

TEST(StopRule, QuietSeriesWaitForEnoughSamples) {
  StopRule rule;
  rule.target = 0.05;
  const auto stopped = run_until(rule, 0.0, 0.001, 1);
  ASSERT_TRUE(stopped);
  EXPECT_GE(stopped->rows, 40.0);
  EXPECT_LE(stopped->rows, 60.0);
}

TEST(StopRule, PredictsTheStopWithinAFactorOfTwo) {
  StopRule rule;
  rule.target = 0.01;
  for (const double phi : {0.0, 0.5}) {
    int good = 0;
    constexpr int kRuns = 100;
    const double inflation = (1.0 + phi) / (1.0 - phi);
    for (unsigned run = 0; run < kRuns; ++run) {
      const auto pilot = static_cast<int>(100 * inflation);
      const auto stopped = run_until(rule, phi, 0.07, 5000 + run, pilot);
      ASSERT_TRUE(stopped && stopped->early_prediction);
      const double ratio = *stopped->early_prediction / stopped->point.elapsed.value;
      good += ratio > 0.5 && ratio < 2.0 ? 1 : 0;
    }
    EXPECT_GE(good, kRuns * 90 / 100) << phi;
  }
}

TEST(StopRule, OneNarrowIntervalIsNotEnough) {
  ConvergenceTracker tracker(Seconds(0));
  StopRule rule;
  rule.least_effective_samples = 4.0;
  StopState state = StopState::measuring;
  int met = 0;
  for (int i = 1; i <= 100 && state != StopState::reached; ++i) {
    if (!tracker.add_row(Seconds(i), 1.0, Seconds(1))) continue;
    if (tracker.latest(rule.quantity)->point.effective_samples >= 4.0) ++met;
    state = outlook(rule, tracker).state;
  }
  EXPECT_EQ(state, StopState::reached);
  EXPECT_EQ(met, 2);
}

TEST(StopRule, SaysWhenLittleIsKnown) {
  ConvergenceTracker tracker(Seconds(0));
  EXPECT_EQ(outlook({}, tracker).words, "nothing has been measured yet");
  tracker.add_row(Seconds(1), 1.0, Seconds(1));
  const StopOutlook one = outlook({}, tracker);
  EXPECT_EQ(one.state, StopState::measuring);
  EXPECT_EQ(one.words, "too few independent samples to tell how long");
  EXPECT_FALSE(one.predicted);
}

TEST(StopRule, BlamesADriftThatOutweighsAveraging) {
  ConvergenceTracker tracker(Seconds(0));
  test::Ar1 noise(0.0, 3);
  double clock = 0.0;
  while (clock < 100.0) {
    // 6 % a minute, and 10 % of scatter: even at cbrt(4 (1.96 * 0.1)^2 0.01 / 0.001^2) = 11.5 s.
    const double row = kRow * (1.0 + 0.1 * noise.next() + 0.001 * clock);
    clock += row;
    tracker.add_row(Seconds(clock), 1.0, Seconds(row));
  }
  StopRule rule;
  rule.target = 0.002;
  const StopOutlook now = outlook(rule, tracker);
  EXPECT_EQ(now.state, StopState::out_of_reach);
  EXPECT_FALSE(now.predicted);
  EXPECT_TRUE(now.words.starts_with("a drift of +")) << now.words;
  EXPECT_NE(now.words.find("%/min outweighs averaging beyond 1"), std::string::npos) << now.words;
  EXPECT_TRUE(now.words.ends_with("% at best; warm up longer, or measure in shorter windows"))
      << now.words;
}

/// A counter of constant power that updates every 4 s.
struct SlowSensor {
  ConvergenceTracker tracker;
  explicit SlowSensor(std::optional<Watts> step = std::nullopt, double seconds = 80.0)
      : tracker(Seconds(0), info(step)) {
    for (int i = 0; i <= seconds; ++i) {
      TracePoint point;
      point.time = Seconds(i);
      point.energy = Joules(30.0 * i);
      point.changed = i % 4 == 0;
      tracker.add_energy(point);
      if (i > 0) tracker.add_row(Seconds(i), 10.0, Seconds(0.1));
    }
  }
  static SourceInfo info(std::optional<Watts> step) {
    SourceInfo source;
    source.is_counter = false;
    source.update_period = Seconds(4.0);
    source.power_step = step;
    return source;
  }
};

TEST(StopRule, NamesTheSensorsPeriodWhereItDecides) {
  const SlowSensor sensor;
  StopRule rule;
  rule.quantity = ConvergenceQuantity::joules_per_operation;
  const StopOutlook now = outlook(rule, sensor.tracker);
  EXPECT_EQ(now.state, StopState::measuring);
  ASSERT_TRUE(now.predicted);
  // 1.96 * 4 s / (0.01 sqrt 6) = 320 s, with the rule's spare and second look some more.
  EXPECT_GT(now.predicted->value, 320.0);
  EXPECT_LT(now.predicted->value, 500.0);
  EXPECT_NE(now.words.find("(the sensor updates every 4 s: at least 32"), std::string::npos)
      << now.words;
}

TEST(StopRule, SaysWhenTheLimitComesFirst) {
  const SlowSensor sensor;
  StopRule rule;
  rule.quantity = ConvergenceQuantity::watts;
  rule.limit = Seconds(120);
  const StopOutlook now = outlook(rule, sensor.tracker);
  EXPECT_EQ(now.state, StopState::out_of_reach);
  EXPECT_NE(now.words.find("more than the limit of 120 s, which gives about ±2."),
            std::string::npos)
      << now.words;
  rule.limit = Seconds(50);
  EXPECT_TRUE(outlook(rule, sensor.tracker).words.starts_with("the limit of 50 s is over: ±"));
}

TEST(StopRule, SaysWhenTheSensorIsTooCoarse) {
  const SlowSensor sensor(Watts(3.0));
  StopRule rule;
  rule.quantity = ConvergenceQuantity::watts;
  const StopOutlook now = outlook(rule, sensor.tracker);
  EXPECT_EQ(now.state, StopState::out_of_reach);
  // 1.96 * 3 W / 30 W / sqrt 12.
  EXPECT_EQ(now.words, "the sensor's steps are too coarse: ±1 % is out of reach, ±5.66 % at best");
}

}  // namespace
}  // namespace encore::energy
