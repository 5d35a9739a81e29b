#include "energy/convergence/exponential_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace encore::energy {
namespace {

struct Record {
  std::vector<double> times;
  std::vector<double> values;
};

/// 60 - 40 e^(-t / tau) with noise, at so many times of a spacing.
Record record(double tau, double spacing, std::size_t n, double noise, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Record made;
  for (std::size_t i = 0; i < n; ++i) {
    made.times.push_back(100.0 + static_cast<double>(i) * spacing);
    made.values.push_back(60.0 - 40.0 * std::exp(-static_cast<double>(i) * spacing / tau) +
                          noise * normal(random));
  }
  return made;
}

TEST(ExponentialFit, FindsTimeConstantsOverNineDecadesExactly) {
  for (double tau = 1e-3; tau < 2e6; tau *= 10.0) {
    for (const double per_tau : {0.5, 4.0, 100.0, 1000.0}) {
      const Record made = record(tau, tau / per_tau, 600, 0.0);
      const ExponentialFit fit = fit_exponential(made.times, made.values);
      ASSERT_TRUE(fit.tau) << tau << ' ' << per_tau << ' ' << fit.reason;
      // The times hold tau only as finely as 100 s and a spacing let them.
      const double grain = 1e-12 + 1e-10 / tau;
      EXPECT_NEAR(fit.tau->value / tau, 1.0, 10.0 * grain) << tau << ' ' << per_tau;
      EXPECT_NEAR(fit.end, 60.0, 1e-6 + 40 * grain * 100) << tau << ' ' << per_tau;
      EXPECT_NEAR(fit.change, -40.0, 1e-6 + 40 * grain * 100) << tau << ' ' << per_tau;
      EXPECT_LE(fit.tau_low, *fit.tau);
      EXPECT_GE(fit.tau_high, *fit.tau);
      EXPECT_EQ(fit.start.value, 100.0);
    }
  }
}

TEST(ExponentialFit, IntervalsHoldTheTruthAtTheirRate) {
  for (const double tau : {1e-3, 20.0, 1e6}) {
    int held = 0;
    int given = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      const Record made = record(tau, tau / 30.0, 120, 2.0, seed);
      const ExponentialFit fit = fit_exponential(made.times, made.values);
      if (!fit.tau) continue;
      ++given;
      held += fit.tau_low.value <= tau && tau <= fit.tau_high.value ? 1 : 0;
    }
    EXPECT_EQ(given, 300) << tau;
    EXPECT_GE(held, 276) << tau;
    EXPECT_LE(held, 298) << tau;
  }
}

TEST(ExponentialFit, CorrelatedDeviationsWidenTheInterval) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Record made = record(20.0, 0.2, 500, 0.0, seed);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    double wander = normal(random);
    for (double& v : made.values) {
      wander = 0.8 * wander + 0.6 * normal(random);
      v += wander;
    }
    const ExponentialFit fit = fit_exponential(made.times, made.values);
    ASSERT_TRUE(fit.tau) << fit.reason;
    held += fit.tau_low.value <= 20.0 && 20.0 <= fit.tau_high.value ? 1 : 0;
  }
  EXPECT_GE(held, 180);
}

TEST(ExponentialFit, RecordsThatAreTooShortGiveALowerBoundOnly) {
  int bounded = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    // A hundredth of tau: a straight line, but for 5 mW.
    const Record made = record(1e4, 0.5, 200, 0.01, seed);
    const ExponentialFit fit = fit_exponential(made.times, made.values);
    if (fit.tau) continue;
    EXPECT_NE(fit.reason.find("too short"), std::string::npos) << fit.reason;
    EXPECT_TRUE(std::isinf(fit.tau_high.value));
    bounded += fit.tau_low.value > 0.0 && fit.tau_low.value <= 1e4 ? 1 : 0;
  }
  EXPECT_GE(bounded, 90);
}

TEST(ExponentialFit, RecordsThatAreTooCoarseGiveAnUpperBoundOnly) {
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Record made = record(0.01, 1.0, 100, 0.4, seed);
    const ExponentialFit fit = fit_exponential(made.times, made.values);
    if (fit.tau) continue;  // the second value may be off by chance
    ++refused;
    EXPECT_NE(fit.reason.find("too coarse"), std::string::npos) << fit.reason;
    EXPECT_EQ(fit.tau_low.value, 0.0);
    EXPECT_GE(fit.tau_high.value, 0.01);
    EXPECT_LT(fit.tau_high.value, 1.0);
  }
  EXPECT_GE(refused, 95);
}

TEST(ExponentialFit, ChanceAloneSeldomHasATimeConstant) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Record made;
    for (int i = 0; i < 100; ++i) {
      made.times.push_back(i);
      made.values.push_back(20.0 + normal(random));
    }
    const ExponentialFit fit = fit_exponential(made.times, made.values);
    seen += fit.tau ? 1 : 0;
    EXPECT_EQ(fit.reason.empty(), fit.tau.has_value());
  }
  EXPECT_LE(seen, 9);
}

TEST(ExponentialFit, EveryStepWithEveryTimeConstantIsFiniteOrRefused) {
  for (double tau = 1e-3; tau < 2e6; tau *= 10.0) {
    for (const double step : {1e-3, 0.1, 10.0, 600.0, 36000.0}) {
      for (const double scale : {1e-300, 1.0, 1e300}) {
        Record made = record(tau, step, 100, 0.4);
        for (double& v : made.values) v *= scale;
        const ExponentialFit fit = fit_exponential(made.times, made.values);
        EXPECT_EQ(fit.reason.empty(), fit.tau.has_value());
        EXPECT_TRUE(std::isfinite(fit.tau_low.value));
        EXPECT_FALSE(std::isnan(fit.tau_high.value));
        if (!fit.tau) continue;
        EXPECT_TRUE(std::isfinite(fit.end) && std::isfinite(fit.change)) << tau << ' ' << step;
        EXPECT_LE(fit.tau_low, *fit.tau);
        EXPECT_GE(fit.tau_high, *fit.tau);
        EXPECT_NEAR(fit.tau->value / tau, 1.0, 0.5) << tau << ' ' << step;
      }
    }
  }
}

TEST(ExponentialFit, WhatIsNoSeriesSaysSo) {
  const Record good = record(5.0, 1.0, 20, 0.1);
  const auto reason = [&](auto change) {
    Record made = good;
    change(made);
    const ExponentialFit fit = fit_exponential(made.times, made.values);
    EXPECT_FALSE(fit.tau);
    return fit.reason;
  };
  EXPECT_NE(reason([](Record& r) { r.times.resize(7), r.values.resize(7); }).find("too few"),
            std::string::npos);
  EXPECT_NE(reason([](Record& r) { r.times.pop_back(); }).find("differ"), std::string::npos);
  EXPECT_NE(reason([](Record& r) { r.times[3] = r.times[2]; }).find("rise"), std::string::npos);
  EXPECT_NE(reason([](Record& r) {
              r.values[3] = std::numeric_limits<double>::quiet_NaN();
            }).find("finite"),
            std::string::npos);
  EXPECT_NE(reason([](Record& r) { r.values.assign(20, 7.0); }).find("nothing changes"),
            std::string::npos);
}

TEST(ExponentialFit, TellsHowLongToWait) {
  const Record made = record(30.0, 1.0, 300, 0.0);
  const ExponentialFit fit = fit_exponential(made.times, made.values);
  EXPECT_NEAR(fit.settled_to(0.01)->value, 30.0 * std::log(100.0), 1e-6);
  EXPECT_FALSE(ExponentialFit().settled_to(0.01));
  EXPECT_FALSE(fit.settled_to(0.0));
}

}  // namespace
}  // namespace encore::energy
