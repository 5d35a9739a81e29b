#include "energy/sources/simulated.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

namespace encore::energy {
namespace {

SimulatedSettings constant(std::string_view preset, double watts) {
  SimulatedSettings settings = simulated_preset(preset);
  settings.energy_until = [watts](Seconds time) { return Joules(watts * time.value); };
  return settings;
}

TEST(SimulatedSource, StepPowerIsExactBeforeInsideAndAfter) {
  StepPower power(Seconds(10), Watts(5));
  power.add(Seconds(12), Watts(20));
  power.add(Seconds(15), Watts(30));
  EXPECT_DOUBLE_EQ(power.energy_until(Seconds(8)).value, -10.0);
  EXPECT_DOUBLE_EQ(power.energy_until(Seconds(11)).value, 20.0);
  EXPECT_DOUBLE_EQ(power.energy_until(Seconds(13)).value, 70.0);
  EXPECT_DOUBLE_EQ(power.energy_until(Seconds(16)).value, 160.0);
}

TEST(SimulatedSource, CounterIsAtMostOnePeriodAndOneStepOff) {
  for (const char* preset : {"rapl", "nvml"}) {
    SimulatedSource source(constant(preset, 50.0));
    const SourceInfo& info = source.info();
    ReadResult first = source.read(Seconds(100));
    EXPECT_EQ(first.reading.energy.value, 0.0);
    const double off = 50.0 * info.update_period.value + 2 * info.energy_step->value;
    for (int i = 1; i < 500; ++i) {
      const Seconds now(100 + 0.0137 * i);
      const ReadResult result = source.read(now);
      ASSERT_EQ(result.state, ReadState::ok);
      EXPECT_NEAR(result.reading.energy.value, source.true_energy(Seconds(100), now).value, off);
    }
  }
}

TEST(SimulatedSource, ThirtyTwoBitCounterWrapsUnnoticed) {
  SimulatedSettings settings = constant("rapl", 100.0);
  const double range = 4294967296.0 * settings.info.energy_step->value;
  SimulatedSource source(settings);
  Seconds now(range / 100.0 - 60.0);  // a minute before the raw value wraps
  const Seconds start = now;
  source.read(now);
  double last = 0.0;
  for (int i = 0; i < 1200; ++i) {
    now += Seconds(0.1);
    const double energy = source.read(now).reading.energy.value;
    EXPECT_GE(energy, last);
    last = energy;
  }
  EXPECT_NEAR(last, source.true_energy(start, now).value, 0.2);
}

TEST(SimulatedSource, GaugeHoldsItsValueFor3To6Seconds) {
  SimulatedSettings settings = simulated_preset("battery");
  settings.info.power_step = Watts(1e-4);  // so fine that no two values are equal
  SimulatedSource source(settings);
  std::vector<double> changes;
  for (int i = 0; i < 3000; ++i) {
    const Seconds now(0.1 * i);
    const ReadResult result = source.read(now);
    ASSERT_TRUE(result.reading.power);
    const double steps = result.reading.power->value / 1e-4;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
    if (result.reading.changed) changes.push_back(now.value);
  }
  ASSERT_GT(changes.size(), 40U);
  for (std::size_t i = 2; i < changes.size(); ++i) {
    EXPECT_GE(changes[i] - changes[i - 1], 2.9 - 1e-9);
    EXPECT_LE(changes[i] - changes[i - 1], 6.1 + 1e-9);
  }
}

TEST(SimulatedSource, SmoothedGaugeFollowsAStepExponentially) {
  SimulatedSettings settings = simulated_preset("battery");
  settings.info.smoothing = Seconds(4);
  settings.info.power_step = {};
  settings.shortest_hold = settings.longest_hold = Seconds(0);
  settings.energy_until = [](Seconds t) {
    return Joules(20 * t.value + 30 * std::max(0.0, t.value - 50));
  };
  SimulatedSource source(settings);
  double shown = 0.0;
  for (int i = 0; i <= 540; ++i) {
    shown = source.read(Seconds(0.1 * i)).reading.power->value;
    if (i == 500) {
      EXPECT_NEAR(shown, 20.0, 1e-6);
    }
  }
  EXPECT_NEAR(shown, 50.0 - 30.0 * std::exp(-1.0), 0.01);
}

TEST(SimulatedSource, NoiseHasItsSizeAndItsCorrelation) {
  SimulatedSettings settings = constant("battery", 100.0);
  settings.info.power_step = {};
  settings.shortest_hold = settings.longest_hold = Seconds(1);
  settings.noise = 2.0;
  settings.noise_correlation = 0.6;
  SimulatedSource source(settings);
  double squares = 0.0;
  double products = 0.0;
  double last = 0.0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double off = source.read(Seconds(i)).reading.power->value - 100.0;
    squares += off * off / kCount;
    products += off * last / kCount;
    last = off;
  }
  EXPECT_NEAR(std::sqrt(squares), 2.0, 0.1);
  EXPECT_NEAR(products / squares, 0.6, 0.03);
}

TEST(SimulatedSource, FailuresResetsAndLossComeAsScripted) {
  SimulatedSettings settings = constant("nvml", 10.0);
  using Kind = SimulatedFault::Kind;
  settings.faults = {{Kind::fail, Seconds(2), Seconds(4)},
                     {Kind::reset, Seconds(6), {}},
                     {Kind::lose, Seconds(8), {}}};
  SimulatedSource source(settings);
  std::vector<ReadState> states;
  for (int i = 0; i < 10; ++i) {
    const ReadResult result = source.read(Seconds(i));
    states.push_back(result.state);
    EXPECT_EQ(result.state == ReadState::ok, result.message.empty()) << i;
  }
  using enum ReadState;
  EXPECT_EQ(states,
            (std::vector{ok, ok, failed, failed, restarted, ok, restarted, ok, lost, lost}));
}

TEST(SimulatedSource, EnergyAcrossAGapIsNotMadeUp) {
  SimulatedSettings settings = constant("rapl", 10.0);
  settings.faults = {{SimulatedFault::Kind::fail, Seconds(2), Seconds(4)}};
  SimulatedSource source(settings);
  source.read(Seconds(0));
  const double before = source.read(Seconds(1)).reading.energy.value;
  source.read(Seconds(3));
  EXPECT_EQ(source.read(Seconds(5)).reading.energy.value, before);
}

TEST(SimulatedSource, EqualSeedsGiveEqualReadingsAndOthersDoNot) {
  const auto readings = [](std::uint64_t seed) {
    const auto source = make_simulated("battery", seed);
    std::vector<double> watts;
    for (int i = 0; i < 100; ++i) watts.push_back(source->read(Seconds(i)).reading.power->value);
    return watts;
  };
  EXPECT_EQ(readings(3), readings(3));
  EXPECT_NE(readings(3), readings(4));
}

TEST(SimulatedSource, PresetsAreNamedAndSaidToBeSimulated) {
  std::set<std::string> names;
  for (const std::string& preset : simulated_presets()) {
    const auto source = make_simulated(preset);
    names.insert(source->info().name);
    EXPECT_EQ(source->info().kind, SourceKind::simulated);
    EXPECT_EQ(source->info().provenance.origin, Origin::simulated);
    EXPECT_FALSE(source->info().includes.empty());
  }
  EXPECT_EQ(names,
            (std::set<std::string>{"simulated:rapl", "simulated:nvml", "simulated:battery"}));
  EXPECT_THROW(make_simulated("toaster"), std::invalid_argument);
}

}  // namespace
}  // namespace encore::energy
