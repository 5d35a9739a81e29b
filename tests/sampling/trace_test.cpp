#include "energy/sampling/trace.h"

#include <gtest/gtest.h>

namespace encore::energy {
namespace {

Reading at(double time, double joules, bool changed = true) {
  return {Seconds(time), Joules(joules), std::nullopt, changed};
}

TEST(Trace, InterpolatesEnergyWithinAStretch) {
  Trace trace;
  trace.add(at(1, 0), false);
  trace.add(at(2, 10), false);
  trace.add(at(4, 50), false);
  const TraceView view = trace.view();
  EXPECT_DOUBLE_EQ(view.energy_between(Seconds(1), Seconds(4))->value, 50);
  EXPECT_DOUBLE_EQ(view.energy_between(Seconds(1.5), Seconds(3))->value, 25);
  EXPECT_DOUBLE_EQ(view.energy_between(Seconds(2), Seconds(2))->value, 0);
  EXPECT_FALSE(view.energy_between(Seconds(0.5), Seconds(2))) << "begins before the trace";
  EXPECT_FALSE(view.energy_between(Seconds(2), Seconds(4.1))) << "ends after the trace";
}

TEST(Trace, KeepsGapsAsGaps) {
  Trace trace;
  trace.add(at(1, 0), false);
  trace.add(at(2, 10), false);
  trace.add_gap();
  trace.add(at(5, 11), false);
  trace.add(at(6, 21), false);
  trace.add(at(7, 22), true);  // a counter reset
  trace.add(at(8, 32), false);
  const TraceView view = trace.view();
  EXPECT_FALSE(view.energy_between(Seconds(1), Seconds(6)));
  EXPECT_FALSE(view.energy_between(Seconds(3), Seconds(4)));
  EXPECT_FALSE(view.energy_between(Seconds(2), Seconds(5)));
  EXPECT_DOUBLE_EQ(view.energy_between(Seconds(5), Seconds(6))->value, 10);
  EXPECT_FALSE(view.energy_between(Seconds(6), Seconds(7)));
  EXPECT_DOUBLE_EQ(view.energy_between(Seconds(7), Seconds(8))->value, 10);
  EXPECT_DOUBLE_EQ(view.gaps_between(Seconds(0), Seconds(10)).value, 4);
  EXPECT_DOUBLE_EQ(view.gaps_between(Seconds(5), Seconds(6)).value, 0);
}

TEST(Trace, TwoReadingsAtOneTimeAreOnePoint) {
  Trace trace;
  trace.add(at(1, 0), false);
  trace.add(at(2, 5), false);
  trace.add(at(2, 6, false), false);
  ASSERT_EQ(trace.size(), 2U);
  EXPECT_DOUBLE_EQ(trace.latest()->energy.value, 6);
  EXPECT_TRUE(trace.latest()->changed);
}

TEST(Trace, StaysBoundedAndKeepsTotalsAndGaps) {
  Trace trace(1000);
  for (int i = 0; i < 100000; ++i) {
    if (i == 40) trace.add_gap();
    trace.add(at(i, 2.0 * i), false);
    ASSERT_LT(trace.size(), 1000U);
  }
  const TraceView view = trace.view();
  EXPECT_FALSE(view.energy_between(Seconds(0), Seconds(99999)));
  EXPECT_DOUBLE_EQ(view.gaps_between(Seconds(0), Seconds(99999)).value, 1);
  EXPECT_DOUBLE_EQ(view.energy_between(Seconds(40), Seconds(99999))->value, 2 * 99959.0);
  EXPECT_DOUBLE_EQ(view.energy_between(Seconds(99000.5), Seconds(99999))->value, 2 * 998.5);
  EXPECT_DOUBLE_EQ(view.points().front().time.value, 0);
}

TEST(Trace, ThinningKeepsThatAValueChanged) {
  Trace trace(8);
  for (int i = 0; i < 7; ++i) trace.add(at(i, i, i == 1), false);
  trace.add(at(7, 7, false), false);
  std::size_t changes = 0;
  const TraceView view = trace.view();
  for (const TracePoint& point : view.points()) changes += point.changed ? 1 : 0;
  EXPECT_EQ(changes, 1U);
}

TEST(Trace, ViewsOfATimeHoldTheNeighbours) {
  Trace trace;
  for (int i = 0; i < 100; ++i) trace.add(at(i, i), false);
  const TraceView view = trace.view(Seconds(10.5), Seconds(20.5));
  EXPECT_DOUBLE_EQ(view.points().front().time.value, 10);
  EXPECT_DOUBLE_EQ(view.points().back().time.value, 21);
  EXPECT_DOUBLE_EQ(view.energy_between(Seconds(10.5), Seconds(20.5))->value, 10);
  EXPECT_EQ(view.part(Seconds(12), Seconds(14)).points().size(), 3U);
}

TEST(Trace, MeasuresTheSensorsPeriodFromItsChanges) {
  Trace trace;
  for (int i = 0; i <= 40; ++i) trace.add(at(0.25 * i, i, i % 4 == 0), false);
  const auto period = trace.view().observed_period();
  ASSERT_TRUE(period);
  EXPECT_DOUBLE_EQ(period->median.value, 1.0);
  EXPECT_DOUBLE_EQ(period->longest.value, 1.0);
  EXPECT_EQ(period->changes, 10U);

  Trace few;
  for (int i = 0; i < 8; ++i) few.add(at(i, i), false);
  EXPECT_FALSE(few.view().observed_period()) << "seven periods are too few";
}

}  // namespace
}  // namespace encore::energy
