#include "energy/attribution/excitation.h"

#include "energy/attribution/regression.h"
#include "regression_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace encore::energy {
namespace {

PerPhase<Seconds> some_times() {
  PerPhase<Seconds> times{};
  times[Phase::animate] = Seconds(0.0001);
  times[Phase::build] = Seconds(0.03);
  times[Phase::transfer] = Seconds(0.002);
  times[Phase::render] = Seconds(0.8);
  return times;
}

const std::vector<Phase> kAll{Phase::build, Phase::render, Phase::transfer, Phase::animate};

TEST(Excitation, EveryBlockOutlastsFiveUpdatesAndAllFitTheBudget) {
  const auto times = some_times();
  for (const double period : {0.05, 0.1, 4.5}) {
    const auto blocks = make_mix_blocks(kAll, times, Seconds(period), Seconds(400), 3);
    ASSERT_FALSE(blocks.empty());
    Seconds sum;
    std::size_t sleeps = 0;
    for (const MixBlock& block : blocks) {
      EXPECT_GE(block.length(times).value, 5.0 * period * (1 - 1e-12));
      sum += block.length(times);
      sleeps += block.sleep.value > 0.0 ? 1 : 0;
    }
    EXPECT_LE(sum.value, 400.0);
    EXPECT_GE(sum.value, 200.0);
    EXPECT_EQ(sleeps * 5, blocks.size());
  }
}

TEST(Excitation, EachPhaseRunsInEveryRoundInChangingOrder) {
  const auto blocks = make_mix_blocks(kAll, some_times(), Seconds(0.1), Seconds(300), 4);
  bool order_changed = false;
  for (std::size_t round = 0; round + 5 <= blocks.size(); round += 5) {
    PerPhase<std::size_t> ran{};
    for (std::size_t i = round; i < round + 5; ++i) {
      for (const Phase phase : kAll) ran[phase] += blocks[i].repeats[phase] > 0 ? 1 : 0;
      order_changed = order_changed || (blocks[i].repeats[Phase::build] > 0) !=
                                           (blocks[i - round].repeats[Phase::build] > 0);
    }
    for (const Phase phase : kAll) EXPECT_EQ(ran[phase], 1U);
  }
  EXPECT_TRUE(order_changed);
}

TEST(Excitation, EqualSeedsGiveEqualBlocks) {
  const auto lengths = [&](std::uint64_t seed) {
    std::vector<double> found;
    for (const MixBlock& b :
         make_mix_blocks(kAll, some_times(), Seconds(0.1), Seconds(100), seed)) {
      found.push_back(b.length(some_times()).value);
    }
    return found;
  };
  EXPECT_EQ(lengths(7), lengths(7));
  EXPECT_NE(lengths(7), lengths(8));
}

TEST(Excitation, WithoutTimeOrPhasesThereAreNoBlocks) {
  EXPECT_TRUE(make_mix_blocks(kAll, some_times(), Seconds(0.1), Seconds(5), 1).empty());
  EXPECT_TRUE(make_mix_blocks({}, some_times(), Seconds(0.1), Seconds(100), 1).empty());
  EXPECT_TRUE(make_mix_blocks(kAll, {}, Seconds(0.1), Seconds(100), 1).empty());
  // One that never ran is left out, doubles count once.
  const std::vector<Phase> phases{Phase::build, Phase::update, Phase::build};
  const auto blocks = make_mix_blocks(phases, some_times(), Seconds(0.1), Seconds(60), 1);
  ASSERT_FALSE(blocks.empty());
  EXPECT_EQ(blocks.size() % 2, 0U);
  for (const MixBlock& block : blocks) EXPECT_EQ(block.repeats[Phase::update], 0U);
}

TEST(Excitation, ASourceIsNoFasterThanItIsPolled) {
  SourceInfo source;
  source.update_period = Seconds(0.001);
  source.poll_period = Seconds(0.05);
  const auto times = some_times();
  const std::vector<Phase> phases{Phase::transfer};
  for (const MixBlock& block : make_mix_blocks(phases, times, source, Seconds(10), 1)) {
    EXPECT_GE(block.length(times).value, 0.25 * (1 - 1e-12));
  }
}

TEST(Excitation, ItsDesignsAreWellConditioned) {
  for (const std::size_t count : {2U, 3U, 4U}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const std::vector<Phase> phases(kAll.begin(),
                                      kAll.begin() + static_cast<std::ptrdiff_t>(count));
      std::vector<std::string> names;
      for (const Phase phase : phases) names.emplace_back(to_string(phase));
      World world(names, Watts(20), seed);
      SimulatedSettings settings = World::counter(Seconds(0.1), Seconds(0.025));
      settings.seed = seed;
      const auto blocks =
          make_mix_blocks(phases, some_times(), settings.info.update_period, Seconds(60), seed);
      world.load_begins();
      run_blocks(world, blocks, phases, some_times(), std::vector<Watts>(count, Watts(30)));
      world.load_ends();
      world.measure(settings);
      const PhaseFit fit = world.fit();
      EXPECT_FALSE(fit.refused);
      EXPECT_LT(fit.condition, 10.0) << count << " " << seed;
      RecordProperty("condition_" + std::to_string(count), std::to_string(fit.condition));
      for (std::size_t c = 0; c < count; ++c) {
        EXPECT_NEAR(fit.phases[c].watts->value, 30.0, 1.0) << count << " " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace encore::energy
