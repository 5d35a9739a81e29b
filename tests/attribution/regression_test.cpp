#include "energy/attribution/regression.h"

#include "regression_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace encore::energy {
namespace {

bool notes_hold(const PhaseFit& fit, const std::string& words) {
  return std::any_of(fit.notes.begin(), fit.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

/// Blocks of one column each, or of nothing, in random order, each 0.3 to 0.5 s.
void run_mixed(World& world, const std::vector<Watts>& powers, int blocks) {
  std::uniform_real_distribution<double> length(0.3, 0.5);
  for (int i = 0; i < blocks; ++i) {
    const std::size_t column = world.random() % (powers.size() + 1);
    const Seconds now(length(world.random));
    if (column == powers.size()) {
      world.sleep(now);
    } else {
      world.run(column, now, powers[column]);
    }
  }
}

TEST(Regression, ExactCounterGivesThePowersExactly) {
  World world({"build", "transfer", "render", "update"}, Watts(20));
  world.idle_for(Seconds(3));
  world.load_begins();
  run_mixed(world, {Watts(30), Watts(0.5), Watts(55)}, 60);
  world.load_ends();
  world.idle_for(Seconds(3));
  world.measure_exactly(Seconds(0.05));
  const PhaseFit fit = world.fit();
  ASSERT_FALSE(fit.refused);
  EXPECT_NEAR(fit.phases[0].watts->value, 30.0, 1e-7);
  EXPECT_NEAR(fit.phases[1].watts->value, 0.5, 1e-7);
  EXPECT_NEAR(fit.phases[2].watts->value, 55.0, 1e-7);
  EXPECT_NEAR(fit.idle_watts->value, 20.0, 1e-7);
  EXPECT_LT(fit.phases[0].watts->half_width, 1e-6);
  EXPECT_LT(fit.condition, 10.0);
  EXPECT_FALSE(fit.phases[3].watts);
  EXPECT_EQ(fit.phases[3].reason, "update did not run");
}

TEST(Regression, OverlappingColumnsAreToldApartAndTheirInteractionIsNoted) {
  for (const double extra : {0.0, -15.0}) {
    World world({"cpu", "gpu"}, Watts(20));
    world.load_begins();
    std::uniform_real_distribution<double> length(0.3, 0.5);
    for (int i = 0; i < 80; ++i) {
      switch (world.random() % 4) {
        case 0:
          world.run(0, Seconds(length(world.random)), Watts(30));
          break;
        case 1:
          world.run(1, Seconds(length(world.random)), Watts(100));
          break;
        case 2:
          world.run_both(0, 1, Seconds(length(world.random)), Watts(130 + extra));
          break;
        default:
          world.sleep(Seconds(length(world.random)));
      }
    }
    world.load_ends();
    world.measure_exactly(Seconds(0.05));
    const PhaseFit fit = world.fit();
    ASSERT_FALSE(fit.refused);
    EXPECT_NEAR(fit.phases[0].watts->value, 30.0, 1e-6) << extra;
    EXPECT_NEAR(fit.phases[1].watts->value, 100.0, 1e-6) << extra;
    EXPECT_NEAR(fit.idle_watts->value, 20.0, 1e-6) << extra;
    EXPECT_EQ(notes_hold(fit, "at once"), extra != 0.0);
    if (extra != 0.0) {
      EXPECT_TRUE(notes_hold(fit, "cpu and gpu at once draw 15")) << extra;
      EXPECT_TRUE(notes_hold(fit, "W less than each alone"));
    }
  }
}

TEST(Regression, GapsAndResetsCostNothingButTheirOwnTime) {
  World world({"build", "render"}, Watts(20));
  world.load_begins();
  run_mixed(world, {Watts(30), Watts(55)}, 100);
  world.load_ends();
  SimulatedSettings settings = World::counter(Seconds(0), Seconds(0.05));
  settings.info.update_period = Seconds(0.05);
  settings.faults = {{SimulatedFault::Kind::fail, Seconds(5), Seconds(8.3)},
                     {SimulatedFault::Kind::reset, Seconds(20), Seconds(20)}};
  world.measure(settings);
  const PhaseFit fit = world.fit();
  ASSERT_FALSE(fit.refused);
  EXPECT_NEAR(fit.phases[0].watts->value, 30.0, 1e-7);
  EXPECT_NEAR(fit.phases[1].watts->value, 55.0, 1e-7);
  EXPECT_NEAR(fit.idle_watts->value, 20.0, 1e-7);
}

TEST(Regression, MicrosecondsOfAKilowattBesideHoursOfIdle) {
  World world({"transfer", "render"}, Watts(50));
  world.idle_for(Seconds(3600));
  world.load_begins();
  std::uniform_real_distribution<double> length(0.2, 0.5);
  for (int i = 0; i < 120; ++i) {
    if (i % 3 != 0) world.run(1, Seconds(length(world.random)), Watts(2));
    if (i % 2 != 0) world.run(0, Seconds(20e-6), Watts(1000));
    world.sleep(Seconds(length(world.random)));
  }
  world.load_ends();
  world.idle_for(Seconds(3600));
  world.measure_exactly(Seconds(1));
  const PhaseFit fit = world.fit();
  ASSERT_FALSE(fit.refused);
  // 20 mJ a time, beside 400 kJ: 9 digits lie between, and 6 of them are the phase's.
  EXPECT_NEAR(fit.phases[0].watts->value, 1000.0, 0.01);
  EXPECT_NEAR(fit.phases[1].watts->value, 2.0, 1e-6);
  EXPECT_NEAR(fit.idle_watts->value, 50.0, 1e-8);
}

TEST(Regression, TinyShareOfTimeMakesAWideIntervalNotARefusal) {
  World world({"transfer", "render"}, Watts(20));
  world.load_begins();
  for (int i = 0; i < 60; ++i) {
    world.run(1, Seconds(0.4), Watts(55));
    world.sleep(Seconds(0.35));
    if (i % 15 == 7) world.run(0, Seconds(0.0005), Watts(30));
  }
  world.load_ends();
  world.measure(World::counter(Seconds(0.001), Seconds(0.05)));
  const PhaseFit fit = world.fit();
  ASSERT_FALSE(fit.refused);
  ASSERT_TRUE(fit.phases[0].watts);
  EXPECT_GT(fit.phases[0].watts->half_width, 2.0);
  EXPECT_LE(std::fabs(fit.phases[0].watts->value - 30.0), fit.phases[0].watts->half_width);
  EXPECT_LT(fit.phases[1].watts->half_width, 0.1);
}

/// Frames of always the same phases, each far shorter than the sensor's period.
World steady_loop(bool idle_windows, bool pauses) {
  World world({"build", "render"}, Watts(20));
  std::uniform_real_distribution<double> uneven(0.97, 1.03);
  if (idle_windows) world.idle_for(Seconds(10));
  world.load_begins();
  for (int i = 0; i < 3000; ++i) {
    world.run(0, Seconds(0.004) * uneven(world.random), Watts(30));
    world.run(1, Seconds(0.006) * uneven(world.random), Watts(55));
    if (pauses) world.sleep(Seconds(0.005) * uneven(world.random));
  }
  world.load_ends();
  if (idle_windows) world.idle_for(Seconds(10));
  return world;
}

TEST(Regression, SteadyLoopIsRefused) {
  for (const bool idle_windows : {false, true}) {
    for (const bool pauses : {false, true}) {
      for (const double period : {0.001, 0.1}) {
        World world = steady_loop(idle_windows, pauses);
        world.measure(World::counter(Seconds(period), Seconds(period < 0.01 ? 0.05 : 0.025)));
        const PhaseFit fit = world.fit();
        const std::string sentence =
            "build and render always ran in the same proportion: cannot be told apart";
        EXPECT_TRUE(fit.refused) << idle_windows << pauses << period << " " << fit.condition;
        EXPECT_TRUE(notes_hold(fit, sentence)) << fit.notes.front();
        EXPECT_TRUE(notes_hold(fit, "vary the mix of phases"));
        EXPECT_EQ(fit.phases[0].reason, sentence);
        EXPECT_FALSE(fit.phases[0].watts);
        EXPECT_FALSE(fit.idle_watts);
        EXPECT_GT(fit.condition, 100.0);
      }
    }
  }
}

TEST(Regression, LoopInStepWithTheSensorIsRefused) {
  // Its mix seems to vary from update to update, but only by when an update is seen.
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    World world({"build", "render"}, Watts(20), seed);
    std::uniform_real_distribution<double> uneven(0.97, 1.03);
    world.idle_for(Seconds(5));
    world.load_begins();
    for (int i = 0; i < 300; ++i) {
      world.run(0, Seconds(0.035) * uneven(world.random), Watts(30));
      world.run(1, Seconds(0.065) * uneven(world.random), Watts(55));
    }
    world.load_ends();
    SimulatedSettings settings = World::counter(Seconds(0.1), Seconds(0.025));
    settings.seed = seed;
    world.measure(settings);
    const PhaseFit fit = world.fit();
    EXPECT_TRUE(fit.refused) << seed << " " << fit.condition;
    EXPECT_TRUE(notes_hold(fit, "cannot be told apart"));
    EXPECT_FALSE(fit.phases[1].watts);
  }
}

TEST(Regression, SteadyLoopOfOnePhaseIsKnownOnceIdleIsSeen) {
  World world({"render"}, Watts(20));
  world.idle_for(Seconds(5));
  world.load_begins();
  world.run(0, Seconds(10), Watts(55));
  world.load_ends();
  world.measure_exactly(Seconds(0.05));
  EXPECT_NEAR(world.fit().phases[0].watts->value, 55.0, 1e-8);

  // Half of the time asleep in every update, and no idle windows: which half drew what?
  World half({"render"}, Watts(20));
  half.load_begins();
  for (int i = 0; i < 2000; ++i) {
    half.run(0, Seconds(0.004), Watts(55));
    half.sleep(Seconds(0.004));
  }
  half.load_ends();
  half.measure(World::counter(Seconds(0.1), Seconds(0.025)));
  const PhaseFit fit = half.fit();
  EXPECT_TRUE(fit.refused);
  EXPECT_TRUE(notes_hold(fit, "render and idle always ran in the same proportion"));
}

TEST(Regression, WithoutIdleTimeItsPowerIsPartOfThePhases) {
  World world({"build", "render"}, Watts(20));
  world.load_begins();
  for (int i = 0; i < 60; ++i) world.run(world.random() % 2, Seconds(0.31), Watts(30));
  world.load_ends();
  world.measure_exactly(Seconds(0.05));
  const PhaseFit fit = world.fit();
  ASSERT_FALSE(fit.refused);
  EXPECT_FALSE(fit.idle_watts);
  EXPECT_TRUE(notes_hold(fit, "idle power is part of the phases' watts"));
  EXPECT_NEAR(fit.phases[0].watts->value, 50.0, 1e-7);
  EXPECT_NEAR(fit.phases[1].watts->value, 50.0, 1e-7);
}

TEST(Regression, PhaseThatDrawsNothingHasAnUpperBoundOnly) {
  int stopped = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    World world({"transfer", "render"}, Watts(20), seed);
    world.idle_for(Seconds(3));
    world.load_begins();
    run_mixed(world, {Watts(0), Watts(55)}, 30);
    world.load_ends();
    SimulatedSettings settings = World::counter(Seconds(0.1), Seconds(0.025));
    settings.seed = seed;
    world.measure(settings);
    const PhaseFit fit = world.fit();
    ASSERT_FALSE(fit.refused);
    ASSERT_TRUE(fit.phases[0].watts);
    EXPECT_GE(fit.phases[0].watts->value, 0.0);
    EXPECT_GT(fit.phases[0].watts->half_width, 0.0);
    if (fit.phases[0].at_bound) {
      ++stopped;
      EXPECT_EQ(fit.phases[0].watts->value, 0.0);
      EXPECT_NE(fit.phases[0].reason.find("transfer draws at most"), std::string::npos);
    }
    EXPECT_FALSE(fit.phases[1].at_bound);
    EXPECT_NEAR(fit.phases[1].watts->value, 55.0, 2.0);
  }
  // Chance goes either way.
  EXPECT_GE(stopped, 8);
  EXPECT_LE(stopped, 22);
}

TEST(Regression, PhaseThatNoUpdateEnclosesDoesNotSpoilTheOthers) {
  World world({"build", "render"}, Watts(20));
  world.load_begins();
  world.run(0, Seconds(0.0001), Watts(30));
  for (int i = 0; i < 20; ++i) {
    world.run(1, Seconds(0.4), Watts(55));
    world.sleep(Seconds(0.3));
  }
  world.load_ends();
  world.measure_exactly(Seconds(0.05));
  const PhaseFit fit = world.fit();
  ASSERT_FALSE(fit.refused);
  EXPECT_FALSE(fit.phases[0].watts);
  EXPECT_NE(fit.phases[0].reason.find("build ran only where"), std::string::npos);
  EXPECT_NEAR(fit.phases[1].watts->value, 55.0, 1e-7);
}

TEST(Regression, TooFewUpdatesAreRefusedAndTheWayOutIsNamed) {
  World world({"build", "render"}, Watts(20));
  world.load_begins();
  world.run(0, Seconds(0.5), Watts(30));
  world.run(1, Seconds(0.5), Watts(55));
  world.sleep(Seconds(0.5));
  world.load_ends();
  world.measure(World::counter(Seconds(0.1), Seconds(0.025)));
  const PhaseFit fit = world.fit();
  EXPECT_TRUE(fit.refused);
  EXPECT_TRUE(notes_hold(fit, "measure for at least 60 update periods (6 s)"));
  EXPECT_TRUE(std::isnan(fit.condition));
  EXPECT_TRUE(fit_phases(world.info, TraceView(), world.timeline, {}, world.loaded).refused);
  EXPECT_TRUE(fit_phases(world.info, world.trace, world.timeline, {}, {}).refused);
}

TEST(Regression, GaugesAreFittedThroughTheirSmoothingAndHold) {
  for (const double smoothing : {0.0, 4.0}) {
    World world({"build", "render"}, Watts(20));
    world.idle_for(Seconds(60));
    world.load_begins();
    std::uniform_real_distribution<double> length(22.0, 35.0);
    for (int i = 0; i < 30; ++i) {
      const std::size_t column = (static_cast<std::size_t>(i) + world.random() % 2) % 3;
      if (column == 2) {
        world.sleep(Seconds(length(world.random)));
      } else {
        world.run(column, Seconds(length(world.random)), Watts(column == 0 ? 30 : 55));
      }
    }
    world.load_ends();
    world.idle_for(Seconds(60));
    SimulatedSettings settings = simulated_preset("battery");
    settings.info.smoothing = Seconds(smoothing);
    settings.noise = 0.1;
    world.measure(settings);
    const PhaseFit fit = world.fit();
    ASSERT_FALSE(fit.refused) << fit.notes.front();
    EXPECT_NEAR(fit.phases[0].watts->value, 30.0, 0.5) << smoothing;
    EXPECT_NEAR(fit.phases[1].watts->value, 55.0, 0.5) << smoothing;
    EXPECT_NEAR(fit.idle_watts->value, 20.0, 0.5) << smoothing;
    EXPECT_EQ(notes_hold(fit, "averaging is not known"), smoothing == 0.0);
  }
}

TEST(Regression, CumulativeFormBeatsDifferencesFarBelowTheirErrors) {
  // 300 updates of 100 ms with edges off by up to 25 ms at 100 W: one difference is off by 1 J of
  // 10, and 100 of them by a tenth of that; the edges of the cumulative form cancel.
  World world({"build", "render"}, Watts(20), 3);
  world.load_begins();
  run_mixed(world, {Watts(30), Watts(80)}, 75);
  world.load_ends();
  world.measure(nvml_like());
  const PhaseFit fit = world.fit();
  ASSERT_FALSE(fit.refused);
  EXPECT_GT(fit.durbin_watson, 1.5);
  EXPECT_LT(fit.phases[1].watts->half_width, 0.5);
  EXPECT_NEAR(fit.phases[1].watts->value, 80.0, 0.5);
}

}  // namespace
}  // namespace encore::energy
