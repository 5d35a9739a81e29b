#include "energy/convergence/correlation.h"

#include "tests/convergence/series.h"

#include <gtest/gtest.h>

#include <vector>

namespace encore::energy {
namespace {

TEST(Correlation, FirstLagFindsTheInflationOfAnAr1Series) {
  for (const double phi : {0.0, 0.5, 0.8, 0.9}) {
    test::Ar1 series(phi, 6);
    EXPECT_NEAR(first_lag_inflation(series.take(20000), 1) / series.inflation(), 1.0, 0.1) << phi;
  }
}

TEST(Correlation, ItsBiasOnShortSeriesIsUndone) {
  double sum = 0.0;
  for (unsigned run = 0; run < 2000; ++run) {
    auto values = test::Ar1(0.5, run).take(60);
    double mean = 0.0;
    for (const double v : values) mean += v / 60.0;
    for (double& v : values) v -= mean;
    const double inflation = first_lag_inflation(values, 1);
    sum += (inflation - 1.0) / (inflation + 1.0);  // phi again
  }
  EXPECT_NEAR(sum / 2000.0, 0.5, 0.01);
}

TEST(Correlation, SlowWanderingIsSeenBelowFastScatter) {
  // Var 0.64 white and 0.36 of phi 0.95: the inflation is 0.64 + 0.36 * 39 = 14.7.
  auto values = test::Ar1(0.0, 1).take(20000);
  test::Ar1 slow(0.95, 2);
  for (double& v : values) v = 0.8 * v + 0.6 * slow.next();
  EXPECT_LT(first_lag_inflation(values, 1), 3.0);
  EXPECT_GT(scaled_inflation(values), 10.0);
  EXPECT_LT(scaled_inflation(values), 25.0);
}

TEST(Correlation, CautiousMeanIsNeverSurerThanTheEstimate) {
  for (const double phi : {0.0, 0.8}) {
    for (unsigned run = 0; run < 50; ++run) {
      const auto values = test::Ar1(phi, run).take(150);
      const Estimate plain = estimate_mean(values);
      const Estimate cautious = cautious_mean(values, {});
      EXPECT_EQ(cautious.mean, plain.mean);
      EXPECT_GE(*cautious.ci95_half_width, *plain.ci95_half_width);
      EXPECT_LE(*cautious.effective_samples, *plain.effective_samples);
    }
  }
}

TEST(Correlation, EqualValuesAreExact) {
  const Estimate estimate = cautious_mean(std::vector<double>(64, 0.1), {});
  EXPECT_EQ(estimate.mean, 0.1);
  EXPECT_EQ(*estimate.ci95_half_width, 0.0);
}

}  // namespace
}  // namespace encore::energy
