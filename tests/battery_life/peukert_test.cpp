#include "energy/battery_life/peukert.h"

#include <gtest/gtest.h>

#include <cmath>

namespace encore::energy {
namespace {

TEST(Peukert, TheRatedCurrentLastsTheRatedHours) {
  for (const double exponent : {1.0, 1.05, 1.3}) {
    EXPECT_DOUBLE_EQ(peukert_time(7200.0, {exponent, 20.0}, 0.1)->value, 72000.0);
  }
}

TEST(Peukert, AnExponentOfOneIsAPlainChargeCounter) {
  EXPECT_DOUBLE_EQ(peukert_time(7200.0, {1.0, 20.0}, 2.0)->value, 3600.0);
}

TEST(Peukert, TwiceTheCurrentLastsTwoToTheMinusKAsLong) {
  const PeukertParameters peukert{1.1, 5.0};
  const double one = peukert_time(7200.0, peukert, 1.0)->value;
  const double two = peukert_time(7200.0, peukert, 2.0)->value;
  EXPECT_NEAR(two / one, std::pow(2.0, -1.1), 1e-14);
}

TEST(Peukert, NoCurrentNeverEnds) {
  EXPECT_FALSE(peukert_time(7200.0, {}, 0.0));
  EXPECT_FALSE(peukert_time(7200.0, {}, 1e-300));
}

TEST(Peukert, TheFitFindsTheExponentAgain) {
  const PeukertParameters peukert{1.07, 5.0};
  const auto discharge = [&](double amperes) {
    return MeasuredDischarge{amperes, *peukert_time(17280.0, peukert, amperes)};
  };
  EXPECT_NEAR(*fit_peukert(discharge(0.5), discharge(4.0)), 1.07, 1e-14);
  EXPECT_NEAR(*fit_peukert(discharge(4.0), discharge(0.5)), 1.07, 1e-14);
  EXPECT_NEAR(*fit_peukert(discharge(1.0), discharge(1.0001)), 1.07, 1e-10) << "close currents";
}

TEST(Peukert, TheFitNeedsTwoDifferentCurrents) {
  EXPECT_FALSE(fit_peukert({1.0, Seconds(100.0)}, {1.0, Seconds(90.0)}));
  EXPECT_FALSE(fit_peukert({1.0, Seconds(0.0)}, {2.0, Seconds(90.0)}));
  EXPECT_FALSE(fit_peukert({-1.0, Seconds(10.0)}, {2.0, Seconds(90.0)}));
}

}  // namespace
}  // namespace encore::energy
