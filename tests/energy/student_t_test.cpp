#include "energy/student_t.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace encore::energy {
namespace {

void expect_near_relative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::fabs(expected));
}

TEST(StudentT, QuantilesEqualThePublishedTables) {
  struct Entry {
    double p, dof, t;
  };
  for (const Entry& e : {Entry{0.975, 3, 3.182446305284263}, Entry{0.975, 5, 2.570581835636314},
                         Entry{0.975, 10, 2.228138851964939}, Entry{0.975, 30, 2.042272456301238},
                         Entry{0.975, 120, 1.979930405052777}, Entry{0.95, 10, 1.812461122811676},
                         Entry{0.995, 10, 3.169272672616888}, Entry{0.9995, 4, 8.610301581379300},
                         Entry{0.99, 20, 2.527977002740546}}) {
    expect_near_relative(student_t_quantile(e.p, e.dof), e.t, 1e-9);
  }
}

TEST(StudentT, OneAndTwoDegreesOfFreedomEqualTheirClosedForms) {
  for (const double p : {0.001, 0.025, 0.2, 0.4, 0.6, 0.9, 0.975, 0.9999}) {
    expect_near_relative(student_t_quantile(p, 1), std::tan(M_PI * (p - 0.5)), 1e-9);
    expect_near_relative(student_t_quantile(p, 2), (2 * p - 1) / std::sqrt(2 * p * (1 - p)), 1e-9);
  }
}

TEST(StudentT, TailFollowsTheArcTangentFarOut) {
  for (const double t : {0.1, 1.0, 10.0, 1e3, 1e6}) {
    expect_near_relative(student_t_tail(t, 1), std::atan2(1.0, t) / M_PI, 1e-11);
  }
}

TEST(StudentT, ManyDegreesOfFreedomApproachTheNormalDistribution) {
  EXPECT_NEAR(student_t_quantile(0.975, 1e6), 1.959963984540054, 4e-6);
  expect_near_relative(student_t_tail(3.0, 1e6), 0.5 * std::erfc(3.0 / std::sqrt(2.0)), 1e-4);
}

TEST(StudentT, QuantileUndoesTheTailAlsoForFractionalDegrees) {
  for (const double dof : {0.7, 1.5, 4.2, 37.9, 1234.5}) {
    for (const double p : {0.55, 0.8, 0.975, 0.9999}) {
      expect_near_relative(student_t_tail(student_t_quantile(p, dof), dof), 1 - p, 1e-10);
    }
  }
}

TEST(StudentT, TheDistributionIsSymmetric) {
  EXPECT_EQ(student_t_quantile(0.5, 7), 0.0);
  EXPECT_NEAR(student_t_quantile(0.1, 7), -student_t_quantile(0.9, 7), 1e-13);
  EXPECT_NEAR(student_t_tail(-1.3, 7) + student_t_tail(1.3, 7), 1.0, 1e-15);
}

TEST(StudentT, ArgumentsOutsideTheDomainGiveNoNumber) {
  EXPECT_TRUE(std::isnan(student_t_quantile(1.5, 5)));
  EXPECT_TRUE(std::isnan(student_t_quantile(0.9, 0)));
  EXPECT_TRUE(std::isnan(student_t_tail(1, -1)));
  EXPECT_EQ(student_t_quantile(1.0, 5), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace encore::energy
