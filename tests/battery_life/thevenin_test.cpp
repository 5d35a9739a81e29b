#include "energy/battery_life/thevenin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace encore::energy {
namespace {

PackCircuit laptop() {
  return pack_circuit(*battery_preset("thesis-laptop"));
}

/// A source of one voltage whatever its charge, with the branches given.
PackCircuit flat(double volts, double r0, std::vector<RcBranch> branches) {
  return {36000.0, r0, std::move(branches), {{0.0, volts}, {1.0, volts}}, 0.0};
}

TEST(Thevenin, CellsAddInSeriesAndShareInParallel) {
  const Battery battery = *battery_preset("generic-3s");
  ASSERT_EQ(battery.series, 3);
  ASSERT_EQ(battery.parallel, 2);
  const PackCircuit circuit = pack_circuit(battery);
  EXPECT_DOUBLE_EQ(circuit.r0_ohms, 0.0194 * 1.5);
  EXPECT_DOUBLE_EQ(circuit.branches[1].ohms, 0.0146 * 1.5);
  for (std::size_t j = 0; j < circuit.branches.size(); ++j) {
    EXPECT_NEAR(circuit.branches[j].tau() / battery.cell.branches[j].tau(), 1.0, 1e-15);
  }
  EXPECT_DOUBLE_EQ(circuit.open_volts(1.0), 3.0 * 4.18);
}

TEST(Thevenin, TheOpenVoltageIsLinearBetweenItsPoints) {
  const PackCircuit circuit{1.0, 0.0, {}, {{0.1, 10.0}, {0.5, 12.0}, {1.0, 12.5}}, 0.0};
  EXPECT_DOUBLE_EQ(circuit.open_volts(0.3), 11.0);
  EXPECT_DOUBLE_EQ(circuit.open_volts(0.5), 12.0);
  EXPECT_DOUBLE_EQ(circuit.open_volts(0.75), 12.25);
  EXPECT_DOUBLE_EQ(circuit.open_volts(0.0), 10.0);
  EXPECT_DOUBLE_EQ(circuit.open_volts(-1.0), 10.0);
  EXPECT_DOUBLE_EQ(circuit.open_volts(2.0), 12.5);
}

TEST(Thevenin, StepsFromAMillisecondToTenHoursMeetTheClosedForm) {
  const PackCircuit circuit = laptop();
  const double amperes = 0.2;
  for (const double dt : {1e-3, 1e-2, 0.1, 1.0, 10.0, 60.0, 600.0, 3600.0, 36000.0}) {
    const StepGains gains(circuit, Seconds(dt));
    TheveninState state = thevenin_rest(circuit, 1.0);
    const int steps = dt < 1.0 ? 20000 : static_cast<int>(36000.0 / dt);
    for (int i = 0; i < steps; ++i) thevenin_step(circuit, state, amperes, gains);
    const long double t = static_cast<long double>(dt) * steps;
    EXPECT_NEAR(state.soc, static_cast<double>(1.0L - amperes * t / circuit.coulombs), 5e-12) << dt;
    for (std::size_t j = 0; j < circuit.branches.size(); ++j) {
      const RcBranch& branch = circuit.branches[j];
      const long double closed = -branch.ohms * amperes * std::expm1(-t / branch.tau());
      EXPECT_NEAR(state.branch_volts[j] / static_cast<double>(closed), 1.0, 1e-11)
          << dt << ' ' << j;
    }
  }
}

TEST(Thevenin, TwoHalfStepsAreOneStep) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const double dt : {1e-3, 1e-2, 0.1, 1.0, 10.0, 60.0, 600.0, 3600.0, 36000.0}) {
    for (int i = 0; i < 40; ++i) {
      PackCircuit circuit = flat(12.0, 0.1, {});
      TheveninState state = thevenin_rest(circuit, unit(random));
      for (int j = 0; j < 4; ++j) {
        const double tau = std::pow(10.0, -9 + 18 * unit(random));
        circuit.branches.push_back({unit(random), 0.0});
        circuit.branches.back().farads = tau / circuit.branches.back().ohms;
        state.branch_volts.push_back(unit(random) - 0.5);
      }
      const double amperes = 6.0 * unit(random) - 3.0;
      TheveninState halves = state;
      thevenin_step(circuit, state, amperes, StepGains(circuit, Seconds(dt)));
      const StepGains half(circuit, Seconds(dt / 2));
      thevenin_step(circuit, halves, amperes, half);
      thevenin_step(circuit, halves, amperes, half);
      EXPECT_NEAR(state.soc, halves.soc, 1e-14);
      for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_NEAR(state.branch_volts[j], halves.branch_volts[j], 3e-15) << dt;
      }
    }
  }
}

TEST(Thevenin, NoStepOvershootsHoweverStiffTheBranches) {
  for (const double tau : {1e-9, 1e-3, 1.0, 1e5, 1e9}) {
    const PackCircuit circuit = flat(12.0, 0.1, {{0.2, tau / 0.2}});
    for (const double dt : {1e-3, 1.0, 36000.0}) {
      TheveninState state{1.0, {-3.0}};
      const StepGains gains(circuit, Seconds(dt));
      double before = state.branch_volts[0];
      for (int i = 0; i < 100; ++i) {
        thevenin_step(circuit, state, 2.0, gains);
        EXPECT_GE(state.branch_volts[0], before) << tau << ' ' << dt;
        EXPECT_LE(state.branch_volts[0], 0.4 * (1 + 1e-15)) << tau << ' ' << dt;
        before = state.branch_volts[0];
      }
    }
  }
}

TEST(Thevenin, BranchesWithoutResistanceOrCapacityAreInstant) {
  const PackCircuit circuit = flat(12.0, 0.1, {{0.0, 100.0}, {0.2, 0.0}});
  TheveninState state = thevenin_rest(circuit, 1.0);
  thevenin_step(circuit, state, 2.0, StepGains(circuit, Seconds(1e-3)));
  EXPECT_EQ(state.branch_volts[0], 0.0);
  EXPECT_EQ(state.branch_volts[1], 0.4);
  thevenin_step(circuit, state, 0.0, StepGains(circuit, Seconds(0.0)));
  EXPECT_EQ(state.branch_volts[1], 0.4) << "no time, no change";
}

TEST(Thevenin, TheCutOffIsFoundInsideTheStep) {
  // 12 - 2 (1 - e^(-t/20)) - 0.2 at 2 A; the charge would last 5 h.
  PackCircuit circuit = flat(12.0, 0.1, {{1.0, 20.0}});
  circuit.cutoff_volts = 10.5;
  const auto end = discharge_within(circuit, thevenin_rest(circuit, 1.0), 2.0, Seconds(36000.0));
  ASSERT_TRUE(end);
  EXPECT_EQ(end->reason, EndReason::cut_off);
  EXPECT_NEAR(end->time.value, -20.0 * std::log1p(-0.65), 1e-12);
  EXPECT_FALSE(discharge_within(circuit, thevenin_rest(circuit, 1.0), 2.0, Seconds(20.9)));
}

TEST(Thevenin, TheChargeEndsWhereItIsUsedUp) {
  const PackCircuit circuit = flat(12.0, 0.1, {{1.0, 20.0}});
  const auto end = discharge_within(circuit, thevenin_rest(circuit, 0.5), 2.0, Seconds(36000.0));
  ASSERT_TRUE(end);
  EXPECT_EQ(end->reason, EndReason::empty);
  EXPECT_DOUBLE_EQ(end->time.value, 9000.0);
  EXPECT_NEAR(end->state.soc, 0.0, 1e-15);
  EXPECT_FALSE(discharge_within(circuit, thevenin_rest(circuit, 0.5), 0.0, Seconds(1e9)));
  EXPECT_EQ(discharge_within(circuit, thevenin_rest(circuit, 0.0), 0.0, Seconds(1.0))->time.value,
            0.0);
}

TEST(Thevenin, ADipIsNotSteppedOver) {
  // The fast branch pulls the voltage down to 7.5 V at 1.8 s while the slow one, charged by an
  // earlier load, lets it recover to 9 V: both ends of the step are above the cut-off of 7.6 V.
  PackCircuit circuit = flat(10.0, 0.0, {{1.0, 1.0}, {1e-9, 1e10}});
  circuit.cutoff_volts = 7.6;
  const TheveninState start{1.0, {0.0, 2.0}};
  const auto end = discharge_within(circuit, start, 1.0, Seconds(100.0));
  ASSERT_TRUE(end);
  EXPECT_EQ(end->reason, EndReason::cut_off);
  const double t = end->time.value;
  EXPECT_LT(t, 1.8);
  EXPECT_NEAR(10.0 + std::expm1(-t) - 2.0 * std::exp(-t / 10.0), 7.6, 1e-9);
  circuit.cutoff_volts = 7.4;
  EXPECT_FALSE(discharge_within(circuit, start, 1.0, Seconds(100.0)));
}

TEST(Thevenin, AtTheCutOffFromTheStart) {
  PackCircuit circuit = flat(12.0, 1.0, {});
  circuit.cutoff_volts = 11.0;
  const auto end = discharge_within(circuit, thevenin_rest(circuit, 1.0), 5.0, Seconds(10.0));
  ASSERT_TRUE(end);
  EXPECT_EQ(end->time.value, 0.0);
  EXPECT_EQ(end->reason, EndReason::cut_off);
}

}  // namespace
}  // namespace encore::energy
