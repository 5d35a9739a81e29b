#include "energy/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace encore::energy {
namespace {

TEST(Statistics, MeanDeviationAndIntervalEqualTheClosedForms) {
  const std::vector<double> values{2, 4, 4, 4, 5, 5, 7, 9};
  const Estimate e = estimate_mean(values);
  EXPECT_EQ(e.samples, 8U);
  EXPECT_DOUBLE_EQ(e.mean, 5.0);
  EXPECT_DOUBLE_EQ(*e.standard_deviation, std::sqrt(32.0 / 7.0));
  EXPECT_DOUBLE_EQ(*e.effective_samples, 8.0);
  // t(0.975, 7) = 2.364624251592785.
  EXPECT_NEAR(*e.ci95_half_width, 2.364624251592785 * std::sqrt(32.0 / 7.0 / 8.0), 1e-9);
}

TEST(Statistics, OneSampleHasAMeanButNoInterval) {
  const std::vector<double> one{3.0};
  const Estimate e = estimate_mean(one);
  EXPECT_EQ(e.mean, 3.0);
  EXPECT_FALSE(e.standard_deviation);
  EXPECT_FALSE(e.ci95_half_width);
  EXPECT_EQ(estimate_mean({}).samples, 0U);
}

TEST(Statistics, EqualSamplesAreExact) {
  const std::vector<double> values(100, 0.1);
  const Estimate e = estimate_mean(values);
  EXPECT_EQ(e.mean, 0.1);
  EXPECT_EQ(*e.ci95_half_width, 0.0);
}

TEST(Statistics, WeightsCountOperationsNotRows) {
  const std::vector<double> values{1.0, 4.0};
  const std::vector<double> weights{3.0, 1.0};
  EXPECT_DOUBLE_EQ(estimate_mean(values, weights).mean, 7.0 / 4.0);
}

TEST(Statistics, EqualWeightsChangeNothing) {
  const std::vector<double> values{2, 4, 4, 4, 5, 5, 7, 9, 1, 6, 3};
  const std::vector<double> weights(values.size(), 12.0);
  EXPECT_NEAR(*estimate_mean(values, weights).ci95_half_width,
              *estimate_mean(values).ci95_half_width, 1e-12);
}

TEST(Statistics, HugeAndTinyValuesNeitherOverflowNorVanish) {
  for (const double scale : {1e-150, 1e150}) {
    const std::vector<double> values{1 * scale, 2 * scale, 3 * scale};
    const Estimate e = estimate_mean(values);
    EXPECT_NEAR(e.mean / scale, 2.0, 1e-12);
    EXPECT_NEAR(*e.standard_deviation / scale, 1.0, 1e-12);
  }
}

/// Share of runs whose interval holds the true mean of an AR(1) series (phi = 0: independent).
double coverage(double phi, int samples, int runs, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  int held = 0;
  std::vector<double> values(static_cast<std::size_t>(samples));
  for (int run = 0; run < runs; ++run) {
    double off = normal(random) / std::sqrt(1 - phi * phi);
    for (double& value : values) {
      value = 10.0 + off;
      off = phi * off + normal(random);
    }
    const Estimate e = estimate_mean(values);
    held += std::fabs(e.mean - 10.0) <= *e.ci95_half_width ? 1 : 0;
  }
  return static_cast<double>(held) / runs;
}

TEST(Statistics, IntervalOfIndependentSamplesHoldsTheMean95TimesIn100) {
  for (const int samples : {3, 9, 30, 100, 400}) {
    const double share = coverage(0.0, samples, 3000, 11);
    EXPECT_GE(share, 0.93) << samples;
    EXPECT_LE(share, 0.97) << samples;
  }
}

TEST(Statistics, IntervalOfCorrelatedSamplesHoldsTheMean95TimesIn100) {
  struct Case {
    double phi;
    int samples;
  };
  for (const Case& c : {Case{0.3, 400}, Case{0.5, 400}, Case{0.8, 2000}, Case{0.9, 4000}}) {
    const double share = coverage(c.phi, c.samples, 800, 12);
    EXPECT_GE(share, 0.93) << c.phi;
    EXPECT_LE(share, 0.97) << c.phi;
  }
}

TEST(Statistics, CorrelatedSamplesCountForFewer) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> values(20000);
  double off = 0;
  for (double& value : values) value = off = 0.8 * off + normal(random);
  // (1 - phi) / (1 + phi) = 1/9 of them, for an endless series.
  EXPECT_NEAR(*estimate_mean(values).effective_samples, 20000.0 / 9.0, 1000.0);
}

TEST(Statistics, PercentilesLieBetweenTheirNeighbours) {
  const std::vector<double> values{30, 10, 40, 20};
  EXPECT_DOUBLE_EQ(*median(values), 25.0);
  EXPECT_DOUBLE_EQ(*percentile(values, 0.0), 10.0);
  EXPECT_DOUBLE_EQ(*percentile(values, 1.0), 40.0);
  EXPECT_DOUBLE_EQ(*percentile(values, 0.95), 38.5);
  EXPECT_FALSE(percentile({}, 0.5));
}

}  // namespace
}  // namespace encore::energy
