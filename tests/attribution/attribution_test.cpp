#include "energy/attribution/attribution.h"

#include "energy/attribution/pure_windows.h"
#include "energy/attribution/windows.h"
#include "energy/sources/choose_total.h"
#include "tests/attribution/simulated_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace encore::energy {
namespace {

/// A counter that is always fresh and has no steps: nothing is uncertain about it.
SourceInfo perfect_counter() {
  SourceInfo info;
  info.name = "simulated:perfect";
  info.update_period = Seconds(0.0);
  info.gain_uncertainty = 0.0;
  return info;
}

/// Reads known power at whole tenths of a second in [0, end].
TraceView exact_trace(const StepPower& power, double end) {
  Trace trace;
  for (int i = 0; i <= static_cast<int>(std::lround(end * 10)); ++i) {
    const Seconds time(i * 0.1);
    trace.add({.time = time, .energy = power.energy_until(time), .power = {}, .changed = true},
              false);
  }
  return trace.view();
}

void expect_equal(const std::optional<Uncertain>& found, double value) {
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, value, 1e-9 * std::max(1.0, std::fabs(value)));
}

/// Idle at 10 W for 5 s, then build at 30 W for 2 s, render at 50 W for 4 s, nothing at 10 W for
/// 1 s, build at 30 W for 3 s, idle at 10 W for 5 s.
struct Steps {
  SourceInfo info = perfect_counter();
  StepPower power{Seconds(0), Watts(10)};
  BusyTimeline busy{{"build", "render"}};
  AttributionInput input;

  Steps() {
    power.add(Seconds(5), Watts(10));
    power.add(Seconds(7), Watts(30));
    power.add(Seconds(11), Watts(50));
    power.add(Seconds(12), Watts(10));
    power.add(Seconds(15), Watts(30));
    power.add(Seconds(20), Watts(10));
    busy.add(0, Seconds(5), Seconds(7));
    busy.add(1, Seconds(7), Seconds(11));
    busy.add(0, Seconds(12), Seconds(15));
    busy.add_operations(20, Seconds(5), Seconds(15));
    input.source = &info;
    input.trace = exact_trace(power, 20);
    input.busy = &busy;
    input.measured = {{Seconds(5), Seconds(15)}};
    input.idle = {{Seconds(0), Seconds(5)}, {Seconds(15), Seconds(20)}};
  }
};

TEST(Attribution, ConstantPowerIsExactAndBelongsToItsOnlyPhase) {
  SourceInfo info = perfect_counter();
  StepPower power(Seconds(0), Watts(40));
  BusyTimeline busy({"build", "render"});
  busy.add(1, Seconds(2), Seconds(8));
  busy.add_operations(3, Seconds(2), Seconds(8));
  const AttributionInput input{.source = &info,
                               .trace = exact_trace(power, 10),
                               .busy = &busy,
                               .measured = {{Seconds(2), Seconds(8)}},
                               .mixed = {},
                               .idle = {{Seconds(0), Seconds(2)}}};
  const Attribution a = attribute(input);
  expect_equal(a.watts, 40.0);
  expect_equal(a.gross, 240.0);
  expect_equal(a.net, 0.0);
  expect_equal(a.per_operation, 80.0);
  EXPECT_NEAR(a.gross->half_width, 0.0, 1e-9);
  ASSERT_EQ(a.phases.size(), 1U);
  EXPECT_EQ(a.phases[0].column, "render");
  EXPECT_EQ(a.phases[0].method, AttributionMethod::whole);
  expect_equal(a.phases[0].gross, 240.0);
  expect_equal(a.remainder, 0.0);
  ASSERT_TRUE(a.idle);
  EXPECT_FALSE(a.idle->drifted);
}

TEST(Attribution, StepsAreReadAtTheirEdges) {
  const Steps steps;
  const Attribution a = attribute(steps.input);
  expect_equal(a.gross, 60 + 200 + 10 + 90);
  expect_equal(a.net, 360 - 100);
  ASSERT_TRUE(a.idle);
  expect_equal(a.idle->watts, 10.0);
  ASSERT_EQ(a.phases.size(), 2U);
  EXPECT_EQ(a.phases[0].method, AttributionMethod::windows);
  EXPECT_EQ(a.phases[1].method, AttributionMethod::windows);
  expect_equal(a.phases[0].watts, 30.0);
  expect_equal(a.phases[0].gross, 150.0);
  expect_equal(a.phases[0].net, 100.0);
  expect_equal(a.phases[1].gross, 200.0);
  expect_equal(a.phases[1].net, 160.0);
  expect_equal(a.remainder, 10.0);
  EXPECT_NEAR(a.operations, 20.0, 1e-12);
}

TEST(Attribution, PhasesAndRemainderSumToTheTotal) {
  const Steps steps;
  const Attribution a = attribute(steps.input);
  double sum = a.remainder->value;
  for (const PhaseEnergy& phase : a.phases) sum += phase.gross->value;
  EXPECT_NEAR(sum, a.gross->value, 1e-9 * a.gross->value);
}

TEST(Attribution, GainWidensIntervalsButNotTheStatisticalPart) {
  Steps steps;
  steps.info.gain_uncertainty = 0.05;
  const Attribution a = attribute(steps.input);
  EXPECT_NEAR(a.gross->half_width, 1.96 * 0.05 * 360, 0.01);
  EXPECT_NEAR(a.net->half_width, 1.96 * 0.05 * 260, 0.01);
  EXPECT_NEAR(a.gross->statistical, 0.0, 1e-9);
}

TEST(Attribution, WithoutIdleWindowsThereIsNoNetEnergy) {
  Steps steps;
  steps.input.idle.clear();
  const Attribution a = attribute(steps.input);
  EXPECT_TRUE(a.gross);
  EXPECT_FALSE(a.net);
  EXPECT_FALSE(a.idle);
  EXPECT_FALSE(a.phases[0].net);
  EXPECT_TRUE(std::any_of(a.notes.begin(), a.notes.end(), [](const std::string& note) {
    return note.find("no idle windows") != std::string::npos;
  }));
}

TEST(Attribution, WithoutReadingsThereIsNoNumberAtAll) {
  Steps steps;
  steps.input.trace = TraceView();
  const Attribution a = attribute(steps.input);
  EXPECT_FALSE(a.watts || a.gross || a.net || a.per_operation || a.remainder);
  ASSERT_EQ(a.phases.size(), 2U);
  EXPECT_EQ(a.phases[0].method, AttributionMethod::none);
  EXPECT_FALSE(a.phases[0].gross);
  EXPECT_FALSE(a.phases[0].reason.empty());
  EXPECT_FALSE(a.notes.empty());
}

TEST(Attribution, WindowsShorterThanTheUpdatesGiveNoNumber) {
  Steps steps;
  steps.info.update_period = Seconds(0.1);
  steps.input.measured = {{Seconds(7.01), Seconds(7.09)}};
  const Attribution a = attribute(steps.input);
  EXPECT_FALSE(a.gross);
  ASSERT_FALSE(a.notes.empty());
  EXPECT_NE(a.notes[0].find("measure for longer"), std::string::npos) << a.notes[0];
}

TEST(Attribution, GapsTakeThePowerOfTheRestAndAreNoted) {
  Steps steps;
  // Nothing is known from 8 s to 10 s; the counter starts anew after it.
  std::vector<TracePoint> points;
  for (TracePoint point : steps.input.trace.points()) {
    if (point.time > Seconds(8.05) && point.time < Seconds(9.95)) continue;
    if (point.time > Seconds(9)) point.energy = point.energy - Joules(77);
    point.starts_stretch = points.empty() || (point.time - points.back().time > Seconds(1));
    points.push_back(point);
  }
  steps.input.trace = TraceView(points);
  steps.input.measured = {{Seconds(7), Seconds(11)}};
  const Attribution a = attribute(steps.input);
  expect_equal(a.gross, 200.0);
  EXPECT_TRUE(std::any_of(a.notes.begin(), a.notes.end(), [](const std::string& note) {
    return note.find("gave no value in 2 s") != std::string::npos;
  }));
  steps.input.measured = {{Seconds(8.2), Seconds(9.8)}};
  EXPECT_FALSE(attribute(steps.input).gross);
}

TEST(Attribution, IdleDriftIsFollowedAlongAStraightLineAndFlagged) {
  Steps steps;
  StepPower power(Seconds(0), Watts(10));
  power.add(Seconds(5), Watts(10));
  power.add(Seconds(15), Watts(40));
  power.add(Seconds(20), Watts(14));
  steps.input.trace = exact_trace(power, 20);
  const Attribution a = attribute(steps.input);
  expect_equal(a.idle->watts, 12.0);
  expect_equal(a.idle->drift, 4.0);
  EXPECT_TRUE(a.idle->drifted);
  expect_equal(a.net, 400.0 - 120.0);
  EXPECT_GT(a.net->statistical, 10.0);
  EXPECT_TRUE(std::any_of(a.notes.begin(), a.notes.end(), [](const std::string& note) {
    return note.find("idle power drifted") != std::string::npos;
  }));
}

TEST(Attribution, OverlappingPhasesAreNotReadAtTheirEdges) {
  BusyTimeline busy({"cpu", "gpu"});
  busy.add(0, Seconds(0), Seconds(6));
  busy.add(1, Seconds(4), Seconds(10));
  const std::vector<Window> all{{Seconds(0), Seconds(10)}};
  const auto cpu = pure_windows(busy, 0, all);
  const auto gpu = pure_windows(busy, 1, all);
  ASSERT_EQ(cpu.size(), 1U);
  ASSERT_EQ(gpu.size(), 1U);
  EXPECT_EQ(cpu[0].to, Seconds(4));
  EXPECT_EQ(gpu[0].from, Seconds(6));
  EXPECT_EQ(busy_in(busy, 0, all), Seconds(6));
}

TEST(Attribution, OverlappingPhasesAreToldApartByTheFitAndSumToTheTotal) {
  // 10 W idle, cpu +20 W, gpu +50 W, in blocks that overlap by various amounts.
  SourceInfo info = perfect_counter();
  BusyTimeline busy({"cpu", "gpu"});
  StepPower power(Seconds(0), Watts(10));
  const double offsets[] = {0.0, 0.7, 0.3, 1.0, 0.5, 0.2, 0.9, 0.1, 0.6, 0.4};
  double time = 10.0;
  power.add(Seconds(time), Watts(10));
  for (int repeat = 0; repeat < 4; ++repeat) {
    for (const double offset : offsets) {
      // The cpu is busy for 1 s, the gpu for 1 s, the later one by `offset`.
      busy.add(0, Seconds(time), Seconds(time + 1));
      busy.add(1, Seconds(time + offset), Seconds(time + offset + 1));
      if (offset > 0) power.add(Seconds(time + offset), Watts(30));
      if (offset < 1) power.add(Seconds(time + 1), Watts(80));
      if (offset > 0) power.add(Seconds(time + offset + 1), Watts(60));
      time += offset + 1.2;
      power.add(Seconds(time), Watts(10));
    }
  }
  const double end = std::ceil(time * 10) * 0.1;  // a time that is read at
  power.add(Seconds(end + 10), Watts(10));
  const AttributionInput input{
      .source = &info,
      .trace = exact_trace(power, end + 10),
      .busy = &busy,
      .measured = {{Seconds(10), Seconds(end)}},
      .mixed = {},
      .idle = {{Seconds(0), Seconds(10)}, {Seconds(end), Seconds(end + 10)}}};
  const Attribution a = attribute(input);
  ASSERT_EQ(a.phases.size(), 2U);
  ASSERT_EQ(a.phases[0].method, AttributionMethod::regression) << a.phases[0].reason;
  ASSERT_EQ(a.phases[1].method, AttributionMethod::regression) << a.phases[1].reason;
  EXPECT_NEAR(a.phases[0].net->value, 40 * 20.0, 1e-6 * 800);
  EXPECT_NEAR(a.phases[1].net->value, 40 * 50.0, 1e-6 * 2000);
  const double sum = a.idle->watts.value * a.length.value + a.phases[0].net->value +
                     a.phases[1].net->value + a.remainder->value;
  EXPECT_NEAR(sum, a.gross->value, 1e-9 * a.gross->value);
  EXPECT_NEAR(a.remainder->value, 0.0, 1e-3);
  EXPECT_TRUE(a.condition);
}

TEST(Attribution, SumsAddValuesChanceInQuadratureAndGainInFull) {
  Attribution a;
  a.gross = Uncertain{100, 5, 3};  // 4 of gain
  a.net = Uncertain{60, 3, 3};
  a.phases.resize(1);
  a.phases[0].column = "build";
  a.phases[0].gross = Uncertain{100, 5, 3};
  a.notes = {"one"};
  Attribution b;
  b.gross = Uncertain{50, 5, 4};  // 3 of gain
  b.phases = a.phases;
  b.phases[0].gross = Uncertain{50, 5, 4};
  b.notes = {"one", "two"};
  const Attribution sum = add({a, b});
  EXPECT_DOUBLE_EQ(sum.gross->value, 150.0);
  EXPECT_DOUBLE_EQ(sum.gross->statistical, 5.0);
  EXPECT_DOUBLE_EQ(sum.gross->half_width, std::hypot(5.0, 7.0));
  EXPECT_DOUBLE_EQ(sum.phases[0].gross->value, 150.0);
  EXPECT_FALSE(sum.net) << "one source has no net energy, so the sum has none";
  EXPECT_EQ(sum.notes.size(), 2U);
}

TEST(Attribution, NestedSourcesAreNotAddedTwice) {
  // A package of 30 W that holds its cores' 20 W, beside memory of 5 W.
  struct Part {
    const char* name;
    Domain domain;
    double watts;
  };
  const Part parts[] = {{"rapl:package-0", Domain::package, 30},
                        {"rapl:package-0-core", Domain::cores, 20},
                        {"rapl:package-0-dram", Domain::memory, 5}};
  std::vector<SourceInfo> infos;
  std::vector<Attribution> all;
  for (const Part& part : parts) {
    SourceInfo info = perfect_counter();
    info.name = part.name;
    info.kind = SourceKind::rapl;
    info.domain = part.domain;
    info.unit = "0";
    info.provenance = {Origin::measured, "a fixture"};
    infos.push_back(info);
    const StepPower power(Seconds(0), Watts(part.watts));
    AttributionInput input;
    input.source = &info;
    input.trace = exact_trace(power, 10);
    input.measured = {{Seconds(0), Seconds(10)}};
    all.push_back(attribute(input));
  }
  std::vector<Attribution> chosen;
  for (const std::size_t i : choose_total(infos)) chosen.push_back(all[i]);
  expect_equal(add(chosen).gross, 350.0);
}

TEST(Attribution, LongPhasesAreReadFromAGaugeOnceItHasSettled) {
  SimulatedSettings settings = simulated_preset("battery");
  settings.info.poll_period = Seconds(0.25);
  settings.info.gain_uncertainty = 0.0;
  auto power = std::make_shared<StepPower>(Seconds(0), Watts(10));
  power->add(Seconds(100), Watts(10));
  power->add(Seconds(200), Watts(25));
  power->add(Seconds(300), Watts(40));
  power->add(Seconds(400), Watts(10));
  settings.energy_until = [power](Seconds time) { return power->energy_until(time); };
  SimulatedSource source(settings);
  BusyTimeline busy({"build", "render"});
  busy.add(0, Seconds(100), Seconds(200));
  busy.add(1, Seconds(200), Seconds(300));
  AttributionInput input;
  input.source = &source.info();
  input.trace = read_trace(source, Seconds(0), Seconds(400));
  input.busy = &busy;
  input.measured = {{Seconds(100), Seconds(300)}};
  input.idle = {{Seconds(0), Seconds(100)}, {Seconds(300), Seconds(400)}};
  const Attribution a = attribute(input);
  ASSERT_EQ(a.phases.size(), 2U);
  ASSERT_EQ(a.phases[0].method, AttributionMethod::windows) << a.phases[0].reason;
  EXPECT_NEAR(a.phases[0].watts->value, 25.0, 0.005);
  EXPECT_NEAR(a.phases[1].watts->value, 40.0, 0.005);
  EXPECT_NEAR(a.phases[0].net->value, 1500.0, 1.0);
  EXPECT_NEAR(a.gross->value, 6500.0, 1.0);
  EXPECT_LT(a.gross->statistical, 1.0) << "the step between two phases is no scatter";
  // A value that stands still is known to half a step of 10 mW, not exactly.
  EXPECT_NEAR(a.phases[0].watts->statistical, 0.95 * 0.005, 1e-4);
}

TEST(Attribution, ASourceThatIsLostOnTheWayIsNoted) {
  Steps steps;
  steps.input.trace = steps.input.trace.part(Seconds(0), Seconds(13));
  const Attribution a = attribute(steps.input);
  EXPECT_TRUE(std::any_of(a.notes.begin(), a.notes.end(), [](const std::string& note) {
    return note.find("gave no value in 2 s") != std::string::npos;
  }));
}

TEST(Windows, ThatTouchAreOneWindow) {
  const auto joined = join_windows({{Seconds(3), Seconds(4)},
                                    {Seconds(1), Seconds(2)},
                                    {Seconds(2), Seconds(3)},
                                    {Seconds(5), Seconds(5)},
                                    {Seconds(6), Seconds(7)}});
  ASSERT_EQ(joined.size(), 2U);
  EXPECT_EQ(joined[0].to, Seconds(4));
  EXPECT_EQ(length_of(joined), Seconds(4));
}

}  // namespace
}  // namespace encore::energy
