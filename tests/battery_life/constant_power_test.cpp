#include "energy/battery_life/constant_power.h"

#include <gtest/gtest.h>

#include <cmath>

namespace encore::energy {
namespace {

TEST(ConstantPower, TimeIsEnergyOverPower) {
  EXPECT_DOUBLE_EQ(constant_power_time(Joules(53.0 * 3600.0), Watts(30.0))->value, 6360.0);
  EXPECT_FALSE(constant_power_time(Joules(1.0), Watts(0.0)));
  EXPECT_FALSE(constant_power_time(Joules(1e6), Watts(1e-308))) << "beyond numbers";
}

TEST(ConstantPower, CurrentAndTerminalVoltageOfAnExample) {
  const double amperes = *current_for_power(11.4, 0.1, Watts(30.0));
  EXPECT_NEAR(amperes, 2.695304, 5e-7);
  EXPECT_NEAR(11.4 - 0.1 * amperes, 11.130470, 5e-7);
}

TEST(ConstantPower, TheCurrentGivesThePower) {
  for (const double emf : {1e-3, 1.0, 11.4, 1e3}) {
    for (const double r0 : {0.0, 1e-12, 1e-3, 0.1, 10.0}) {
      for (const double share : {1e-12, 1e-3, 0.5, 0.999, 1.0}) {
        // The most that this source gives is E^2 / (4 R0).
        const double watts = r0 > 0.0 ? share * emf * emf / (4.0 * r0) : share * 100.0;
        const auto amperes = current_for_power(emf, r0, Watts(watts));
        if (!amperes) {
          // At the very edge rounding may decide.
          EXPECT_EQ(share, 1.0);
          continue;
        }
        EXPECT_NEAR(*amperes * (emf - *amperes * r0) / watts, 1.0, 1e-12) << emf << ' ' << r0;
        if (r0 > 0.0) {
          EXPECT_LE(*amperes, emf / (2.0 * r0) * (1.0 + 1e-12)) << "smaller root";
        }
      }
    }
  }
}

TEST(ConstantPower, TooMuchPowerIsABrownOut) {
  EXPECT_FALSE(current_for_power(11.4, 0.1, Watts(11.4 * 11.4 / 0.4 * 1.0001)));
  EXPECT_FALSE(current_for_power(0.0, 0.1, Watts(1.0)));
  EXPECT_FALSE(current_for_power(11.4, 0.1, Watts(1e308)));
  EXPECT_EQ(*current_for_power(11.4, 0.1, Watts(0.0)), 0.0);
}

TEST(ConstantPower, SmallResistancesDoNotCancel) {
  // 2 P / (E + sqrt(E^2 - 4 R0 P)) = P/E (1 + R0 P / E^2 + ...): the naive root is 0 here.
  const double amperes = *current_for_power(10.0, 1e-18, Watts(1.0));
  EXPECT_DOUBLE_EQ(amperes, 0.1);
}

}  // namespace
}  // namespace encore::energy
