// Policy auto by measured costs, on made-up machines: what it pays in the end, against every fixed
// period in hindsight. No clock is read; noise is seeded.
#include "accel/auto_policy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>

namespace encore::accel {
namespace {

constexpr int kFrames = 1500;

/// A machine and a moving scene on it. `decay(frame, age)` is the SAH cost of a tree built `age`
/// frames ago over that of one built now, `fresh(frame)` what tracing a fresh one costs; each
/// further unit of decay costs `slope` times as much again.
struct World {
  std::function<double(int frame, int age)> decay;
  std::function<double(int frame)> fresh = [](int) { return 10.0; };
  double build = 4.0;
  double update = 1.0;
  double slope = 0.8;
  /// SAH cost of a tree built in that frame.
  std::function<double(int frame)> fresh_tree = [](int) { return 30.0; };
  double noise = 0.0;  ///< standard deviation of each measured cost, relative

  [[nodiscard]] double trace(int frame, int age) const {
    return fresh(frame) * (1.0 + slope * std::max(0.0, decay(frame, age) - 1.0));
  }
  [[nodiscard]] double tree(int frame, int age) const {
    return fresh_tree(frame) * decay(frame, age);
  }
  [[nodiscard]] double fixed(int period) const {
    double total = 0.0;
    int age = 0;
    for (int i = 1; i <= kFrames; ++i) {
      age = i % period == 0 ? 0 : age + 1;
      total += (age == 0 ? build : update) + trace(i, age);
    }
    return total;
  }
  [[nodiscard]] double best_fixed() const {
    double best = fixed(1);
    for (int period = 2; period <= 2 * kFrames; period += 1 + period / 8) {
      best = std::min(best, fixed(period));
    }
    return best;
  }
};

struct Outcome {
  double total = 0.0;
  int builds = 0;
  double slope = 0.0;
};

Outcome play(const World& world, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto seen = [&](double cost) {
    return cost * std::max(0.2, 1.0 + world.noise * normal(random));
  };
  AutoPolicy policy;
  policy.observe_build(seen(world.build));
  policy.observe_frame(seen(world.trace(0, 0)), world.tree(0, 0));
  Outcome outcome;
  int age = 0;
  for (int i = 1; i <= kFrames; ++i) {
    if (policy.builds_next().value()) {
      age = 0;
      ++outcome.builds;
      outcome.total += world.build;
      policy.observe_build(seen(world.build));
    } else {
      ++age;
      outcome.total += world.update;
      policy.observe_update(seen(world.update));
    }
    const double traced = world.trace(i, age);
    outcome.total += traced;
    policy.observe_frame(seen(traced), world.tree(i, age));
  }
  outcome.slope = policy.slope();
  return outcome;
}

/// At most 5 % above the best period and above building always.
void expect_cheap(const char* what, const World& world, int seeds = 1) {
  const double best = world.best_fixed();
  const double always = world.fixed(1);
  for (int seed = 1; seed <= seeds; ++seed) {
    const Outcome outcome = play(world, static_cast<std::uint64_t>(seed));
    EXPECT_LE(outcome.total, 1.05 * best)
        << what << ", seed " << seed << ", " << outcome.builds << " builds, slope " << outcome.slope
        << ", of always " << outcome.total / always;
    EXPECT_LE(outcome.total, 1.05 * always) << what << ", seed " << seed;
  }
}

double steady(int, int age) {
  return 1.0 + 0.03 * age;
}

TEST(AutoPolicy, FindsThePeriodOfSteadyDecay) {
  expect_cheap("steady", {.decay = steady});
  // n e(n) - sum e = D has its solution at n = sqrt(2 D / growth of e).
  const Outcome outcome = play({.decay = steady});
  const double period = std::sqrt(2.0 * 3.0 / (10.0 * 0.8 * 0.03));
  EXPECT_NEAR(kFrames / double(outcome.builds), period, 1.0);
  for (const double build : {1.2, 10.0, 100.0}) {
    for (const double growth : {0.001, 0.01, 0.3}) {
      World world{.decay = [=](int, int age) { return 1.0 + growth * age; }};
      world.build = build;
      expect_cheap("steady", world);
    }
  }
}

TEST(AutoPolicy, FitsTheSlopeOfTracingOverDecay) {
  for (const double slope : {0.1, 0.4, 1.6, 3.0}) {
    World world{.decay = steady};
    world.slope = slope;
    expect_cheap("slope", world);
    EXPECT_NEAR(play(world).slope, slope, 0.15 * slope + 0.02);
  }
}

TEST(AutoPolicy, HoldsUnderNoise) {
  for (const double noise : {0.05, 0.2}) {
    for (const double growth : {0.01, 0.05}) {
      World world{.decay = [=](int, int age) { return 1.0 + growth * age; }};
      world.noise = noise;
      expect_cheap("noise", world, 20);
    }
  }
}

TEST(AutoPolicy, SpikesDoNotTeachItNonsense) {
  AutoPolicy policy;
  policy.observe_build(4.0);
  policy.observe_frame(10.0, 1.0);
  for (int i = 1; i <= 200; ++i) {
    const bool builds = policy.builds_next().value();
    const double spike = i % 17 == 0 ? 20.0 : 1.0;
    if (builds) policy.observe_build(4.0 * spike);
    if (!builds) policy.observe_update(1.0 * spike);
    policy.observe_frame((builds ? 10.0 : 10.8) * (i % 13 == 0 ? 15.0 : 1.0), builds ? 1.0 : 1.1);
  }
  EXPECT_NEAR(policy.build_surplus().value(), 3.0, 1e-9);
  EXPECT_GT(policy.slope(), 0.2);
  EXPECT_LT(policy.slope(), 3.0);
}

TEST(AutoPolicy, AnswersASuddenExplosion) {
  // All is still good for 700 frames, then the tree falls apart within a few.
  expect_cheap("explosion", {.decay = [](int frame, int age) {
                 const int flown = std::min(age, std::max(0, frame - 700));
                 return 1.0 + 0.5 * flown;
               }});
  // Once torn, any tree that is older costs five times as much.
  expect_cheap("rupture", {.decay = [](int frame, int age) {
                 return frame >= 700 && frame - age < 700 ? 6.0 : 1.0;
               }});
  // A loop that begins anew every 120 frames.
  expect_cheap("loop", {.decay = [](int frame, int age) {
                 const int phase = frame % 120;
                 return age > phase ? 2.5 : 1.0 + 0.02 * age;
               }});
}

TEST(AutoPolicy, BuildsHardlyEverWhereNothingDecays) {
  for (const double noise : {0.0, 0.2}) {
    World world{.decay = [](int, int) { return 1.0; }};
    world.noise = noise;
    expect_cheap("no decay", world, 5);
    EXPECT_EQ(play(world).builds, 0);
    // Decay that means nothing for this view: only trials, which are cheap.
    world.decay = steady;
    world.slope = 0.0;
    expect_cheap("harmless decay", world, 5);
  }
}

TEST(AutoPolicy, BuildsAlwaysWhereABuildIsTheCheaperOfTheTwo) {
  World world{.decay = steady};
  world.build = 1.0;
  world.update = 2.0;
  for (const double noise : {0.0, 0.2}) {
    world.noise = noise;
    expect_cheap("cheap build", world, 5);
    EXPECT_GT(play(world).builds, kFrames * 9 / 10);
  }
  // And where the first frame's excess is dearer than it.
  world = {.decay = [](int, int age) { return age == 0 ? 1.0 : 2.0; }};
  expect_cheap("decays at once", world);
  EXPECT_GT(play(world).builds, kFrames * 9 / 10);
}

TEST(AutoPolicy, FollowsCostsThatJumpWithTheView) {
  const auto jumping = [](int frame) { return frame / 250 % 2 == 0 ? 40.0 : 4.0; };
  for (const double noise : {0.0, 0.1}) {
    expect_cheap("view", {.decay = steady, .fresh = jumping, .noise = noise}, 5);
    expect_cheap("drift",
                 {.decay = steady,
                  .fresh = [](int frame) { return 10.0 * (1.0 + 0.9 * std::sin(0.02 * frame)); },
                  .noise = noise},
                 5);
  }
}

TEST(AutoPolicy, FollowsDecayThatComesAndGoes) {
  // A wave: after half a period the tree is as good as fresh again.
  expect_cheap("wave", {.decay = [](int, int age) {
                 return 1.0 + 0.07 * (1.0 - std::cos(2.0 * 3.14159265 * age / 60.0));
               }});
}

/// A scene that flies apart: an updated tree costs what it did after its build, but a fresh one
/// would cost less and less; tracing grows dearer all the while. Every 120 frames it starts anew.
TEST(AutoPolicy, SeesThatAFreshTreeWouldHaveBecomeBetter) {
  World world{
      .decay = [](int frame, int age) { return std::exp(0.004 * std::min(age, frame % 120)); }};
  world.fresh_tree = [](int frame) { return 39.0 * std::exp(-0.004 * (frame % 120)); };
  world.fresh = [](int frame) { return 2.0 + 0.05 * (frame % 120); };
  world.build = 0.16;
  world.update = 0.04;
  for (const double noise : {0.0, 0.05}) {
    world.noise = noise;
    expect_cheap("fresh trees get better", world, 5);
    EXPECT_GT(play(world).builds, kFrames / 40);
  }
  // And where a build is dear, so that there are few trials.
  world.build = 4.0;
  world.update = 1.0;
  expect_cheap("dear builds", world, 5);
}

TEST(AutoPolicy, AFreshTreeThatBecomesWorseIsNotTakenForDecay) {
  World world{.decay = [](int, int age) { return 1.0 + 0.001 * age; }};
  world.fresh_tree = [](int frame) { return 20.0 * std::exp(0.01 * (frame % 120)); };
  world.fresh = [](int frame) { return 10.0 + 0.1 * (frame % 120); };
  world.build = 20.0;
  expect_cheap("fresh trees get worse", world, 5);
}

TEST(SteadyRate, BelievesWhatTwoLooksAgreeOn) {
  SteadyRate rate;
  EXPECT_EQ(rate.over(10), 1.0);
  rate.add(1.21, 2);
  EXPECT_EQ(rate.over(10), 1.0) << "seen once";
  rate.add(1.5, 1);
  EXPECT_NEAR(rate.over(1), 1.1, 1e-12) << "the lesser of the two";
  EXPECT_NEAR(rate.over(2), 1.21, 1e-12);
  EXPECT_EQ(rate.over(1000), 2.0);
  rate.add(0.01, 3);
  EXPECT_EQ(rate.over(5), 1.0) << "a jump back";
  rate.add(0.9, 1);
  EXPECT_NEAR(rate.over(1), 0.9, 1e-12);
  rate.add(0.0, 1);
  rate.add(std::nan(""), 1);
  rate.add(2.0, 0);
  EXPECT_NEAR(rate.over(1), 0.9, 1e-12) << "what measures nothing changes nothing";
}

TEST(AutoPolicy, ATreeWhoseCostIsUnknownDoesNotDecay) {
  AutoPolicy policy;
  policy.observe_build(5.0);
  policy.observe_frame(10.0, std::nullopt);
  for (int i = 0; i < 3; ++i) {
    policy.observe_update(1.0);
    policy.observe_frame(20.0, i == 1 ? std::optional(7.0) : std::nullopt);
    EXPECT_EQ(policy.excess(), 0.0);
    EXPECT_FALSE(policy.builds_next().value());
  }
  // A flat tree that is flat no more is beyond comparison.
  policy.observe_build(5.0);
  policy.observe_frame(10.0, 0.0);
  policy.observe_update(1.0);
  policy.observe_frame(10.0, 3.0);
  EXPECT_TRUE(policy.builds_next().value());
}

TEST(AutoPolicy, SecondsAndJoulesDecideAlike) {
  World world{.decay = steady};
  const Outcome seconds = play(world);
  world.fresh = [](int) { return 10.0 * 37.5; };
  world.build *= 37.5;
  world.update *= 37.5;
  EXPECT_EQ(play(world).builds, seconds.builds);
}

TEST(AutoPolicy, KnowsNothingBeforeItHasMeasured) {
  AutoPolicy policy;
  EXPECT_FALSE(policy.builds_next());
  EXPECT_FALSE(policy.break_even_frames());
  policy.observe_build(0.0);  // a clock that stands still measures nothing
  policy.observe_frame(10.0, 1.0);
  EXPECT_FALSE(policy.builds_next());
  policy.observe_build(5.0);
  EXPECT_FALSE(policy.builds_next().value()) << "an update is not known yet";
  EXPECT_FALSE(policy.build_surplus());
  AutoPolicy by_quality(AutoRule::quality);
  by_quality.observe_build(5.0);
  by_quality.observe_update(1.0);
  by_quality.observe_frame(10.0, 1.0);
  EXPECT_FALSE(by_quality.builds_next());
}

TEST(AutoPolicy, TellsWhenABuildWouldHavePaid) {
  AutoPolicy policy;
  policy.observe_build(5.0);
  policy.observe_frame(10.0, 1.0);
  EXPECT_FALSE(policy.break_even_frames());
  policy.observe_update(1.0);
  policy.observe_frame(10.0, 1.0);
  EXPECT_FALSE(policy.break_even_frames()) << "nothing to win back";
  policy.observe_update(1.0);
  const double growth = 1.0 + policy.slope() * 0.5;
  policy.observe_frame(10.0 * growth, 1.5);
  EXPECT_NEAR(policy.excess().value(), 10.0 * (growth - 1.0), 1e-9);
  EXPECT_NEAR(policy.break_even_frames().value(), 4.0 / (10.0 * (growth - 1.0)), 1e-9);
  const auto then = policy.break_even_frames();
  policy.observe_build(5.0);
  EXPECT_EQ(policy.figures().break_even_at_rebuild, then);
  EXPECT_EQ(policy.figures().rebuilds, 2U);
  policy.clear_figures();
  EXPECT_FALSE(policy.figures().break_even_at_rebuild);
  EXPECT_EQ(policy.figures().rebuilds, 0U);
  EXPECT_TRUE(policy.build_surplus()) << "what was learned stays";
}

}  // namespace
}  // namespace encore::accel
