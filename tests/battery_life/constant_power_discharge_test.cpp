#include "energy/battery_life/thevenin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace encore::energy {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Full steps of the given length, whatever the charge they take.
StepLimits steps_of(double seconds) {
  return {Seconds(seconds), 1.0};
}

DischargeEnd discharge(const PackCircuit& circuit, double watts, const StepLimits& limits = {}) {
  return discharge_constant_power(circuit, thevenin_rest(circuit, 1.0), Watts(watts), limits);
}

/// 9 V when empty to 12.6 V when full, in a straight line.
PackCircuit straight(double r0, double cutoff) {
  return {17280.0, r0, {}, {{0.0, 9.0}, {1.0, 12.6}}, cutoff};
}

TEST(ConstantPowerDischarge, WithoutResistanceItIsTheEnergyUnderTheCurve) {
  // The midpoint rule is exact for a straight OCV, so every step size is, too.
  for (const double dt : {0.1, 1.0, 10.0, 600.0, 36000.0}) {
    const DischargeEnd end = discharge(straight(0.0, 0.0), 30.0, steps_of(dt));
    EXPECT_EQ(end.reason, EndReason::empty);
    EXPECT_NEAR(end.time.value / (17280.0 * 10.8 / 30.0), 1.0, 1e-11) << dt;
  }
}

/// Time in which the inner voltage falls from `high` to `low` behind r0: the integral of
/// dq / I = (E + sqrt(E^2 - 4 R0 P)) / (2 P) dq over a straight OCV.
double closed_time(double high, double low, double r0, double watts) {
  const double least = 4.0 * r0 * watts;
  const auto integral = [&](double e) {
    const double root = std::sqrt(std::max(0.0, e * e - least));
    return 0.5 * e * e + 0.5 * (e * root - least * std::log(e + root));
  };
  return 17280.0 / 3.6 * (integral(high) - integral(low)) / (2.0 * watts);
}

TEST(ConstantPowerDischarge, CutOffAndBrownOutMeetTheClosedForms) {
  // 60 W behind 0.15 ohm at a cut-off of 10 V: E = 10 + 0.15 * 60 / 10 = 10.9 V.
  const DischargeEnd cut = discharge(straight(0.15, 10.0), 60.0);
  EXPECT_EQ(cut.reason, EndReason::cut_off);
  EXPECT_NEAR(cut.time.value / closed_time(12.6, 10.9, 0.15, 60.0), 1.0, 1e-6);
  // Without a cut-off 60 W behind 0.5 ohm break down at E = 2 sqrt(30) V = 10.95 V.
  const DischargeEnd brown = discharge(straight(0.5, 0.0), 60.0);
  EXPECT_EQ(brown.reason, EndReason::brown_out);
  EXPECT_NEAR(brown.time.value / closed_time(12.6, 2.0 * std::sqrt(30.0), 0.5, 60.0), 1.0, 1e-4);
}

TEST(ConstantPowerDischarge, TheErrorFallsWithTheSquareOfTheStep) {
  const double exact = closed_time(12.6, 10.9, 0.15, 60.0);
  double before = kInfinity;
  for (const double dt : {600.0, 150.0, 37.5}) {
    const double time = discharge(straight(0.15, 10.0), 60.0, steps_of(dt)).time.value;
    const double error = std::fabs(time / exact - 1.0);
    EXPECT_LT(error, before / 8.0) << dt;
    before = error;
  }
  EXPECT_LT(before, 5e-7);
}

/// Time to the end by classical Runge-Kutta steps in extended precision.
double runge_kutta_time(const PackCircuit& circuit, double watts, double dt) {
  using Real = long double;
  const std::size_t n = circuit.branches.size() + 1;  // the charge comes last
  std::vector<Real> state(n, 0.0L);
  state.back() = 1.0L;
  const Real least = circuit.cutoff_volts + circuit.r0_ohms * watts / circuit.cutoff_volts;
  const auto inner = [&](const std::vector<Real>& s) {
    Real volts = circuit.open_volts(static_cast<double>(s.back()));
    for (std::size_t j = 0; j + 1 < n; ++j) volts -= s[j];
    return volts;
  };
  const auto slope = [&](const std::vector<Real>& s) {
    const Real e = inner(s);
    const Real amperes = 2 * watts / (e + std::sqrt(e * e - 4 * circuit.r0_ohms * watts));
    std::vector<Real> d(n);
    for (std::size_t j = 0; j + 1 < n; ++j) {
      const RcBranch& b = circuit.branches[j];
      d[j] = (amperes - s[j] / b.ohms) / b.farads;
    }
    d.back() = -amperes / circuit.coulombs;
    return d;
  };
  const auto moved = [&](const std::vector<Real>& s, const std::vector<Real>& d, Real h) {
    std::vector<Real> to = s;
    for (std::size_t j = 0; j < n; ++j) to[j] += h * d[j];
    return to;
  };
  for (long i = 0;; ++i) {
    const auto k1 = slope(state);
    const auto k2 = slope(moved(state, k1, dt / 2));
    const auto k3 = slope(moved(state, k2, dt / 2));
    const auto k4 = slope(moved(state, k3, dt));
    std::vector<Real> next = state;
    for (std::size_t j = 0; j < n; ++j) next[j] += dt * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]) / 6;
    if (inner(next) <= least) {
      const Real share = (inner(state) - least) / (inner(state) - inner(next));
      return static_cast<double>((i + share) * dt);
    }
    state = std::move(next);
  }
}

TEST(ConstantPowerDischarge, AnExplicitSolutionThatIsSlowButSureAgrees) {
  // The double layer's 10 ms keep Runge-Kutta steps below 28 ms; ours are half a per cent of
  // charge.
  const PackCircuit circuit = pack_circuit(*battery_preset("thesis-laptop"));
  const double reference = runge_kutta_time(circuit, 300.0, 0.01);
  const DischargeEnd end = discharge(circuit, 300.0);
  EXPECT_NEAR(end.time.value / reference, 1.0, 2e-5);
  EXPECT_NEAR(discharge(circuit, 300.0, steps_of(0.01)).time.value / reference, 1.0, 1e-7);
}

TEST(ConstantPowerDischarge, AnyStepIsStableAndNearTheFineOne) {
  const PackCircuit circuit = pack_circuit(*battery_preset("thesis-laptop"));
  for (const double watts : {3.0, 30.0, 90.0}) {
    const double fine = discharge(circuit, watts, steps_of(1.0)).time.value;
    EXPECT_NEAR(discharge(circuit, watts).time.value / fine, 1.0, 1e-4) << watts;
    for (const double dt : {10.0, 60.0, 600.0, 3600.0, 36000.0}) {
      EXPECT_NEAR(discharge(circuit, watts, steps_of(dt)).time.value / fine, 1.0, 5e-3)
          << watts << " W, " << dt << " s";
    }
  }
}

TEST(ConstantPowerDischarge, EveryTimeConstantGivesAPlausibleTime) {
  // Between no branch at all and its whole resistance from the start.
  const double without = discharge(straight(0.1, 9.5), 40.0).time.value;
  const double with = discharge(straight(0.3, 9.5), 40.0).time.value;
  ASSERT_LT(with, without);
  double before = 0.0;
  for (const double tau : {1e-9, 1e-3, 1.0, 60.0, 3600.0, 1e5, 1e9}) {
    PackCircuit circuit = straight(0.1, 9.5);
    circuit.branches = {{0.2, tau / 0.2}};
    const double time = discharge(circuit, 40.0).time.value;
    EXPECT_GE(time, with * (1 - 1e-4)) << tau;
    EXPECT_LE(time, without * (1 + 1e-4)) << tau;
    EXPECT_GE(time, before * (1 - 1e-6)) << "slower branches help: " << tau;
    before = time;
  }
}

TEST(ConstantPowerDischarge, LoadsFromNothingToImpossible) {
  const PackCircuit circuit = pack_circuit(*battery_preset("thesis-laptop"));
  EXPECT_EQ(discharge(circuit, 0.0).reason, EndReason::never);
  // Light: the branches hardly matter, all charge comes out.
  const DischargeEnd light = discharge(circuit, 1e-9);
  EXPECT_TRUE(std::isfinite(light.time.value));
  EXPECT_LT(light.steps, 1000U);
  const DischargeEnd lighter = discharge(circuit, 1e-12);
  EXPECT_NEAR(lighter.time.value / light.time.value, 1000.0, 0.01);
  // Heavy: the voltage breaks down at once.
  for (const double watts : {1e5, 1e300}) {
    const DischargeEnd end = discharge(circuit, watts);
    EXPECT_EQ(end.reason, EndReason::brown_out) << watts;
    EXPECT_EQ(end.time.value, 0.0) << watts;
  }
  // Without resistance there is no such limit.
  const DischargeEnd quick = discharge(straight(0.0, 0.0), 1e12);
  EXPECT_EQ(quick.reason, EndReason::empty);
  EXPECT_NEAR(quick.time.value / (17280.0 * 10.8 / 1e12), 1.0, 1e-9);
}

TEST(ConstantPowerDischarge, AFastBranchMayBreakTheVoltageDownWithinAStep) {
  // 30 W behind 0.5 ohm is fine; with the branch's 1 ohm more it is not, about a second later.
  PackCircuit circuit = straight(0.5, 0.0);
  circuit.branches = {{1.0, 1.0}};
  const DischargeEnd end = discharge(circuit, 30.0, steps_of(36000.0));
  const DischargeEnd fine = discharge(circuit, 30.0, steps_of(1e-4));
  EXPECT_EQ(end.reason, EndReason::brown_out);
  EXPECT_GT(fine.time.value, 0.5);
  EXPECT_LT(fine.time.value, 5.0);
  EXPECT_NEAR(end.time.value / fine.time.value, 1.0, 0.2);
  EXPECT_NEAR(discharge(circuit, 30.0, steps_of(0.01)).time.value / fine.time.value, 1.0, 1e-3);
}

}  // namespace
}  // namespace encore::energy
