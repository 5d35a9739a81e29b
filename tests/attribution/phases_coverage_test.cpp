#include "tests/attribution/simulated_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// The energy of a phase: in 95 of 100 measurements the truth lies inside its interval.

namespace encore::energy {
namespace {

constexpr double kIdle = 10.0;
constexpr double kBuild = 25.0;  // watts above idle
constexpr double kRender = 40.0;

struct Measurement {
  std::shared_ptr<StepPower> power;
  std::unique_ptr<SimulatedSource> source;
  BusyTimeline busy{{"build", "render"}};
  AttributionInput input;
  std::vector<std::pair<Window, std::size_t>> spans;  ///< which column ran when
};

/// Runs blocks one after the other: a column and its length, drawn by `next_block`.
struct Block {
  std::size_t column = 0;
  double seconds = 0.0;
};

Measurement simulate(SimulatedSettings sensor, double pad, double length, std::uint64_t seed,
                     const std::function<Block(std::mt19937_64&)>& next_block) {
  std::mt19937_64 random(seed);
  const Seconds start(1000.0 + std::uniform_real_distribution<double>(0.0, 10.0)(random));
  const Seconds from = start + Seconds(pad);
  Measurement m;
  m.power = std::make_shared<StepPower>(start, Watts(kIdle));
  add_idle(kIdle, from, random, *m.power);
  while (m.power->end() < from + Seconds(length)) {
    const Block block = next_block(random);
    Load load;
    load.watts = kIdle + (block.column == 0 ? kBuild : kRender);
    load.seconds = 0.02;
    load.slow = 0.0;
    const Seconds begin = m.power->end();
    BusyTimeline ignored({"all"});
    add_load(load, begin + Seconds(block.seconds), random, *m.power, ignored, 0);
    m.busy.add(block.column, begin, m.power->end());
    m.busy.add_operations(1.0, begin, m.power->end());
    m.spans.push_back({{begin, m.power->end()}, block.column});
  }
  const Seconds to = m.power->end();
  const Seconds end = to + Seconds(pad);
  add_idle(kIdle, end, random, *m.power);
  sensor.seed = seed * 7919 + 1;
  sensor.info.gain_uncertainty = 0.0;
  sensor.energy_until = [power = m.power](Seconds time) { return power->energy_until(time); };
  m.source = std::make_unique<SimulatedSource>(std::move(sensor));
  m.input.source = &m.source->info();
  m.input.trace = read_trace(*m.source, start, end, {from, to}, 0.004, seed * 31 + 5);
  m.input.busy = &m.busy;
  m.input.measured = {{from, to}};
  m.input.idle = {{start, from}, {to, end}};
  return m;
}

double true_gross(const Measurement& m, std::size_t column) {
  double joules = 0.0;
  for (const auto& [span, owner] : m.spans) {
    if (owner == column) joules += m.source->true_energy(span.from, span.to).value;
  }
  return joules;
}

void expect_95_percent(const std::string& what, double share) {
  ::testing::Test::RecordProperty(what, fmt::format("{:.3f}", share));
  EXPECT_GE(share, 0.93) << what;
  EXPECT_LE(share, 0.97) << what;
}

TEST(PhaseCoverage, LongPhasesReadAtTheirEdges) {
  constexpr int kRuns = 500;
  double held[2] = {0, 0};
  double width = 0;
  for (int i = 0; i < kRuns; ++i) {
    std::size_t turn = 0;
    const Measurement m = simulate(
        simulated_preset("rapl"), 5.0, 20.0, static_cast<std::uint64_t>(i) + 1,
        [&](std::mt19937_64& random) {
          turn = 1 - turn;
          const double mean = turn == 0 ? 0.8 : 2.0;
          return Block{turn, mean * std::uniform_real_distribution<double>(0.7, 1.3)(random)};
        });
    const Attribution a = attribute(m.input);
    ASSERT_EQ(a.phases.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(a.phases[k].method, AttributionMethod::windows) << a.phases[k].reason;
      const Uncertain& gross = *a.phases[k].gross;
      const bool holds = std::fabs(gross.value - true_gross(m, k)) <= gross.half_width;
      held[k] += holds ? 1.0 / kRuns : 0.0;
      width += gross.half_width / gross.value / kRuns / 2;
    }
  }
  RecordProperty("half_width_percent", fmt::format("{:.3f}", 100 * width));
  expect_95_percent("build", held[0]);
  expect_95_percent("render", held[1]);
}

TEST(PhaseCoverage, ShortPhasesFittedOverVariedMixes) {
  constexpr int kRuns = 300;
  double held[2] = {0, 0};
  double width = 0;
  int fitted = 0;
  for (int i = 0; i < kRuns; ++i) {
    double share = 0.5;
    double left = 0.0;
    const Measurement m = simulate(
        simulated_preset("nvml"), 10.0, 40.0, static_cast<std::uint64_t>(i) + 1,
        [&](std::mt19937_64& random) {
          // For some seconds most spans are of one kind, then of the other: the mix varies.
          std::uniform_real_distribution<double> uniform(0.0, 1.0);
          if (left <= 0) {
            share = 0.15 + 0.7 * uniform(random);
            left = 1.0;
          }
          const Block block{uniform(random) < share ? 0U : 1U, 0.02 + 0.04 * uniform(random)};
          left -= block.seconds;
          return block;
        });
    const Attribution a = attribute(m.input);
    ASSERT_EQ(a.phases.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      const PhaseEnergy& phase = a.phases[k];
      if (phase.method != AttributionMethod::regression || !phase.net) {
        fmt::print("{} {} {} {}\n", i, k, to_string(phase.method), phase.reason);
        for (auto& n : a.notes) fmt::print("   {}\n", n);
        continue;
      }
      ++fitted;
      const double truth = (k == 0 ? kBuild : kRender) * phase.busy.value;
      const bool holds = std::fabs(phase.net->value - truth) <= phase.net->half_width;
      held[k] += holds ? 1.0 / kRuns : 0.0;
      width += phase.net->half_width / phase.net->value / kRuns / 2;
    }
  }
  EXPECT_EQ(fitted, 2 * kRuns);
  RecordProperty("half_width_percent", fmt::format("{:.3f}", 100 * width));
  expect_95_percent("build", held[0]);
  expect_95_percent("render", held[1]);
}

}  // namespace
}  // namespace encore::energy
