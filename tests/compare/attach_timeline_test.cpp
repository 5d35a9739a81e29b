// What a session's files tell of when the machine worked at what.
#include "app/attach_timeline.h"

#include <gtest/gtest.h>

namespace encore::app {
namespace {

using energy::Phase;
using energy::Seconds;

std::vector<energy::Window> one_window(double from, double to) {
  return {{Seconds(from), Seconds(to)}};
}

TEST(AttachTimeline, OperationsOfARowAreLaidOutOneByOne) {
  energy::FrameRow row;
  row.operations = 4;
  row.time = Seconds(1.0);
  row.phases[Phase::build] = Seconds(0.1);
  row.phases[Phase::render] = Seconds(0.3);
  energy::FrameRow next = row;
  next.time = Seconds(2.5);  // sooner than the means would have it
  const energy::BusyTimeline busy = busy_in({row, next}, one_window(0.5, 10));
  const auto build = static_cast<std::size_t>(Phase::build);
  const auto render = static_cast<std::size_t>(Phase::render);
  EXPECT_NEAR(busy.busy(build, Seconds(1.0), Seconds(1.4)).value, 0.1, 1e-9);
  EXPECT_NEAR(busy.busy(render, Seconds(1.0), Seconds(1.4)).value, 0.3, 1e-9);
  EXPECT_NEAR(busy.busy(build, Seconds(1.8), Seconds(1.9)).value, 0.1, 1e-9);
  EXPECT_NEAR(busy.operations(Seconds(0), Seconds(2.5)), 4.0, 1e-9);
  EXPECT_NEAR(busy.operations(Seconds(2.5), Seconds(10)), 4.0, 1e-9);
  EXPECT_NEAR(busy.busy(render, Seconds(2.5), Seconds(10)).value, 1.2, 1e-9);
  // Rows of other windows do not count.
  EXPECT_EQ(busy_in({row, next}, one_window(2, 10)).operations(Seconds(0), Seconds(9)), 4.0);
}

TEST(AttachTimeline, ShortOperationsAreTakenTogether) {
  energy::FrameRow row;
  row.operations = 1000000;
  row.phases[Phase::build] = Seconds(2e-9);
  row.phases[Phase::render] = Seconds(6e-9);
  const energy::BusyTimeline busy = busy_in({row}, one_window(0, 1));
  EXPECT_NEAR(busy.operations(Seconds(0), Seconds(0.004)), 5e5, 1.0);
  EXPECT_NEAR(busy.busy(0, Seconds(0), Seconds(1)).value, 0.0, 1e-12);
  const auto build = static_cast<std::size_t>(Phase::build);
  EXPECT_NEAR(busy.busy(build, Seconds(0), Seconds(0.004)).value, 0.001, 0.0003);
  EXPECT_LT(busy.pieces(build, Seconds(0), Seconds(1)).size(), 40U);
}

TEST(AttachTimeline, WhatIsNotIdleIsBusy) {
  energy::Session session;
  session.info.plan.cool_down = Seconds(2);
  const std::vector<energy::KeyValue> a{{"structure", "a"}};
  const std::vector<energy::KeyValue> b{{"structure", "b"}};
  session.windows = {
      {a, "idle", Seconds(1), Seconds(3)},       {a, "measured", Seconds(4), Seconds(6)},
      {a, "idle", Seconds(6), Seconds(8)},       {b, "idle", Seconds(13), Seconds(15)},
      {b, "measured", Seconds(15), Seconds(17)}, {b, "mixed", Seconds(17), Seconds(19)}};
  energy::FrameRow row;
  row.operations = 1;
  row.time = Seconds(4);
  row.phases[Phase::render] = Seconds(1.5);
  session.frames = {row};
  row.time = Seconds(15);
  row.phases[Phase::render] = Seconds(2);
  session.frames.push_back(row);
  const SessionLoad load = load_of(session, Seconds(0));
  EXPECT_EQ(load.from.value, 1.0);
  EXPECT_EQ(load.to.value, 19.0);
  // Warm-up and first row; preparing after the cool-down; the second row and its mixed blocks.
  ASSERT_EQ(load.busy.size(), 3U);
  const double expected[][2] = {{3, 5.5}, {10, 13}, {15, 19}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(load.busy[i].start.value, expected[i][0]);
    EXPECT_EQ(load.busy[i].end.value, expected[i][1]);
  }
  EXPECT_EQ(load_of(session, Seconds(9)).from.value, 13.0);
}

TEST(AttachTimeline, SlotsOfTheWindowCountTogether) {
  energy::FrameRow row;
  row.operations = 1;
  row.time = Seconds(1.0);
  row.phases[Phase::render] = Seconds(0.5);
  energy::FrameRow between = row;
  between.time = Seconds(4.0);
  energy::FrameRow last = row;
  last.time = Seconds(7.0);
  const std::vector<energy::Window> slots{{Seconds(0), Seconds(3)}, {Seconds(6), Seconds(9)}};
  const energy::BusyTimeline busy = busy_in({row, between, last}, slots);
  const auto render = static_cast<std::size_t>(Phase::render);
  EXPECT_NEAR(busy.busy(render, Seconds(0), Seconds(9)).value, 1.0, 1e-9);
  EXPECT_NEAR(busy.operations(Seconds(3), Seconds(6)), 0.0, 1e-9);
}

}  // namespace
}  // namespace encore::app
