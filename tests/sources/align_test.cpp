// A recording finds its place on the session's clock, or is refused with a reason.
#include "energy/sampling/align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace encore::energy {
namespace {

/// Busy and idle times of irregular lengths from second 1000 on.
std::vector<PhaseSpan> irregular_load(int count, unsigned seed, double idle = 3.0) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> busy_length(0.5, 4.0);
  std::uniform_real_distribution<double> idle_length(0.3, idle);
  std::vector<PhaseSpan> spans;
  double time = 1010.0;
  for (int i = 0; i < count; ++i) {
    const double end = time + busy_length(random);
    spans.push_back({Phase::render, Seconds(time), Seconds(end)});
    time = end + idle_length(random);
  }
  return spans;
}

std::vector<PhaseSpan> periodic_load(int count, double period) {
  std::vector<PhaseSpan> spans;
  for (int i = 0; i < count; ++i) {
    const double start = 1010.0 + period * i;
    spans.push_back({Phase::render, Seconds(start), Seconds(start + period / 2)});
  }
  return spans;
}

/// What a meter on a clock of its own (session minus `offset`) records of a load in [from, to] of
/// the session: 20 W, 45 W while busy, noise, one row each `spacing`.
struct Meter {
  double offset = 0.0;
  double spacing = 0.1;
  double noise = 0.0;
  double smoothing = 0.0;
  unsigned seed = 1;
};
TraceView record(const std::vector<PhaseSpan>& spans, double from, double to, const Meter& meter) {
  std::mt19937_64 random(meter.seed);
  std::normal_distribution<double> normal;
  std::vector<TracePoint> points;
  Joules energy;
  double shown = 20.0;
  double last = 0;
  std::size_t span = 0;
  for (double time = from; time <= to; time += meter.spacing) {
    while (span < spans.size() && spans[span].end.value < time) ++span;
    const bool busy = span < spans.size() && spans[span].start.value <= time;
    const double true_watts = busy ? 45.0 : 20.0;
    shown += meter.smoothing > 0
                 ? (true_watts - shown) * -std::expm1(-meter.spacing / meter.smoothing)
                 : true_watts - shown;
    const double watts = std::max(0.0, shown + meter.noise * normal(random));
    if (!points.empty()) energy += Watts((watts + last) / 2) * Seconds(meter.spacing);
    last = watts;
    points.push_back({Seconds(time - meter.offset), energy, Watts(watts), true, points.empty()});
  }
  return TraceView(points);
}

TEST(Align, FindsTheOffsetWithinItsUncertainty) {
  const auto load = irregular_load(40, 3);
  const double end = load.back().end.value + 10;
  for (const double offset : {0.0, 137.42, -6311.77, 1.6e9}) {
    const TraceView recording = record(load, 1000, end, {.offset = offset, .noise = 1.0});
    const AlignmentResult result = align(load, Seconds(1000), Seconds(end), recording);
    ASSERT_TRUE(result.alignment) << result.reason;
    EXPECT_NEAR(result.alignment->offset.value, offset, 3 * result.alignment->uncertainty.value);
    EXPECT_LT(result.alignment->uncertainty.value, 0.1);
    EXPECT_GT(result.alignment->correlation, 0.95);
    EXPECT_NEAR(result.alignment->overlap.value, end - 1000, 1.0);
  }
}

TEST(Align, TheUncertaintyCoversTheError) {
  // Many recordings with noise: the errors' root mean square is what the uncertainty promises, or
  // less; and it is not a boundless promise.
  double squares = 0;
  double promised = 0;
  constexpr int kRuns = 40;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    const auto load = irregular_load(15, 100 + seed);
    const double end = load.back().end.value + 8;
    const double offset = 50.0 + 0.0137 * seed;
    const TraceView recording =
        record(load, 1000, end, {.offset = offset, .spacing = 0.2, .noise = 8.0, .seed = seed});
    const AlignmentResult result = align(load, Seconds(1000), Seconds(end), recording);
    ASSERT_TRUE(result.alignment) << result.reason;
    const double error = result.alignment->offset.value - offset;
    squares += error * error / kRuns;
    promised += std::pow(result.alignment->uncertainty.value, 2) / kRuns;
  }
  EXPECT_LT(std::sqrt(squares), 1.3 * std::sqrt(promised));
  EXPECT_GT(std::sqrt(squares), 0.1 * std::sqrt(promised));
}

TEST(Align, TheTopOfThePeakIsFoundBetweenSteps) {
  // Rows are a second apart and steps half of that; both meters smooth alike.
  const auto load = irregular_load(60, 21);
  const double end = load.back().end.value + 10;
  const TraceView reference = record(load, 1000, end, {.spacing = 1.0, .smoothing = 3.0});
  double squares = 0;
  for (int tenth = 0; tenth < 10; ++tenth) {
    const TraceView recording =
        record(load, 1000 + 0.1 * tenth, end, {.offset = 7.0, .spacing = 1.0, .smoothing = 3.0});
    const AlignmentResult result = align(reference, recording);
    ASSERT_TRUE(result.alignment) << result.reason;
    squares += std::pow(result.alignment->offset.value - 7.0, 2) / 10;
  }
  // Whole steps alone leave 0.17 s.
  EXPECT_LT(std::sqrt(squares), 0.12);
}

TEST(Align, ARecordingMayBeginLateOrRunOn) {
  const auto load = irregular_load(40, 4);
  const double end = load.back().end.value + 10;
  for (const auto& [from, to] : {std::pair(1000.0 - 300, end + 500), std::pair(1020.0, end - 15)}) {
    const TraceView recording = record(load, from, to, {.offset = -80.25, .noise = 2.0});
    const AlignmentResult result = align(load, Seconds(1000), Seconds(end), recording);
    ASSERT_TRUE(result.alignment) << result.reason;
    EXPECT_NEAR(result.alignment->offset.value, -80.25, 0.1);
  }
}

TEST(Align, AnotherTraceOfTheSessionServesAsWell) {
  const auto load = irregular_load(40, 5);
  const double end = load.back().end.value + 10;
  const TraceView counter = record(load, 1000, end, {.spacing = 0.05, .noise = 3.0, .seed = 8});
  const TraceView recording = record(load, 990, end + 5, {.offset = 33.3, .noise = 3.0, .seed = 9});
  const AlignmentResult result = align(counter, recording);
  ASSERT_TRUE(result.alignment) << result.reason;
  EXPECT_NEAR(result.alignment->offset.value, 33.3, 0.1);
}

TEST(Align, GapsAreLeftOut) {
  const auto load = irregular_load(40, 6);
  const double end = load.back().end.value + 10;
  const TraceView whole = record(load, 1000, end, {.offset = 20.0, .noise = 1.0});
  // The meter's link was broken for ten seconds; it knows nothing of that time.
  std::vector<TracePoint> points;
  for (TracePoint point : whole.points()) {
    if (point.time > Seconds(1020) && point.time < Seconds(1030)) continue;
    if (!points.empty() && point.time - points.back().time > Seconds(5))
      point.starts_stretch = true;
    points.push_back(point);
  }
  const AlignmentResult result = align(load, Seconds(1000), Seconds(end), TraceView(points));
  ASSERT_TRUE(result.alignment) << result.reason;
  EXPECT_NEAR(result.alignment->offset.value, 20.0, 0.1);
}

TEST(Align, ALongSessionIsAlignedAsFinelyAsAShortOne) {
  // Two hours at ten rows a second: searched coarsely first.
  const auto load = irregular_load(900, 7, 12.0);
  const double end = load.back().end.value + 10;
  ASSERT_GT(end, 1000 + 6000);
  const TraceView recording = record(load, 950, end + 40, {.offset = 4321.123, .noise = 4.0});
  const AlignmentResult result = align(load, Seconds(1000), Seconds(end), recording);
  ASSERT_TRUE(result.alignment) << result.reason;
  EXPECT_NEAR(result.alignment->offset.value, 4321.123, 0.05);
}

TEST(Align, ALoadThatRepeatsItselfIsRefusedUnlessTheOffsetIsRoughlyKnown) {
  const auto load = periodic_load(30, 4.0);
  const double first = load.front().start.value;
  const double end = load.back().end.value + 2;
  const TraceView recording = record(load, first, end, {.offset = 12.5, .noise = 3.0});
  const AlignmentResult refused = align(load, Seconds(first), Seconds(end), recording);
  EXPECT_FALSE(refused.alignment);
  EXPECT_NE(refused.reason.find("repeats itself"), std::string::npos) << refused.reason;
  const AlignmentResult near = align(load, Seconds(first), Seconds(end), recording,
                                     {.near = Seconds(13.0), .range = Seconds(1.5)});
  ASSERT_TRUE(near.alignment) << near.reason;
  EXPECT_NEAR(near.alignment->offset.value, 12.5, 0.1);
}

TEST(Align, PausesAroundARepeatingLoadTellTheShiftsApart) {
  const auto load = periodic_load(10, 4.0);
  const double end = load.back().end.value + 25;
  const TraceView recording = record(load, 970, end, {.offset = 12.5, .noise = 1.0});
  const AlignmentResult result = align(load, Seconds(970), Seconds(end), recording);
  ASSERT_TRUE(result.alignment) << result.reason;
  EXPECT_NEAR(result.alignment->offset.value, 12.5, 0.1);
}

TEST(Align, ARecordingOfAnotherRunIsRefused) {
  const auto load = irregular_load(40, 11);
  const double end = load.back().end.value + 10;
  const TraceView other = record(irregular_load(40, 12), 1000, end, {.noise = 2.0});
  const AlignmentResult result = align(load, Seconds(1000), Seconds(end), other);
  EXPECT_FALSE(result.alignment);
  EXPECT_NE(result.reason.find("no steps of load like the session's"), std::string::npos)
      << result.reason;
}

TEST(Align, AFlatOrShortRecordingIsRefused) {
  const auto load = irregular_load(40, 13);
  const double end = load.back().end.value + 10;
  const TraceView flat = record({}, 1000, end, {});
  EXPECT_NE(align(load, Seconds(1000), Seconds(end), flat).reason.find("no steps of load"),
            std::string::npos);
  EXPECT_NE(align(load, Seconds(1000), Seconds(end), TraceView()).reason.find("overlap"),
            std::string::npos);
  const TraceView brief = record(load, 1000, 1000.25, {});
  EXPECT_NE(align(load, Seconds(1000), Seconds(end), brief).reason.find("overlap"),
            std::string::npos);
  EXPECT_FALSE(align(flat, flat).alignment);
}

TEST(LoadSignal, StepsHoldTheMeanOfWhatTheyCover) {
  const std::vector<PhaseSpan> spans{{Phase::build, Seconds(1.0), Seconds(2.5)},
                                     {Phase::render, Seconds(2.5), Seconds(2.75)},
                                     {Phase::render, Seconds(9.0), Seconds(99.0)}};
  const LoadSignal busy = load_of(spans, Seconds(0), Seconds(4.5), Seconds(1));
  ASSERT_EQ(busy.values.size(), 4U);
  EXPECT_DOUBLE_EQ(busy.values[0], 0.0);
  EXPECT_DOUBLE_EQ(busy.values[1], 1.0);
  EXPECT_DOUBLE_EQ(busy.values[2], 0.75);
  EXPECT_DOUBLE_EQ(busy.values[3], 0.0);

  const auto point = [](double time, double energy, bool starts) {
    return TracePoint{Seconds(time), Joules(energy), std::nullopt, true, starts};
  };
  const LoadSignal watts =
      load_of(TraceView({point(10, 0, true), point(10.5, 5, false), point(12, 11, false),
                         point(13, 11, true), point(14, 14, false)}),
              Seconds(1));
  ASSERT_EQ(watts.values.size(), 4U);
  EXPECT_DOUBLE_EQ(watts.values[0], 5.0 + 2.0);
  EXPECT_DOUBLE_EQ(watts.values[1], 4.0);
  EXPECT_TRUE(std::isnan(watts.values[2]));
  EXPECT_DOUBLE_EQ(watts.values[3], 3.0);
}

}  // namespace
}  // namespace encore::energy
