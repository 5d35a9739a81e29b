#include "energy/model/model_fit.h"

#include "energy/model/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace encore::energy {
namespace {

const std::vector<std::string> kNames{"build", "render", "transfer"};

/// An operation with these busy seconds and as much of a gap, at exact gross rates.
ModelObservation observed(bool calibrates, const std::vector<double>& busy,
                          const std::vector<double>& watts, double gap = 0.0, double idle = 0.0) {
  ModelObservation seen;
  seen.name = "observation";
  seen.calibrates = calibrates;
  seen.seconds.value = gap;
  for (std::size_t k = 0; k < busy.size(); ++k) {
    if (busy[k] > 0.0) seen.work.push_back({kNames[k], {busy[k], 0.0}, k});
    seen.seconds.value += busy[k];
    seen.joules.value += busy[k] * watts[k];
  }
  seen.joules.value += idle * seen.seconds.value;
  return seen;
}

TEST(LeastSquares, SolvesWhatQrSolves) {
  // y = 1 + 2 x, off by (0.1, -0.1, -0.1, 0.1): the offsets are orthogonal to both columns.
  const std::vector<std::vector<double>> rows{{1, 0}, {1, 1}, {1, 2}, {1, 3}};
  const std::vector<double> given{1.1, 2.9, 4.9, 7.1};
  const auto solution = solve_least_squares(rows, given);
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->coefficients[0], 1.0, 1e-12);
  EXPECT_NEAR(solution->coefficients[1], 2.0, 1e-12);
  EXPECT_EQ(solution->degrees_of_freedom, 2U);
  EXPECT_NEAR(*solution->residual_deviation(), std::sqrt(0.04 / 2.0), 1e-12);
  // Columns of length 2 and sqrt(14), inner product 6: singular values sqrt(1 +- 6 / (2 sqrt 14)).
  const double cosine = 6.0 / (2.0 * std::sqrt(14.0));
  EXPECT_NEAR(solution->condition, std::sqrt((1 + cosine) / (1 - cosine)), 1e-12);
}

TEST(LeastSquares, ScaleOfColumnsDoesNotCount) {
  const std::vector<std::vector<double>> rows{{1e9, 0}, {1e9, 1e-6}, {1e9, 2e-6}};
  const auto solution = solve_least_squares(rows, std::vector<double>{3, 5, 7});
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->coefficients[0] * 1e9, 3.0, 1e-9);
  EXPECT_NEAR(solution->coefficients[1] * 1e-6, 2.0, 1e-9);
  EXPECT_LT(solution->condition, 10.0);
}

TEST(LeastSquares, NothingWithoutIndependentColumnsOrEnoughRows) {
  const std::vector<double> given{1, 2, 3};
  EXPECT_FALSE(
      solve_least_squares(std::vector<std::vector<double>>{{1, 2}, {2, 4}, {3, 6}}, given));
  EXPECT_FALSE(
      solve_least_squares(std::vector<std::vector<double>>{{1, 0}, {2, 0}, {3, 0}}, given));
  EXPECT_FALSE(solve_least_squares(std::vector<std::vector<double>>{{1, 2}}, given));
  EXPECT_FALSE(solve_least_squares({}, given));
}

TEST(ModelFit, ExactRatesAreFoundAndPredictDynamicOperations) {
  const std::vector<double> watts{33.6, 40.2, 36.0};
  std::vector<ModelObservation> seen{
      observed(true, {0.1, 0, 0}, watts), observed(true, {0.003, 0, 0}, watts),
      observed(true, {0, 0.4, 0}, watts), observed(true, {0, 2.0, 0}, watts),
      observed(false, {0.1, 0.4, 0}, watts)};
  const RateFit fit = fit_rates(kNames, seen, IdleTerm::none);
  ASSERT_TRUE(fit.fitted()) << fit.problem;
  EXPECT_NEAR(fit.rates[0]->value, 33.6, 1e-9);
  EXPECT_NEAR(fit.rates[1]->value, 40.2, 1e-9);
  EXPECT_FALSE(fit.rates[2]) << "no transfer was seen";
  EXPECT_TRUE(fit.half_widths_known);
  ASSERT_EQ(fit.checks.size(), 5U);
  EXPECT_NEAR(fit.checks[4].error, 0.0, 1e-9);
  EXPECT_EQ(fit.checks[4].assumed_share, 0.0);
  EXPECT_EQ(errors_of(fit, seen, false).count, 1U);
  EXPECT_EQ(errors_of(fit, seen, true).count, 4U);
}

TEST(ModelFit, TransferWithoutARateIsTakenAtTheMeanOfTheRest) {
  const std::vector<double> watts{30.0, 50.0, 36.0};
  const std::vector<ModelObservation> seen{observed(true, {1, 0, 0}, watts),
                                           observed(true, {0, 1, 0}, watts),
                                           observed(false, {0.1, 0.3, 0.1}, watts)};
  const RateFit fit = fit_rates(kNames, seen, IdleTerm::none);
  ASSERT_TRUE(fit.fitted()) << fit.problem;
  const ModelCheck& check = fit.checks.back();
  EXPECT_NEAR(check.assumed_share, 0.2, 1e-12);
  EXPECT_NEAR(check.prediction.watts.value, 45.0, 1e-9);  // (30 x 0.1 + 50 x 0.3) / 0.4
  EXPECT_NEAR(check.error, 45.0 * 0.5 / 21.6 - 1.0, 1e-9);
}

TEST(ModelFit, GapsNeedTheIdleTerm) {
  // Work above idle, with gaps of very different length: the sequential model is off.
  const std::vector<double> above{10.0, 25.0, 0.0};
  std::vector<ModelObservation> seen;
  for (const double gap : {0.0, 0.5, 2.0}) {
    seen.push_back(observed(true, {1.0, 0, 0}, above, gap, 20.0));
    seen.push_back(observed(true, {0, 1.0, 0}, above, gap, 20.0));
  }
  seen.push_back(observed(false, {0.5, 0.5, 0}, above, 0.0, 20.0));
  const RateFit thesis = fit_rates(kNames, seen, IdleTerm::none);
  const RateFit given = fit_rates(kNames, seen, IdleTerm::given, {20.0, 0.0});
  const RateFit found = fit_rates(kNames, seen, IdleTerm::fit);
  ASSERT_TRUE(thesis.fitted() && given.fitted() && found.fitted())
      << thesis.problem << given.problem << found.problem;
  EXPECT_GT(std::fabs(errors_of(thesis, seen, false).worst), 0.1);
  EXPECT_NEAR(errors_of(given, seen, false).worst, 0.0, 1e-9);
  EXPECT_NEAR(errors_of(found, seen, false).worst, 0.0, 1e-9);
  EXPECT_NEAR(given.rates[0]->value, 10.0, 1e-9);
  EXPECT_NEAR(found.idle_watts->value, 20.0, 1e-9);
  EXPECT_TRUE(found.idle_fitted);
  EXPECT_FALSE(given.idle_fitted);
}

TEST(ModelFit, IdleBesideWorkThatFillsEveryOperationIsRefused) {
  const std::vector<double> watts{30.0, 50.0, 0.0};
  const std::vector<ModelObservation> seen{
      observed(true, {1, 0, 0}, watts), observed(true, {0, 1, 0}, watts),
      observed(true, {2, 0, 0}, watts), observed(true, {0, 3, 0}, watts)};
  const RateFit fit = fit_rates(kNames, seen, IdleTerm::fit);
  EXPECT_FALSE(fit.fitted());
  EXPECT_TRUE(fit.checks.empty());
  EXPECT_FALSE(fit.rates[0]);
  EXPECT_NE(fit.problem.find("idle power has to be given"), std::string::npos) << fit.problem;
}

TEST(ModelFit, OneMixOnlyIsRefused) {
  const std::vector<double> watts{30.0, 50.0, 0.0};
  const std::vector<ModelObservation> seen{observed(true, {1, 2, 0}, watts),
                                           observed(true, {2, 4, 0}, watts)};
  const RateFit fit = fit_rates(kNames, seen, IdleTerm::none);
  EXPECT_FALSE(fit.fitted());
  EXPECT_NE(fit.problem.find("mix"), std::string::npos) << fit.problem;
}

TEST(ModelFit, NegativeRatesAreRefused) {
  ModelObservation less = observed(true, {1, 1, 0}, {30.0, 0.0, 0.0});
  less.joules.value = 20.0;
  const std::vector<ModelObservation> seen{observed(true, {1, 0, 0}, {30.0, 0.0, 0.0}), less};
  const RateFit fit = fit_rates(kNames, seen, IdleTerm::none);
  EXPECT_FALSE(fit.fitted());
  EXPECT_NE(fit.problem.find("render negative"), std::string::npos) << fit.problem;
}

TEST(ModelFit, MeasurementIsPropagatedWhereNothingScatters) {
  const std::vector<double> watts{30.0, 50.0, 0.0};
  std::vector<ModelObservation> seen{observed(true, {1, 0, 0}, watts),
                                     observed(true, {0, 1, 0}, watts)};
  EXPECT_FALSE(fit_rates(kNames, seen, IdleTerm::none).half_widths_known);
  seen[0].joules.half_width = 0.6;
  seen[1].joules.half_width = 2.0;
  const RateFit fit = fit_rates(kNames, seen, IdleTerm::none);
  EXPECT_TRUE(fit.half_widths_known);
  EXPECT_NEAR(fit.rates[0]->half_width, 0.6, 1e-12);
  EXPECT_NEAR(fit.rates[1]->half_width, 2.0, 1e-12);
}

TEST(ModelFit, IntervalsHoldTheTrueRates95TimesIn100) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  const std::vector<double> watts{33.6, 40.2, 0.0};
  int held = 0;
  constexpr int kRuns = 2000;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<ModelObservation> seen;
    for (int i = 0; i < 4; ++i) {
      seen.push_back(observed(true, {0.01 * (i + 1), 0, 0}, watts));
      seen.push_back(observed(true, {0.02, 0.5 + i, 0}, watts));
    }
    for (ModelObservation& one : seen) one.joules.value *= 1.0 + noise(random);
    const RateFit fit = fit_rates(kNames, seen, IdleTerm::none);
    held += std::fabs(fit.rates[0]->value - watts[0]) <= fit.rates[0]->half_width ? 1 : 0;
    held += std::fabs(fit.rates[1]->value - watts[1]) <= fit.rates[1]->half_width ? 1 : 0;
  }
  EXPECT_GE(held, 0.93 * 2 * kRuns);
  EXPECT_LE(held, 0.97 * 2 * kRuns);
}

TEST(ModelFit, ErrorsAreSummedWithTheirSigns) {
  const std::vector<double> watts{30.0, 50.0, 0.0};
  std::vector<ModelObservation> seen{
      observed(true, {1, 0, 0}, watts), observed(true, {0, 1, 0}, watts),
      observed(false, {1, 1, 0}, watts), observed(false, {2, 1, 0}, watts)};
  seen[2].joules.value *= 1.1;
  seen[3].joules.value *= 0.8;
  const ModelErrors errors = errors_of(fit_rates(kNames, seen, IdleTerm::none), seen, false);
  EXPECT_EQ(errors.count, 2U);
  EXPECT_NEAR(errors.worst, 0.25, 1e-9);
  EXPECT_NEAR(errors.mean, (1 / 1.1 - 1 + 0.25) / 2, 1e-9);
  EXPECT_NEAR(errors.rms, std::sqrt((std::pow(1 / 1.1 - 1, 2) + 0.0625) / 2), 1e-9);
}

TEST(ModelFit, JoulesOfZeroAreAnError) {
  std::vector<ModelObservation> seen{observed(true, {1, 0, 0}, {30.0, 50.0, 0.0})};
  seen[0].joules.value = 0.0;
  EXPECT_THROW((void)fit_rates(kNames, seen, IdleTerm::none), std::invalid_argument);
}

}  // namespace
}  // namespace encore::energy
