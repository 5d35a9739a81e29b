#include "energy/convergence/convergence.h"

#include "tests/convergence/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace encore::energy {
namespace {

constexpr auto kTime = ConvergenceQuantity::time_per_operation;
constexpr auto kWatts = ConvergenceQuantity::watts;
constexpr auto kJoules = ConvergenceQuantity::joules_per_operation;

SourceInfo counter(double update) {
  SourceInfo info;
  info.update_period = Seconds(update);
  info.poll_period = Seconds(update);
  return info;
}

TracePoint at(double time, double joules) {
  TracePoint point;
  point.time = Seconds(time);
  point.energy = Joules(joules);
  return point;
}

TEST(Convergence, WordsAndUnits) {
  EXPECT_EQ(to_string(kTime), "time_per_operation");
  EXPECT_EQ(to_string(kWatts), "watts");
  EXPECT_EQ(to_string(kJoules), "joules_per_operation");
  EXPECT_EQ(unit_of(kTime), "s");
  EXPECT_EQ(unit_of(kJoules), "J");
}

TEST(Convergence, EqualRowsAreKnownExactly) {
  ConvergenceTracker tracker(Seconds(100));
  for (int i = 1; i <= 64; ++i) tracker.add_row(Seconds(100 + 0.25 * i), 2.0, Seconds(0.125));
  const auto& latest = tracker.latest(kTime);
  ASSERT_TRUE(latest);
  EXPECT_DOUBLE_EQ(latest->point.mean, 0.125);
  EXPECT_NEAR(*latest->point.half_width, 0.0, 1e-15);
  EXPECT_FALSE(tracker.latest(kWatts));
}

TEST(Convergence, PointsComeAtTimesThatGrowByATenth) {
  ConvergenceTracker tracker(Seconds(0));
  for (int i = 1; i <= 10000; ++i) tracker.add_row(Seconds(0.01 * i), 1.0, Seconds(0.01));
  const auto& points = tracker.points();
  // ln(10000) / ln(1.1) = 97, fewer at the start, where a row is more than a tenth.
  EXPECT_GE(points.size(), 70U);
  EXPECT_LE(points.size(), 98U);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_GE(points[i].elapsed.value, 1.1 * points[i - 1].elapsed.value * (1 - 1e-12));
  }
}

TEST(Convergence, MeansAreOverOperationsNotRows) {
  ConvergenceTracker tracker(Seconds(0));
  tracker.add_row(Seconds(3), 3.0, Seconds(1));
  tracker.add_row(Seconds(7), 1.0, Seconds(4));
  EXPECT_DOUBLE_EQ(tracker.latest(kTime)->point.mean, 7.0 / 4.0);
}

TEST(Convergence, MemoryStaysBoundedAndTheMeanExactOverAMillionRows) {
  ConvergenceTracker tracker(Seconds(0), counter(0.001));
  test::Ar1 noise(0.5, 9);
  double clock = 0.0;
  double joules = 0.0;
  std::size_t most = 0;
  int assessments = 0;
  for (int i = 0; i < 1000000; ++i) {
    const double row = 0.01 * (1.0 + 0.1 * noise.next());
    clock += row;
    joules += 30.0 * row;
    tracker.add_energy(at(clock, joules));
    if (tracker.add_row(Seconds(clock), 4.0, Seconds(row / 4.0))) ++assessments;
    most = std::max(most, tracker.kept());
  }
  EXPECT_LE(assessments, 130);
  EXPECT_LE(most, 3 * 512U + 3 * 130U + 8U);
  const auto& time = tracker.latest(kTime)->point;
  EXPECT_NEAR(time.mean, 0.0025, *time.half_width);
  EXPECT_NEAR(*time.relative / (1.96 * 0.1 * std::sqrt(3.0 * 0.01 / time.elapsed.value)), 1.0, 0.5);
  EXPECT_NEAR(tracker.latest(kWatts)->point.mean, 30.0, 1e-6);
  EXPECT_NEAR(tracker.latest(kJoules)->point.mean, 30.0 * 0.0025, 30.0 * *time.half_width);
}

TEST(Convergence, EdgesOfTheSensorsPeriodWidenEnergies) {
  // Constant power, 100 s, an update each second: nothing but the edges is unsure.
  ConvergenceTracker tracker(Seconds(0), counter(1.0));
  for (int i = 0; i <= 100; ++i) {
    tracker.add_energy(at(i, 30.0 * i));
    if (i > 0) tracker.add_row(Seconds(i), 5.0, Seconds(0.2));
  }
  const auto& point = tracker.latest(kJoules)->point;
  EXPECT_NEAR(point.mean, 6.0, 1e-9);
  EXPECT_NEAR(*point.relative, 1.96 / (point.elapsed.value * std::sqrt(6.0)), 1e-4);
}

TEST(Convergence, GaugeStepsAreAFloorAndCounterStepsAreNot) {
  SourceInfo gauge = counter(0.1);
  gauge.is_counter = false;
  gauge.power_step = Watts(1.0);
  SourceInfo steps = counter(0.001);
  steps.energy_step = Joules(3.0);  // the time to fill it: 0.1 s
  for (const SourceInfo& source : {gauge, steps}) {
    ConvergenceTracker tracker(Seconds(0), source);
    for (int i = 0; i <= 1000; ++i) {
      tracker.add_energy(at(0.1 * i, 3.0 * i));
      if (i > 0) tracker.add_row(Seconds(0.1 * i), 1.0, Seconds(0.1));
    }
    const auto& latest = tracker.latest(kWatts);
    EXPECT_NEAR(latest->pilot->edge.value, 0.1, 1e-4);
    EXPECT_NEAR(latest->pilot->floor, source.is_counter ? 0.0 : 1.0 / 30.0 / std::sqrt(12.0), 1e-9);
  }
}

TEST(Convergence, TheSameDataIsNotAssessedTwice) {
  // An update each 50 s: between them rows bring new points of time only.
  ConvergenceTracker tracker(Seconds(0), counter(50.0));
  for (int i = 1; i <= 2000; ++i) {
    if (i % 500 == 0) tracker.add_energy(at(0.1 * i, 3.0 * i));
    tracker.add_row(Seconds(0.1 * i), 1.0, Seconds(0.1));
  }
  const auto is_watts = [](const ConvergencePoint& p) { return p.quantity == kWatts; };
  EXPECT_LE(std::count_if(tracker.points().begin(), tracker.points().end(), is_watts), 3);
}

TEST(Convergence, DriftAndAllanDeviationAreReported) {
  ConvergenceTracker tracker(Seconds(0));
  test::Ar1 noise(0.0, 3);
  double clock = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double row = 0.01 * (1.0 + 0.01 * noise.next() + 0.002 * clock);
    clock += row;
    tracker.add_row(Seconds(clock), 1.0, Seconds(row));
  }
  const auto& point = tracker.latest(kTime)->point;
  ASSERT_TRUE(point.drift_per_second);
  EXPECT_NEAR(*point.drift_per_second, 2e-5, 1e-6);
  ASSERT_TRUE(point.allan_deviation);
  EXPECT_GT(point.allan_window->value, 1.0);
  // Means over m rows scatter by 1 % / sqrt(m) and drift by 0.2 % / s * 0.01 s * m: even at
  // m^3 = (0.01 / 0.00002)^2, which is 63 rows or 0.63 s, in powers of two of blocks of 8.
  const auto window = tracker.longest_useful_window(kTime);
  ASSERT_TRUE(window);
  EXPECT_GT(window->value, 0.3);
  EXPECT_LT(window->value, 1.4);
}

}  // namespace
}  // namespace encore::energy
