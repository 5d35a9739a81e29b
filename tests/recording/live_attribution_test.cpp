#include "app/session_input.h"
#include "recording_world.h"

#include <gtest/gtest.h>

#include <cmath>

namespace encore::app {
namespace {

constexpr double kCpuFrame = 0.020;
constexpr double kCpuWatts = 50.0;
constexpr double kGpuFrame = 0.007;
constexpr double kGpuWatts = 80.0;
constexpr double kIdleWatts = 20.0;

void alternate(RecordingWorld& world, int turns) {
  const Slot cpu = RecordingWorld::slot_of("cpu");
  const Slot gpu = RecordingWorld::slot_of("gpu");
  for (int i = 0; i < turns; ++i) {
    world.idle(0.5);
    world.load(cpu, 1.0, kCpuFrame, kCpuWatts, Device::cpu);
    world.idle(0.5);
    world.load(gpu, 1.0, kGpuFrame, kGpuWatts, Device::gpu);
  }
  world.idle(0.5);
}

TEST(LiveAttribution, FindsTheTruthOfBothConfigurationsThatTakeTurns) {
  constexpr int kRuns = 20;
  int joules_held = 0;
  int net_held = 0;
  int times_held = 0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    RecordingWorld world(static_cast<std::uint64_t>(seed));
    alternate(world, 6);
    const auto figures = world.attribution().compute();
    ASSERT_EQ(figures->configurations.size(), 2U);
    const double frames[] = {kCpuFrame, kGpuFrame};
    const double watts[] = {kCpuWatts, kGpuWatts};
    for (std::size_t i = 0; i < 2; ++i) {
      const LiveFigures& one = figures->configurations[i];
      EXPECT_EQ(one.slots, 6U);
      ASSERT_TRUE(one.summary.joules && one.summary.joules_ci95 && one.summary.net_joules) << i;
      const double truth = frames[i] * watts[i];
      const double net = frames[i] * (watts[i] - kIdleWatts);
      joules_held += std::fabs(one.summary.joules->value - truth) <= one.summary.joules_ci95->value;
      net_held += std::fabs(one.summary.net_joules->value - net) <=
                  one.summary.net_joules_ci95->value + 0.01 * net;
      times_held += std::fabs(one.summary.mean.value - frames[i]) <= one.summary.ci95->value;
      EXPECT_LT(one.summary.joules_ci95->value, 0.05 * truth);
      EXPECT_NEAR(one.summary.idle_watts->value, kIdleWatts, 0.2);
      EXPECT_EQ(one.energy.origin, energy::Origin::simulated);
      EXPECT_NEAR(*one.mrays_per_s, 64 * 32 / frames[i] / 1e6, 0.03 * 64 * 32 / frames[i] / 1e6);
    }
  }
  // 95 of 100 is the aim; below 34 of 40 there would be one chance in two hundred.
  EXPECT_GE(joules_held, 34);
  EXPECT_GE(net_held, 34);
  EXPECT_GE(times_held, 34);
}

TEST(LiveAttribution, GivesPhasesAndConvergence) {
  RecordingWorld world;
  alternate(world, 6);
  const LiveFigures one = world.attribution().compute()->configurations[0];
  ASSERT_GE(one.phases.size(), 3U);
  EXPECT_EQ(one.phases[0].phase, "render");
  EXPECT_EQ(one.phases[0].method, "whole");
  ASSERT_TRUE(one.phases[0].watts);
  EXPECT_NEAR(one.phases[0].watts->value, kCpuWatts, 2.0);
  std::size_t times = 0;
  std::size_t joules = 0;
  for (const energy::ConvergenceRow& row : one.convergence) {
    if (row.quantity == "time_per_operation") ++times;
    if (row.quantity != "joules_per_operation") continue;
    ++joules;
    // The idle and the GPU's slots between are no energy of the CPU's frames.
    if (row.elapsed.value > 2.0) {
      EXPECT_NEAR(row.mean, kCpuFrame * kCpuWatts, 0.05 * kCpuFrame * kCpuWatts);
    }
  }
  EXPECT_GT(times, 5U);
  EXPECT_GT(joules, 5U);
}

TEST(LiveAttribution, FiguresAreThereWhileASlotRuns) {
  RecordingWorld world;
  world.idle(0.5);
  const Slot cpu = RecordingWorld::slot_of("cpu");
  world.load(cpu, 1.0, kCpuFrame, kCpuWatts);
  world.attribution().slot_began(cpu);
  for (int i = 0; i < 50; ++i) {
    const energy::Seconds began = world.attribution().begin_operation();
    world.pass(energy::Seconds(kCpuFrame), kCpuWatts);
    const energy::PhaseSpan span{energy::Phase::render, began, world.clock().now()};
    world.attribution().operation({&span, 1}, began, world.clock().now());
  }
  const auto figures = world.attribution().compute();
  ASSERT_EQ(figures->configurations.size(), 1U);
  EXPECT_GT(figures->configurations[0].summary.operations, 90U);
  EXPECT_TRUE(figures->configurations[0].summary.joules);
}

TEST(LiveAttribution, EnergyOfAnotherSensorIsNotMixedIn) {
  RecordingWorld world;
  const Slot cpu = RecordingWorld::slot_of("cpu");
  world.load(cpu, 1.0, kCpuFrame, kCpuWatts);
  MeasuringOptions options;
  options.sources = {"simulated:b"};
  world.monitor().choose(options);
  world.monitor().wait_until_open();
  world.idle(0.5);
  LiveFigures one = world.attribution().compute()->configurations[0];
  EXPECT_FALSE(one.summary.joules);
  EXPECT_EQ(one.energy.origin, energy::Origin::unavailable);
  EXPECT_NE(one.energy.detail.find("before these power sources"), std::string::npos);
  EXPECT_GT(one.summary.operations, 40U);
  world.load(cpu, 1.0, kCpuFrame, kCpuWatts);
  one = world.attribution().compute()->configurations[0];
  EXPECT_TRUE(one.summary.joules);
  EXPECT_EQ(one.summary.source, "simulated:b");
}

TEST(LiveAttribution, NoEnergyWhereBothDevicesWorkedAtOnce) {
  RecordingWorld world;
  BusyMarks& busy = world.monitor().busy();
  busy.begin(Device::gpu, energy::Phase::render, world.clock().now());
  world.load(RecordingWorld::slot_of("cpu"), 1.0, kCpuFrame, kCpuWatts);
  busy.end(Device::gpu, world.clock().now());
  const LiveFigures one = world.attribution().compute()->configurations[0];
  EXPECT_FALSE(one.summary.joules);
  EXPECT_NE(one.energy.detail.find("both devices worked at once"), std::string::npos);
  EXPECT_TRUE(one.summary.ci95);
}

TEST(LiveAttribution, WithoutSourcesThereAreTimesAndAReason) {
  RecordingWorld world;
  MeasuringOptions options;
  options.sources = {"none"};
  PowerMonitor::Setup setup;
  setup.clock = &world.clock();
  setup.threaded = false;
  PowerMonitor monitor(setup);
  monitor.choose(options);
  monitor.wait_until_open();
  LiveAttribution attribution(
      monitor, {.row = energy::Seconds(0.010), .every = energy::Seconds(1.0), .threaded = false});
  attribution.slot_began(RecordingWorld::slot_of("cpu"));
  for (int i = 0; i < 20; ++i) {
    const energy::Seconds began = attribution.begin_operation();
    world.clock().go_on(energy::Seconds(0.02));
    const energy::PhaseSpan span{energy::Phase::render, began, world.clock().now()};
    attribution.operation({&span, 1}, began, world.clock().now());
  }
  attribution.slot_ended();
  const LiveFigures one = attribution.compute()->configurations[0];
  EXPECT_NEAR(one.summary.mean.value, 0.02, 1e-9);
  EXPECT_FALSE(one.summary.joules);
  EXPECT_TRUE(one.phases.empty());
  EXPECT_EQ(one.energy.detail,
            "power is not measured, as was asked for; pick a sensor to measure it");
}

TEST(LiveAttribution, ComputesByItselfWhenASlotEndsAndForgetsWhenTold) {
  RecordingWorld world;
  LiveAttribution attribution(world.monitor());
  attribution.slot_began(RecordingWorld::slot_of("cpu"));
  const energy::Seconds began = attribution.begin_operation();
  world.pass(energy::Seconds(0.05), kCpuWatts);
  const energy::PhaseSpan span{energy::Phase::render, began, world.clock().now()};
  attribution.operation({&span, 1}, began, world.clock().now());
  attribution.slot_ended();
  EXPECT_TRUE(eventually([&] { return attribution.latest()->configurations.size() == 1; }));
  attribution.clear();
  EXPECT_TRUE(attribution.latest()->configurations.empty());
}

}  // namespace
}  // namespace encore::app
