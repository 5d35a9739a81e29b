#include "energy/attribution/busy_timeline.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace encore::energy {
namespace {

TEST(BusyTimeline, KnowsBusyTimeBetweenAnyTimes) {
  BusyTimeline busy({"build", "render"});
  busy.add(0, Seconds(1), Seconds(3));
  busy.add(0, Seconds(5), Seconds(6));
  busy.add(1, Seconds(2), Seconds(5.5));  // overlaps both
  EXPECT_DOUBLE_EQ(busy.busy(0, Seconds(0), Seconds(10)).value, 3);
  EXPECT_DOUBLE_EQ(busy.busy(0, Seconds(2), Seconds(5.5)).value, 1.5);
  EXPECT_DOUBLE_EQ(busy.busy(0, Seconds(3.5), Seconds(4.5)).value, 0);
  EXPECT_DOUBLE_EQ(busy.busy(1, Seconds(0), Seconds(4)).value, 2);
}

TEST(BusyTimeline, MergesShortSpansWithoutLosingTime) {
  BusyTimeline busy({"build"}, Seconds(0.001));
  constexpr int kSpans = 1000000;
  for (int i = 0; i < kSpans; ++i) {
    busy.add(0, Seconds(i * 1e-5), Seconds(i * 1e-5 + 0.4e-5));
  }
  const Seconds all(kSpans * 1e-5);
  EXPECT_NEAR(busy.busy(0, Seconds(0), all).value, 0.4 * all.value, 1e-6);
  EXPECT_NEAR(busy.busy(0, Seconds(3.33333), Seconds(7.77777)).value, 0.4 * 4.44444, 1e-3);
  const auto pieces = busy.pieces(0, Seconds(0), all);
  EXPECT_LT(pieces.size(), 15000U) << "bounded by time, not by spans";
  EXPECT_NEAR(pieces[pieces.size() / 2].share, 0.4, 0.01);
}

TEST(BusyTimeline, ARunOfDaysStaysBounded) {
  BusyTimeline busy({"build"}, Seconds(0.001), 1000);
  for (int i = 0; i < 200000; ++i) busy.add(0, Seconds(i), Seconds(i + 0.25));
  EXPECT_LE(busy.pieces(0, Seconds(0), Seconds(200000)).size(), 1000U);
  EXPECT_NEAR(busy.busy(0, Seconds(0), Seconds(200000)).value, 50000, 1e-6);
  EXPECT_NEAR(busy.busy(0, Seconds(199990), Seconds(200000)).value, 2.5, 1e-9) << "exact lately";
  EXPECT_NEAR(busy.busy(0, Seconds(50000), Seconds(150000)).value, 25000, 500);
}

TEST(BusyTimeline, LongSpansStayExact) {
  BusyTimeline busy({"build"}, Seconds(0.001));
  for (int i = 0; i < 100; ++i) busy.add(0, Seconds(i * 0.02), Seconds(i * 0.02 + 0.013));
  const auto pieces = busy.pieces(0, Seconds(0.5), Seconds(0.6));
  ASSERT_EQ(pieces.size(), 5U);
  EXPECT_DOUBLE_EQ(pieces[1].start.value, 0.52);
  EXPECT_DOUBLE_EQ(pieces[1].end.value, 0.533);
  EXPECT_NEAR(pieces[1].share, 1.0, 1e-9);
}

TEST(BusyTimeline, CountsOperationsLinearlyInside) {
  BusyTimeline busy({"build"});
  busy.add_operations(4, Seconds(1), Seconds(2));
  busy.add_operations(1, Seconds(3), Seconds(4));
  EXPECT_DOUBLE_EQ(busy.operations(Seconds(0), Seconds(5)), 5);
  EXPECT_DOUBLE_EQ(busy.operations(Seconds(1.5), Seconds(3.5)), 2.5);
}

TEST(BusyTimeline, RefusesSpansOutOfOrder) {
  BusyTimeline busy({"build"});
  busy.add(0, Seconds(1), Seconds(3));
  EXPECT_THROW(busy.add(0, Seconds(2), Seconds(4)), std::logic_error);
}

TEST(LiveBusyTime, IncludesTheRunningPhase) {
  LiveBusyTime live;
  EXPECT_EQ(live.busy(Seconds(5))[Phase::build], Seconds(0));
  live.begin(Phase::build, Seconds(10));
  EXPECT_EQ(live.busy(Seconds(12))[Phase::build], Seconds(2));
  live.end(Seconds(13));
  live.begin(Phase::render, Seconds(14));
  EXPECT_EQ(live.busy(Seconds(15))[Phase::build], Seconds(3));
  EXPECT_EQ(live.busy(Seconds(15))[Phase::render], Seconds(1));
}

TEST(LiveBusyTime, LooksBackAsFarAsItRemembers) {
  LiveBusyTime live(1000);
  for (int i = 0; i < 100; ++i) {
    live.begin(Phase::build, Seconds(i));
    live.end(Seconds(i + 0.5));
  }
  EXPECT_EQ(live.busy(Seconds(50))[Phase::build], Seconds(25));
  EXPECT_EQ(live.busy(Seconds(50.25))[Phase::build], Seconds(25.25));
  EXPECT_EQ(live.busy(Seconds(50.75))[Phase::build], Seconds(25.5));
}

}  // namespace
}  // namespace encore::energy
