#include "energy/battery_life/present.h"

#include "energy/battery_life/runtime.h"

#include <gtest/gtest.h>

namespace encore::energy {
namespace {

BatteryState gauge() {
  BatteryState state;
  state.name = "BAT0";
  state.status = "Discharging";
  state.now = Joules(20.0 * 3600.0);
  state.full = Joules(40.0 * 3600.0);
  state.design = Joules(53.0 * 3600.0);
  state.voltage = 11.9;
  state.design_voltage = 11.1;
  return state;
}

TEST(BatteryPresent, TodaysFullChargeAndTheChargeNowCount) {
  const Battery b = battery_present(gauge());
  EXPECT_EQ(battery_fault(b), "");
  EXPECT_EQ(b.name, "BAT0");
  EXPECT_EQ(b.series, 3);
  EXPECT_EQ(b.nominal_volts, 11.1);
  EXPECT_DOUBLE_EQ(b.full.value, 40.0 * 3600.0);
  EXPECT_DOUBLE_EQ(b.coulombs, 40.0 * 3600.0 / 11.1);
  EXPECT_DOUBLE_EQ(b.soc, 0.5);
  const BatteryForecast f = forecast(b, {Watts(20.0), {}}, BatteryModel::constant);
  EXPECT_DOUBLE_EQ(f.time->value, 3600.0);
}

TEST(BatteryPresent, FallsBackToTheDesignAndTheVoltageNow) {
  BatteryState state = gauge();
  state.full.reset();
  state.design_voltage.reset();
  const Battery b = battery_present(state);
  EXPECT_EQ(b.nominal_volts, 11.9);
  EXPECT_DOUBLE_EQ(b.full.value, 53.0 * 3600.0);
}

TEST(BatteryPresent, MoreThanFullIsFull) {
  BatteryState state = gauge();
  state.now = Joules(40.3 * 3600.0);
  EXPECT_EQ(battery_present(state).soc, 1.0);
}

TEST(BatteryPresent, WhatTheGaugeDoesNotTellIsNamedAndNeverZero) {
  const auto error_of = [](const BatteryState& state) {
    try {
      battery_present(state);
    } catch (const BatteryError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BatteryState no_charge = gauge();
  no_charge.now.reset();
  EXPECT_NE(error_of(no_charge).find("BAT0 does not tell its charge now"), std::string::npos);
  BatteryState no_full = gauge();
  no_full.full.reset();
  no_full.design.reset();
  EXPECT_NE(error_of(no_full).find("full charge"), std::string::npos);
  BatteryState no_voltage = gauge();
  no_voltage.voltage.reset();
  no_voltage.design_voltage = 0.0;
  EXPECT_NE(error_of(no_voltage).find("voltage"), std::string::npos);
}

}  // namespace
}  // namespace encore::energy
