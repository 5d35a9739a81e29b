#include "app/exit_code.h"
#include "recording_world.h"

#include <gtest/gtest.h>

namespace encore::app {
namespace {

MeasuringOptions source(const char* name) {
  MeasuringOptions options;
  options.sources = {name};
  return options;
}

std::vector<PowerPoint> points_of(const PowerNews& news, std::uint32_t id) {
  for (const PowerNews::Points& one : news.points) {
    if (one.source == id) return one.points;
  }
  return {};
}

TEST(PowerMonitor, DrainTellsEveryPointOnce) {
  RecordingWorld world;
  world.pass(energy::Seconds(1.0), 50.0);
  const PowerNews first = world.monitor().drain();
  ASSERT_EQ(first.points.size(), 1U);
  EXPECT_EQ(first.points[0].points.size(), 32U);
  EXPECT_EQ(world.monitor().drain().points.size(), 0U);
  world.pass(energy::Seconds(0.5), 50.0);
  const PowerNews second = world.monitor().drain();
  ASSERT_EQ(second.points.size(), 1U);
  EXPECT_EQ(second.points[0].points.size(), 16U);
  EXPECT_GT(second.points[0].points.front().time_s, first.points[0].points.back().time_s);
  EXPECT_EQ(second.dropped, 0U);
}

TEST(PowerMonitor, ACountersWattsAreTheMeanSinceItsLastChange) {
  RecordingWorld world;
  world.pass(energy::Seconds(0.5), 50.0);
  const std::vector<PowerPoint> points = points_of(world.monitor().drain(), 0);
  ASSERT_GT(points.size(), 3U);
  EXPECT_TRUE(points[0].gap);
  EXPECT_FALSE(points[0].watts);
  for (std::size_t i = 1; i < points.size(); ++i) {
    ASSERT_TRUE(points[i].watts) << i;
    EXPECT_NEAR(*points[i].watts, 50.0, 50.0 * 0.05) << i;  // an update of 1 ms in 31 ms
    EXPECT_FALSE(points[i].gap);
  }
  const auto watts = world.monitor().state().watts;
  ASSERT_TRUE(watts);
  EXPECT_DOUBLE_EQ(*watts, *points.back().watts);
}

TEST(PowerMonitor, AnotherSourceKeepsTheHistoryOfTheOneBefore) {
  RecordingWorld world;
  world.pass(energy::Seconds(0.5), 50.0);
  world.monitor().choose(source("simulated:b"));
  world.monitor().wait_until_open();
  world.pass(energy::Seconds(0.5), 50.0);
  PowerState state = world.monitor().state();
  ASSERT_EQ(state.sources.size(), 2U);
  EXPECT_EQ(state.sources[0].info.name, "simulated:a");
  EXPECT_FALSE(state.sources[0].active);
  EXPECT_FALSE(state.sources[0].in_total);
  EXPECT_TRUE(state.sources[1].active);
  EXPECT_EQ(state.total_name, "simulated:b");
  EXPECT_EQ(state.generation, 2U);
  const PowerNews news = world.monitor().drain();
  EXPECT_EQ(points_of(news, 0).size(), 16U);
  EXPECT_EQ(points_of(news, 1).size(), 16U);

  // Back again: the same series goes on behind a gap, and counts from 0.
  world.monitor().choose(source("simulated:a"));
  world.monitor().wait_until_open();
  world.pass(energy::Seconds(0.5), 50.0);
  state = world.monitor().state();
  ASSERT_EQ(state.sources.size(), 2U);
  EXPECT_TRUE(state.sources[0].active);
  const std::vector<PowerPoint> again = points_of(world.monitor().drain(), 0);
  ASSERT_EQ(again.size(), 16U);
  EXPECT_TRUE(again[0].gap);
  EXPECT_FALSE(again[1].gap);
}

TEST(PowerMonitor, ARefusedSourceLeavesTheOldOneAndSaysWhy) {
  RecordingWorld world;
  world.monitor().choose(source("broken"));
  world.monitor().wait_until_open();
  const PowerState state = world.monitor().state();
  EXPECT_EQ(state.error, "source broken: no such sensor here");
  EXPECT_EQ(state.total_name, "simulated:a");
  world.pass(energy::Seconds(0.25), 50.0);
  EXPECT_EQ(points_of(world.monitor().drain(), 0).size(), 8U);
  world.monitor().choose(source("simulated:b"));
  world.monitor().wait_until_open();
  EXPECT_EQ(world.monitor().state().error, "");
}

TEST(PowerMonitor, AMachineWithoutSensorSaysWhyAndTheWayOut) {
  const TemporaryFolder empty;
  PowerMonitor monitor;
  MeasuringOptions options;
  options.sensor_root = (empty / "").string();
  monitor.choose(options);
  monitor.wait_until_open();
  const PowerState state = monitor.state();
  // NVIDIA's library is not looked for below a root: a machine with such a board has a source.
  if (state.sources.empty()) {
    EXPECT_EQ(state.total.origin, energy::Origin::unavailable);
    EXPECT_TRUE(
        state.total.detail.starts_with("this machine has no power sensor that can be read"));
    EXPECT_NE(state.total.detail.find("enter idle and busy watts"), std::string::npos);
    EXPECT_EQ(state.total.detail.find("tells more"), std::string::npos);
  }
  EXPECT_EQ(state.error, "");
  EXPECT_EQ(state.generation, 1U);
}

TEST(PowerMonitor, ModelledWattsFollowThePhasesOfOneDeviceAtATime) {
  RecordingWorld world;
  MeasuringOptions options;
  options.model = model_from_watts(12, 45);
  world.monitor().choose(options);
  world.monitor().wait_until_open();
  EXPECT_EQ(world.monitor().state().total.origin, energy::Origin::modelled);
  BusyMarks& busy = world.monitor().busy();
  const auto pass = [&] { world.pass(energy::Seconds(0.5), 50.0); };
  const auto watts = [&] { return world.monitor().state().watts; };
  pass();
  ASSERT_TRUE(watts());
  EXPECT_NEAR(*watts(), 12.0, 1e-9);
  busy.begin(Device::cpu, energy::Phase::render, world.clock().now());
  pass();
  ASSERT_TRUE(watts());
  EXPECT_NEAR(*watts(), 45.0, 1e-9);
  // Both at once: no value, and a line that says why; then a gap.
  busy.begin(Device::gpu, energy::Phase::render, world.clock().now());
  pass();
  EXPECT_FALSE(watts());
  busy.end(Device::cpu, world.clock().now());
  (void)world.monitor().drain();
  pass();
  ASSERT_TRUE(watts());
  EXPECT_NEAR(*watts(), 45.0, 1e-9);
  const PowerNews news = world.monitor().drain();
  ASSERT_EQ(news.points.size(), 1U);
  EXPECT_TRUE(news.points[0].points.front().gap);
  busy.end(Device::gpu, world.clock().now());
  pass();
  EXPECT_NEAR(watts().value_or(0.0), 12.0, 1e-9);
}

TEST(PowerMonitor, BothDevicesAtOnceAreToldOnce) {
  RecordingWorld world;
  (void)world.monitor().drain();
  BusyMarks& busy = world.monitor().busy();
  for (int i = 0; i < 5; ++i) {
    busy.begin(Device::cpu, energy::Phase::render, world.clock().now());
    busy.begin(Device::gpu, energy::Phase::render, world.clock().now());
    world.pass(energy::Seconds(0.1), 50.0);
    busy.end(Device::gpu, world.clock().now());
    busy.end(Device::cpu, world.clock().now());
    world.pass(energy::Seconds(0.1), 50.0);
  }
  std::size_t told = 0;
  for (const MonitorEvent& event : world.monitor().drain().events) {
    told += event.message.find("both devices work at once") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(told, 1U);
}

TEST(PowerMonitor, IdleAndBusyWattsMustMakeSense) {
  EXPECT_EQ(model_from_watts(12, 45), "idle=12,busy=33");
  EXPECT_THROW((void)model_from_watts(45, 12), UsageError);
  EXPECT_THROW((void)model_from_watts(-1, 12), UsageError);
}

TEST(PowerMonitor, ReadsByItself) {
  PowerMonitor monitor;
  MeasuringOptions options;
  options.model = "idle=12,busy=20";
  monitor.choose(options);
  std::size_t points = 0;
  EXPECT_TRUE(eventually([&] {
    for (const auto& one : monitor.drain().points) points += one.points.size();
    return points >= 5;
  }));
  EXPECT_GT(monitor.state().cost.polls, 0U);
}

TEST(BusyMarks, SecondDeviceTakesOverWhenTheFirstEnds) {
  BusyMarks marks;
  const auto render = [&](double t) {
    return marks.live().busy(energy::Seconds(t))[energy::Phase::render].value;
  };
  const auto build = [&](double t) {
    return marks.live().busy(energy::Seconds(t))[energy::Phase::build].value;
  };
  marks.begin(Device::cpu, energy::Phase::build, energy::Seconds(1));
  marks.begin(Device::gpu, energy::Phase::render, energy::Seconds(2));
  marks.end(Device::cpu, energy::Seconds(4));
  marks.end(Device::gpu, energy::Seconds(7));
  EXPECT_DOUBLE_EQ(build(8), 3.0);
  EXPECT_DOUBLE_EQ(render(8), 3.0);
  EXPECT_FALSE(marks.overlapped(energy::Seconds(0), energy::Seconds(1.9)));
  EXPECT_TRUE(marks.overlapped(energy::Seconds(0), energy::Seconds(2.1)));
  EXPECT_TRUE(marks.overlapped(energy::Seconds(3.9), energy::Seconds(9)));
  EXPECT_FALSE(marks.overlapped(energy::Seconds(4.1), energy::Seconds(9)));
}

}  // namespace
}  // namespace encore::app
