#include "energy/battery_life/kinetic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace encore::energy {
namespace {

// A battery of 2 Ah with k = 4.5e-5/s and so k' = k / (c (1 - c)) = 1.92e-4/s.
const KineticBattery kTwoAmpHours{7200.0, 0.625, 4.5e-5 / (0.625 * 0.375)};

double minutes_at(double amperes) {
  return kinetic_time_to_empty(kTwoAmpHours, kinetic_rest(kTwoAmpHours, 1.0), amperes)->value /
         60.0;
}

TEST(Kinetic, WellsAfterFiftyMinutes) {
  const KineticState state =
      kinetic_step(kTwoAmpHours, kinetic_rest(kTwoAmpHours, 1.0), 0.96, Seconds(3000.0));
  EXPECT_NEAR(state.available, 1879.017085, 5e-7);
  EXPECT_NEAR(state.bound, 2440.982915, 5e-7);
}

TEST(Kinetic, LifeAtThreeCurrents) {
  EXPECT_NEAR(minutes_at(0.96), 91.143, 5e-4);
  EXPECT_NEAR(minutes_at(0.48), 202.944, 5e-4);
  EXPECT_NEAR(minutes_at(2.0), 40.559, 5e-4);
}

/// The model's equations by classical Runge-Kutta steps in extended precision.
KineticState runge_kutta(const KineticBattery& b, const KineticState& start, double amperes,
                         double seconds, int steps) {
  const long double c = b.c;
  const long double k = b.rate_per_s * c * (1 - c);
  long double y1 = start.available;
  long double y2 = start.bound;
  const long double h = static_cast<long double>(seconds) / steps;
  const auto flow = [&](long double a, long double z) { return k * (z / (1 - c) - a / c); };
  for (int i = 0; i < steps; ++i) {
    const long double f1 = flow(y1, y2);
    const long double f2 = flow(y1 + h / 2 * (f1 - amperes), y2 - h / 2 * f1);
    const long double f3 = flow(y1 + h / 2 * (f2 - amperes), y2 - h / 2 * f2);
    const long double f4 = flow(y1 + h * (f3 - amperes), y2 - h * f3);
    const long double mean = (f1 + 2 * f2 + 2 * f3 + f4) / 6;
    y1 += h * (mean - amperes);
    y2 -= h * mean;
  }
  return {static_cast<double>(y1), static_cast<double>(y2)};
}

TEST(Kinetic, OneStepEqualsManySmallRungeKuttaSteps) {
  for (const double amperes : {0.0, 0.3, 2.0, -1.0}) {
    const KineticState start{3000.0, 2500.0};  // not at rest
    const KineticState exact = kinetic_step(kTwoAmpHours, start, amperes, Seconds(1800.0));
    const KineticState small = runge_kutta(kTwoAmpHours, start, amperes, 1800.0, 4000);
    EXPECT_NEAR(exact.available, small.available, 1e-9) << amperes;
    EXPECT_NEAR(exact.bound, small.bound, 1e-9) << amperes;
  }
}

TEST(Kinetic, TwoHalfStepsAreOneStepFromAMillisecondToTenHours) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const double dt : {1e-3, 1e-2, 0.1, 1.0, 10.0, 60.0, 600.0, 3600.0, 36000.0}) {
    for (int i = 0; i < 50; ++i) {
      const KineticBattery b{7200.0, 0.05 + 0.9 * unit(random),
                             std::pow(10.0, -9 + 12 * unit(random))};
      const KineticState start{4000.0 * unit(random), 4000.0 * unit(random)};
      const double amperes = 4.0 * unit(random) - 1.0;
      const KineticState one = kinetic_step(b, start, amperes, Seconds(dt));
      const KineticState half = kinetic_step(b, start, amperes, Seconds(dt / 2));
      const KineticState two = kinetic_step(b, half, amperes, Seconds(dt / 2));
      const double scale = start.available + start.bound + std::fabs(amperes) * dt;
      EXPECT_NEAR(one.available, two.available, 4e-16 * scale * 4) << dt;
      EXPECT_NEAR(one.bound, two.bound, 4e-16 * scale * 4) << dt;
    }
  }
}

TEST(Kinetic, ShortStepsKeepTheDigitsOfWhatTheyChange) {
  // Into the empty second well flows nothing but what the load's own step makes: I (1 - c) k'
  // dt^2/2.
  const KineticBattery b{7200.0, 0.625, 1e-7};
  const KineticState start{0.625, 0.375};
  const KineticState next = kinetic_step(b, {0.0, 0.0}, 1.0, Seconds(1e-3));
  const double x = b.rate_per_s * 1e-3;
  EXPECT_NEAR(next.bound / (-1e-3 * 0.375 * x / 2.0), 1.0, 1e-9);
  const KineticState rest = kinetic_step(b, start, 0.0, Seconds(1e-3));
  EXPECT_EQ(rest.available, start.available) << "wells at one height stay";
  EXPECT_EQ(rest.bound, start.bound);
}

TEST(Kinetic, ChargeIsConserved) {
  for (const double dt : {1e-3, 1.0, 3600.0, 36000.0}) {
    const KineticState start{3000.0, 2500.0};
    const KineticState next = kinetic_step(kTwoAmpHours, start, 0.1, Seconds(dt));
    EXPECT_NEAR(next.available + next.bound, 5500.0 - 0.1 * dt, 2e-12) << dt;
  }
  // And over a million steps of a changing load.
  KineticState state = kinetic_rest(kTwoAmpHours, 1.0);
  double taken = 0.0;
  for (int i = 0; i < 1'000'000; ++i) {
    const double amperes = i % 3 == 0 ? 2.0 : 0.25;
    state = kinetic_step(kTwoAmpHours, state, amperes, Seconds(0.004));
    taken += amperes * 0.004;
  }
  EXPECT_NEAR((state.available + state.bound + taken) / 7200.0, 1.0, 1e-11);
}

TEST(Kinetic, RestEvensTheWells) {
  const KineticState even = kinetic_step(kTwoAmpHours, {0.0, 1000.0}, 0.0, Seconds(1e9));
  EXPECT_NEAR(even.available, 625.0, 1e-9);
  EXPECT_NEAR(even.bound, 375.0, 1e-9);
}

TEST(Kinetic, TheEndIsWhereTheChargeAtHandIs0) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const KineticBattery b{7200.0, 0.02 + 0.97 * unit(random),
                           std::pow(10.0, -9 + 12 * unit(random))};
    const KineticState start{1.0 + 4000.0 * unit(random), 4000.0 * unit(random)};
    const double amperes = std::pow(10.0, -6 + 12 * unit(random));
    const double end = kinetic_time_to_empty(b, start, amperes)->value;
    const double scale = (start.available + start.bound) * 1e-13;
    EXPECT_LE(kinetic_step(b, start, amperes, Seconds(end)).available, scale);
    for (const double share : {0.1, 0.5, 0.9, 0.999999}) {
      EXPECT_GT(kinetic_step(b, start, amperes, Seconds(end * share)).available, -scale)
          << "not stepped past an earlier end";
    }
  }
}

TEST(Kinetic, LimitsAreSimple) {
  // Nothing flows: only the first well counts. Everything flows at once, or one well: all of it.
  const KineticBattery closed{7200.0, 0.625, 0.0};
  EXPECT_DOUBLE_EQ(kinetic_time_to_empty(closed, kinetic_rest(closed, 1.0), 2.0)->value, 2250.0);
  const KineticBattery open{7200.0, 0.625, 1e12};
  EXPECT_NEAR(kinetic_time_to_empty(open, kinetic_rest(open, 1.0), 2.0)->value, 3600.0, 1e-8);
  const KineticBattery single{7200.0, 1.0, 1e-4};
  EXPECT_DOUBLE_EQ(kinetic_time_to_empty(single, kinetic_rest(single, 0.5), 2.0)->value, 1800.0);
}

TEST(Kinetic, EmptyAndUnloadedBatteries) {
  const KineticState rest = kinetic_rest(kTwoAmpHours, 1.0);
  EXPECT_EQ(kinetic_time_to_empty(kTwoAmpHours, {0.0, 100.0}, 1.0)->value, 0.0);
  EXPECT_FALSE(kinetic_time_to_empty(kTwoAmpHours, rest, 0.0));
  EXPECT_FALSE(kinetic_time_to_empty(kTwoAmpHours, rest, -1.0));
  EXPECT_FALSE(kinetic_time_to_empty(kTwoAmpHours, rest, 1e-308));
  EXPECT_NEAR(kinetic_time_to_empty(kTwoAmpHours, rest, 1e9)->value * 1e9, 4500.0, 0.1);
}

TEST(Kinetic, TheLabelHoldsAtTheRatedHours) {
  Battery battery = *battery_preset("thesis-laptop");
  const KineticBattery wells = kinetic_battery(battery);
  const double rated = battery.coulombs / (battery.peukert.rated_hours * 3600.0);
  EXPECT_NEAR(kinetic_time_to_empty(wells, kinetic_rest(wells, 1.0), rated)->value, 18000.0, 1e-7);
  battery.kinetic.coulombs = 7200.0;
  EXPECT_EQ(kinetic_battery(battery).coulombs, 7200.0);
}

}  // namespace
}  // namespace encore::energy
