#include "energy/attribution/nnls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace encore::energy {
namespace {

DenseMatrix random_matrix(std::size_t rows, std::size_t columns, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  DenseMatrix a(rows, columns);
  for (std::size_t c = 0; c < columns; ++c) {
    for (double& v : a.column(c)) v = normal(random);
  }
  return a;
}

std::vector<double> times(const DenseMatrix& a, const std::vector<double>& x) {
  std::vector<double> product(a.rows(), 0.0);
  for (std::size_t c = 0; c < a.columns(); ++c) {
    for (std::size_t r = 0; r < a.rows(); ++r) product[r] += a(r, c) * x[c];
  }
  return product;
}

/// The smallest residual over all subsets of columns whose least squares is allowed.
double best_by_trying_all(const DenseMatrix& a, const std::vector<double>& b,
                          const std::vector<bool>& free) {
  const std::size_t n = a.columns();
  double best = std::numeric_limits<double>::infinity();
  for (unsigned mask = 0; mask < (1U << n); ++mask) {
    std::vector<bool> keep(n);
    bool allowed = true;
    for (std::size_t c = 0; c < n; ++c) {
      keep[c] = (mask >> c & 1U) != 0;
      allowed = allowed && (keep[c] || !free[c]);
    }
    if (!allowed) continue;
    const DenseMatrix part = a.select(keep);
    const Triangle t = triangularise(part, b);
    const std::vector<double> x = solve_upper(t.r, t.y);
    std::size_t next = 0;
    for (std::size_t c = 0; c < n; ++c) {
      if (keep[c] && x[next++] < 0.0 && !free[c]) allowed = false;
    }
    if (allowed) best = std::min(best, t.rest);
  }
  return best;
}

TEST(Nnls, IsAsGoodAsTheBestOfAllActiveSets) {
  std::mt19937_64 random(3);
  int stopped = 0;
  for (int run = 0; run < 400; ++run) {
    const std::size_t columns = 1 + run % 6;
    const DenseMatrix a = random_matrix(12, columns, random);
    const DenseMatrix b = random_matrix(12, 1, random);
    const std::vector<double> values(b.column(0).begin(), b.column(0).end());
    std::vector<bool> free(columns);
    for (std::size_t c = 0; c < columns; ++c) free[c] = random() % 3 == 0;
    const NnlsFit fit = solve_nnls(a, values, free);
    ASSERT_TRUE(fit.converged);
    EXPECT_NEAR(fit.residual_norm, best_by_trying_all(a, values, free), 1e-11) << run;
    for (std::size_t c = 0; c < columns; ++c) {
      EXPECT_TRUE(free[c] || fit.x[c] >= 0.0);
      EXPECT_TRUE(!fit.at_bound[c] || (fit.x[c] == 0.0 && !free[c]));
      stopped += fit.at_bound[c] ? 1 : 0;
    }
  }
  EXPECT_GT(stopped, 200);  // the bound mattered
}

TEST(Nnls, MeetsTheConditionsOfKarushKuhnAndTucker) {
  std::mt19937_64 random(4);
  for (int run = 0; run < 200; ++run) {
    const DenseMatrix a = random_matrix(30, 5, random);
    const DenseMatrix b = random_matrix(30, 1, random);
    const NnlsFit fit = solve_nnls(a, b.column(0));
    std::vector<double> off(b.column(0).begin(), b.column(0).end());
    const std::vector<double> reached = times(a, fit.x);
    for (std::size_t r = 0; r < off.size(); ++r) off[r] -= reached[r];
    for (std::size_t c = 0; c < 5; ++c) {
      double slope = 0.0;
      for (std::size_t r = 0; r < off.size(); ++r) slope += a(r, c) * off[r];
      if (fit.at_bound[c]) {
        EXPECT_LE(slope, 1e-11);
      } else {
        EXPECT_NEAR(slope, 0.0, 1e-11);
      }
    }
  }
}

TEST(Nnls, RecoversCoefficientsOfColumnsOfVeryDifferentSize) {
  std::mt19937_64 random(5);
  DenseMatrix a = random_matrix(200, 4, random);
  const std::vector<double> sizes{1e-6, 1.0, 1e5, 1e-3};
  for (std::size_t c = 0; c < 4; ++c) {
    for (double& v : a.column(c)) v = std::fabs(v) * sizes[c];
  }
  const std::vector<double> truth{1000.0, 50.0, 3e-5, 0.0};
  const NnlsFit fit = solve_nnls(a, times(a, truth));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(fit.x[c] / truth[c], 1.0, 1e-6) << c;
  EXPECT_NEAR(fit.x[3] * sizes[3], 0.0, 1e-9);
}

TEST(Nnls, NearlyParallelColumnsKeepTheDigitsThatQrKeeps) {
  // Columns 1 and 1 + 1e-5 e: normal equations would leave 6 digits.
  std::mt19937_64 random(6);
  DenseMatrix a = random_matrix(50, 2, random);
  for (std::size_t r = 0; r < 50; ++r) {
    a(r, 1) = 1.0 + 1e-5 * a(r, 0);
    a(r, 0) = 1.0;
  }
  const NnlsFit fit = solve_nnls(a, times(a, {2.0, 3.0}));
  EXPECT_NEAR(fit.x[0], 2.0, 1e-9);
  EXPECT_NEAR(fit.x[1], 3.0, 1e-9);
}

TEST(Nnls, DependentColumnsStillGiveABestFit) {
  DenseMatrix a(4, 3);
  for (std::size_t r = 0; r < 4; ++r) {
    a(r, 0) = static_cast<double>(r + 1);
    a(r, 1) = 2.0 * a(r, 0);  // and column 2 is 0
  }
  const NnlsFit fit = solve_nnls(a, times(a, {1.0, 1.0, 0.0}));
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.residual_norm, 0.0, 1e-12);
  EXPECT_NEAR(fit.x[0] + 2.0 * fit.x[1], 3.0, 1e-12);
  EXPECT_EQ(fit.x[2], 0.0);
}

TEST(Nnls, FewerRowsThanColumnsAndZeroValuesAreNoTrouble) {
  std::mt19937_64 random(7);
  const DenseMatrix a = random_matrix(2, 4, random);
  EXPECT_TRUE(solve_nnls(a, std::vector<double>{1.0, 1.0}).converged);
  const NnlsFit none = solve_nnls(a, std::vector<double>{0.0, 0.0});
  EXPECT_EQ(none.x, std::vector<double>(4, 0.0));
}

TEST(Spectrum, ConditionOfKnownMatrices) {
  DenseMatrix a(3, 2);
  a(0, 0) = 3.0;
  a(1, 1) = 1e-8;
  EXPECT_NEAR(spectrum(a).condition() / 3e8, 1.0, 1e-12);
  // Two unit columns at an angle: sqrt((1 + cos) / (1 - cos)).
  DenseMatrix b(2, 2);
  b(0, 0) = 1.0;
  b(0, 1) = 0.8;
  b(1, 1) = 0.6;
  const Spectrum s = spectrum(b);
  EXPECT_NEAR(s.condition(), 3.0, 1e-12);
  EXPECT_NEAR(std::fabs(s.weakest[0]), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(s.weakest[0], -s.weakest[1], 1e-12);
  DenseMatrix c(2, 2);
  c(0, 0) = c(0, 1) = 1.0;
  EXPECT_EQ(spectrum(c).condition(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace encore::energy
