#include "energy/sampling/low_pass.h"

#include "energy/sources/simulated.h"

#include <gtest/gtest.h>

#include <cmath>

namespace encore::energy {
namespace {

TEST(LowPass, IsExactAtEveryRatioOfStepToTimeConstant) {
  for (double x = 1e-9; x < 2e9; x *= std::sqrt(10.0)) {
    const double tau = 7.0;
    const double dt = x * tau;
    const long double settled = -std::expm1(-static_cast<long double>(dt) / tau);
    const double step = low_pass_step(0.0, 1.0, dt, tau);
    EXPECT_NEAR(step / static_cast<double>(settled), 1.0, 1e-15) << x;
    // A ramp from 0: 1 - (1 - e^-x) / x, by its series where that cancels.
    const long double ratio = static_cast<long double>(dt) / tau;
    const long double late = x < 1e-3 ? ratio / 2 - ratio * ratio / 6 + ratio * ratio * ratio / 24
                                      : 1.0L - settled / ratio;
    const double ramp = low_pass_ramp(0.0, 0.0, 1.0, dt, tau);
    EXPECT_NEAR(ramp / static_cast<double>(late), 1.0, 1e-11) << x;
    EXPECT_EQ(low_pass_ramp(0.25, 1.0, 1.0, dt, tau), low_pass_step(0.25, 1.0, dt, tau));
  }
}

TEST(LowPass, StaysWithinWhatWentIn) {
  for (const double tau : {0.0, 1e-3, 1.0, 1e6}) {
    for (const double dt : {1e-3, 1.0, 60.0, 36000.0}) {
      double up = 20.0;
      double wild = 20.0;
      for (int n = 0; n < 1000; ++n) {
        const double next = low_pass_step(up, 60.0, dt, tau);
        EXPECT_GE(next, up) << "monotone";
        EXPECT_LE(next, 60.0);
        up = next;
        const double from = n % 2 == 0 ? 20.0 : 60.0;
        wild = low_pass_ramp(wild, from, 80.0 - from, dt, tau);
        ASSERT_TRUE(wild >= 20.0 && wild <= 60.0) << tau << ' ' << dt;
      }
    }
  }
}

TEST(LowPass, TwoHalfStepsAreOneStep) {
  for (const double tau : {1e-3, 1.0, 1e6}) {
    for (const double dt : {1e-3, 1.0, 36000.0}) {
      const double half = low_pass_ramp(30.0, 20.0, 40.0, dt / 2, tau);
      EXPECT_NEAR(low_pass_ramp(half, 40.0, 60.0, dt / 2, tau),
                  low_pass_ramp(30.0, 20.0, 60.0, dt, tau), 1e-12);
    }
  }
}

TEST(LowPass, ItsLimits) {
  EXPECT_EQ(low_pass_step(20.0, 60.0, 1.0, 0.0), 60.0);
  EXPECT_EQ(low_pass_ramp(20.0, 30.0, 60.0, 1.0, 0.0), 60.0);
  EXPECT_EQ(low_pass_step(20.0, 60.0, 0.0, 1.0), 20.0);
  EXPECT_EQ(low_pass_ramp(20.0, 30.0, 60.0, -1.0, 1.0), 20.0);
  EXPECT_EQ(low_pass_step(20.0, 60.0, INFINITY, 1.0), 60.0);
}

TEST(LowPass, SimulatedGaugesStandAnyTimeBetweenUpdates) {
  // 1 ms of smoothing seen after 10 h, and 1e6 s of it seen each millisecond.
  for (const double tau : {1e-3, 1.0, 1e3, 1e6}) {
    for (const double step : {1e-3, 1.0, 600.0, 36000.0}) {
      StepPower power(Seconds(0), Watts(20));
      power.add(Seconds(1e6), Watts(60));
      SimulatedSettings settings;
      settings.info.is_counter = false;
      settings.info.smoothing = Seconds(tau);
      settings.window = Seconds(1e-3);
      settings.shortest_hold = settings.longest_hold = Seconds(0);
      settings.energy_until = [&](Seconds t) { return power.energy_until(t); };
      SimulatedSource source(settings);
      double before = 20.0;
      for (int n = 0; n <= 20; ++n) {
        const Seconds now(n * step);
        const ReadResult result = source.read(now);
        if (!result.reading.power) continue;
        const double shown = result.reading.power->value;
        // Energies of 1e6 J hold the mean of 0.03 ms to microwatts only.
        EXPECT_NEAR(shown, 60.0 - 40.0 * std::exp(-now.value / tau), 1e-4) << tau << ' ' << step;
        EXPECT_GE(shown, before - 1e-4);
        before = shown;
      }
      EXPECT_GT(before, 20.0) << "it was read";
    }
  }
}

}  // namespace
}  // namespace encore::energy
