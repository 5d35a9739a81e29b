#include "energy/attribution/identifiability.h"
#include "regression_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace encore::energy {
namespace {

/// What became of the figures of many runs.
struct Tally {
  int given = 0;
  int held = 0;     ///< the 95 % interval holds the truth
  int refused = 0;  ///< no number, but a reason
  double widest = 0.0;
  [[nodiscard]] double coverage() const { return given > 0 ? 1.0 * held / given : 1.0; }
};

void count(Tally& tally, const PhaseCoefficient& phase, double truth) {
  if (!phase.watts) {
    EXPECT_FALSE(phase.reason.empty()) << "no number and no reason";
    ++tally.refused;
    return;
  }
  ASSERT_TRUE(std::isfinite(phase.watts->value));
  ASSERT_TRUE(std::isfinite(phase.watts->half_width));
  EXPECT_GT(phase.watts->half_width, 0.0);
  EXPECT_GE(phase.watts->value, 0.0);
  ++tally.given;
  tally.widest = std::max(tally.widest, phase.watts->half_width);
  if (std::fabs(phase.watts->value - truth) <= phase.watts->half_width) ++tally.held;
}

/// Two phases whose ratio varies by `spread` from block to block, a third that stands alone, and
/// pauses. spread 1: each block is of one phase mostly; 0: always the same proportion.
World mixed_world(double spread, std::uint64_t seed, double scale = 1.0) {
  World world({"build", "render", "transfer"}, Watts(20 * scale), seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  world.idle_for(Seconds(4));
  world.load_begins();
  for (int block = 0; block < 40; ++block) {
    const double share = 0.5 + spread * (uniform(world.random) - 0.5);
    const double length = 0.5 + 0.2 * uniform(world.random);
    if (block % 3 == 2) {
      world.run(2, Seconds(length), Watts(10 * scale));
    } else {
      for (double at = 0.0; at < length; at += 0.01) {
        world.run(0, Seconds(0.01 * share), Watts(30 * scale));
        world.run(1, Seconds(0.01 * (1.0 - share)), Watts(55 * scale));
      }
    }
    if (block % 4 == 3) world.sleep(Seconds(0.3 + 0.3 * uniform(world.random)));
  }
  world.load_ends();
  world.idle_for(Seconds(4));
  return world;
}

constexpr double kTruth[3] = {30.0, 55.0, 10.0};

/// Fits of `runs` worlds of one spread by a counter that updates ten times a second.
struct Sweep {
  Tally phases[3];
  Tally idle;
  Sweep(double spread, std::uint64_t runs, double scale = 1.0) {
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
      World world = mixed_world(spread, seed, scale);
      SimulatedSettings settings = nvml_like();
      settings.info.energy_step = Joules(0.001 * scale);
      settings.seed = seed;
      world.measure(settings);
      const PhaseFit fit = world.fit();
      EXPECT_FALSE(fit.refused) << spread << " transfer stands alone";
      for (std::size_t c = 0; c < 3; ++c) count(phases[c], fit.phases[c], kTruth[c] * scale);
      if (!fit.idle_watts) continue;
      ++idle.given;
      const double off = std::fabs(fit.idle_watts->value - 20.0 * scale);
      idle.held += off <= fit.idle_watts->half_width ? 1 : 0;
    }
  }
};

TEST(NearCollinear, EveryNumberThatIsGivenHoldsTheTruthAtItsRate) {
  constexpr std::uint64_t kRuns = 30;
  for (const double spread : {1.0, 0.2, 0.05, 0.02, 0.01, 1e-6, 0.0}) {
    const Sweep sweep(spread, kRuns);
    for (const Tally& tally : sweep.phases) {
      EXPECT_EQ(tally.given + tally.refused, static_cast<int>(kRuns));
      // Few are given at the edge of the gate.
      const bool many = tally.given >= 20;
      EXPECT_TRUE(!many || tally.coverage() >= 0.86) << spread << ' ' << tally.coverage();
      EXPECT_LT(tally.widest, 6.0) << spread << " an interval that says nothing";
    }
    EXPECT_GE(sweep.phases[0].given, spread >= 0.05 ? static_cast<int>(kRuns) : 0) << spread;
    EXPECT_LE(sweep.phases[0].given, spread <= 0.01 ? 0 : static_cast<int>(kRuns)) << spread;
    EXPECT_EQ(sweep.phases[0].given, sweep.phases[1].given) << "both or none";
    // What stands alone does not suffer from the two that do not.
    EXPECT_EQ(sweep.phases[2].given, static_cast<int>(kRuns)) << spread;
    EXPECT_EQ(sweep.idle.given, static_cast<int>(kRuns)) << spread;
    EXPECT_GE(sweep.idle.coverage(), 0.86) << spread;
    EXPECT_LT(sweep.phases[2].widest, 0.4) << spread;
  }
}

TEST(NearCollinear, WattsOfAnySizeAreJudgedAlike) {
  for (const double scale : {1e-9, 1e9}) {
    const Sweep apart(1.0, 12, scale);
    EXPECT_EQ(apart.phases[0].given, 12) << scale;
    EXPECT_GE(apart.phases[0].held, 10) << scale;
    EXPECT_LT(apart.phases[0].widest, 0.5 * scale) << scale;
    const Sweep alike(1e-3, 12, scale);
    EXPECT_EQ(alike.phases[0].refused, 12) << scale;
    EXPECT_EQ(alike.phases[2].given, 12) << scale;
    EXPECT_GE(alike.phases[2].held, 10) << scale;
  }
}

TEST(NearCollinear, ThoseAlikeSaySoAndWhatTheyDrawTogether) {
  World world = mixed_world(0.0, 5);
  world.measure(nvml_like());
  const PhaseFit fit = world.fit();
  for (const std::size_t c : {0U, 1U}) {
    EXPECT_FALSE(fit.phases[c].watts);
    EXPECT_EQ(fit.phases[c].reason.find("build and render always ran in the same proportion: "
                                        "cannot be told apart; together 42."),
              0U)
        << fit.phases[c].reason;
  }
  EXPECT_TRUE(fit.phases[2].reason.empty()) << fit.phases[2].reason;
  EXPECT_NEAR(fit.phases[2].watts->value, 10.0, 0.3);
  EXPECT_LT(fit.condition, kSoundCondition) << "of the fit that was made";
}

TEST(NearCollinear, ColumnsThatAreTheSameAreOne) {
  // Two columns that run at the very same times: only their sum can be known.
  World world({"cpu", "gpu", "transfer"}, Watts(20), 3);
  std::uniform_real_distribution<double> length(0.3, 0.5);
  world.idle_for(Seconds(3));
  world.load_begins();
  for (int i = 0; i < 60; ++i) {
    if (i % 3 == 0) world.run(2, Seconds(length(world.random)), Watts(10));
    if (i % 3 == 1) world.run_both(0, 1, Seconds(length(world.random)), Watts(70));
    if (i % 3 == 2) world.sleep(Seconds(length(world.random)));
  }
  world.load_ends();
  world.idle_for(Seconds(3));
  world.measure_exactly(Seconds(0.05));
  const PhaseFit fit = world.fit();
  ASSERT_FALSE(fit.refused);
  EXPECT_FALSE(fit.phases[0].watts);
  EXPECT_FALSE(fit.phases[1].watts);
  EXPECT_NE(fit.phases[0].reason.find("cannot be told apart"), std::string::npos);
  EXPECT_NEAR(fit.phases[2].watts->value, 10.0, 1e-6);
  EXPECT_NEAR(fit.idle_watts->value, 20.0, 1e-6);
}

TEST(NearCollinear, AMillionthOfTheTimeIsAWideIntervalOrAReason) {
  Tally rare;
  Tally often;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    World world({"update", "render"}, Watts(20), seed);
    std::uniform_real_distribution<double> length(0.3, 0.5);
    world.idle_for(Seconds(4));
    world.load_begins();
    for (int i = 0; i < 60; ++i) {
      if (i % 10 == 5) world.run(0, Seconds(5e-6), Watts(30));
      if (i % 2 == 0) world.run(1, Seconds(length(world.random)), Watts(55));
      if (i % 2 == 1) world.sleep(Seconds(length(world.random)));
    }
    world.load_ends();
    world.idle_for(Seconds(4));
    SimulatedSettings settings = nvml_like();
    settings.seed = seed;
    world.measure(settings);
    const PhaseFit fit = world.fit();
    count(rare, fit.phases[0], 30.0);
    count(often, fit.phases[1], 55.0);
  }
  EXPECT_GE(rare.held, rare.given - 2);
  EXPECT_EQ(often.given, 20);
  EXPECT_GE(often.held, 18);
  EXPECT_LT(often.widest, 0.5);
}

TEST(NearCollinear, JoinsPairsAsLongAsSomethingStandsAlone) {
  const auto joined = join_pair({}, 4, {3, 1});
  ASSERT_TRUE(joined);
  EXPECT_EQ(*joined, (ColumnGroups{{0}, {1, 3}, {2}}));
  const auto again = join_pair(*joined, 4, {1, 2});
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, (ColumnGroups{{0}, {1, 3, 2}}));
  EXPECT_FALSE(join_pair(*again, 4, {0, 1})) << "nothing would stand alone";
  EXPECT_FALSE(join_pair({}, 3, {1, 3})) << "idle time is no phase";
  EXPECT_FALSE(join_pair({}, 4, {0, 1, 2})) << "no pair";
}

}  // namespace
}  // namespace encore::energy
