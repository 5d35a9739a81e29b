#include "regression_world.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace encore::energy {
namespace {

/// How often intervals hold the truth: both phases, and idle.
struct Coverage {
  double phases[2] = {0, 0};
  double idle = 0;
  double mean_width = 0;
};
Coverage coverage(const SimulatedSettings& sensor, int runs, double fluctuation, double wander) {
  const std::vector<Phase> phases{Phase::build, Phase::render};
  PerPhase<Seconds> times{};
  times[Phase::build] = Seconds(0.004);
  times[Phase::render] = Seconds(0.017);
  const std::vector<Watts> powers{Watts(30), Watts(55)};
  Coverage share;
  for (int run = 0; run < runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run) + 1;
    World world({"build", "render"}, Watts(20), 1000 + seed);
    world.fluctuation = fluctuation;
    world.wander = wander;
    world.idle_for(Seconds(4));
    world.load_begins();
    run_blocks(world, make_mix_blocks(phases, times, sensor.info, Seconds(20), seed), phases, times,
               powers);
    world.load_ends();
    world.idle_for(Seconds(4));
    SimulatedSettings settings = sensor;
    settings.seed = seed;
    world.measure(settings);
    const PhaseFit fit = world.fit();
    EXPECT_FALSE(fit.refused);
    if (fit.refused) continue;
    const auto holds_truth = [&](const Uncertain& found, double truth) {
      return std::fabs(found.value - truth) <= found.half_width ? 1.0 / runs : 0.0;
    };
    for (std::size_t c = 0; c < 2; ++c) {
      share.phases[c] += holds_truth(*fit.phases[c].watts, powers[c].value);
    }
    share.idle += holds_truth(*fit.idle_watts, 20.0);
    share.mean_width += fit.phases[1].watts->half_width / runs;
  }
  testing::Test::RecordProperty(
      fmt::format("fluctuation_{}_wander_{}_period_{}", fluctuation, wander,
                  sensor.info.update_period.value),
      fmt::format("{:.3f} {:.3f} {:.3f}", share.phases[0], share.phases[1], share.idle));
  return share;
}

SimulatedSettings rapl_like() {
  SimulatedSettings settings = World::counter(Seconds(0.001), Seconds(0.05));
  settings.info.energy_step = Joules(61.035e-6);
  return settings;
}

TEST(RegressionCoverage, CounterOfOneMillisecond) {
  const Coverage share = coverage(rapl_like(), 500, 0.0, 0.0);
  for (const double c : {share.phases[0], share.phases[1], share.idle}) {
    EXPECT_GE(c, 0.93);
    EXPECT_LE(c, 0.98);
  }
  // The edges of 50 mW s each are all that is uncertain.
  EXPECT_LT(share.mean_width, 0.02);
}

TEST(RegressionCoverage, CounterOfAHundredMilliseconds) {
  const Coverage share = coverage(nvml_like(), 500, 0.0, 0.0);
  for (const double c : {share.phases[0], share.phases[1], share.idle}) {
    EXPECT_GE(c, 0.93);
    EXPECT_LE(c, 0.985);
  }
  EXPECT_LT(share.mean_width, 0.3);
}

TEST(RegressionCoverage, PowerThatFluctuatesOrWanders) {
  // Each phase's own power differs from run to run by a fifth; all power wanders by 1 W within
  // seconds. Intervals may be too wide (idle does not fluctuate), never much too narrow.
  for (const SimulatedSettings& sensor : {rapl_like(), nvml_like()}) {
    for (const double wander : {0.0, 1.0}) {
      const Coverage share = coverage(sensor, 120, 0.2, wander);
      for (const double c : {share.phases[0], share.phases[1], share.idle}) EXPECT_GE(c, 0.88);
      EXPECT_GT(share.mean_width, 0.5);
    }
  }
}

}  // namespace
}  // namespace encore::energy
