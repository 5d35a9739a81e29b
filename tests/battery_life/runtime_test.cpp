#include "energy/battery_life/runtime.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace encore::energy {
namespace {

const Battery kLaptop = *battery_preset("thesis-laptop");

TEST(Runtime, TheLaptopAtThirtyWattsByEveryModel) {
  const auto minutes = [](BatteryModel model) {
    return forecast(kLaptop, {Watts(30.0), {}}, model).time->value / 60.0;
  };
  EXPECT_NEAR(minutes(BatteryModel::constant), 106.0, 1e-9) << "53 Wh / 30 W";
  // I = 30 / 11.1 A; 5 h (0.96 / I)^1.05.
  EXPECT_NEAR(minutes(BatteryModel::peukert), 300.0 * std::pow(0.96 * 11.1 / 30.0, 1.05), 1e-9);
  EXPECT_NEAR(minutes(BatteryModel::kinetic), 90.710, 5e-4);
  EXPECT_NEAR(minutes(BatteryModel::thevenin), 102.48, 0.01);
}

TEST(Runtime, DeliveredIsLoadTimesTime) {
  for (const BatteryModel model : kBatteryModels) {
    const BatteryForecast f = forecast(kLaptop, {Watts(45.0), {}}, model);
    ASSERT_TRUE(f.time);
    EXPECT_DOUBLE_EQ(f.delivered->value, 45.0 * f.time->value);
    EXPECT_EQ(f.model, model);
    EXPECT_FALSE(f.earliest);
    EXPECT_FALSE(f.latest);
  }
}

TEST(Runtime, MoreLoadNeverLastsLonger) {
  for (const BatteryModel model : kBatteryModels) {
    double before = std::numeric_limits<double>::infinity();
    for (double watts = 0.01; watts < 3000.0; watts *= 1.3) {
      const BatteryForecast f = forecast(kLaptop, {Watts(watts), {}}, model);
      ASSERT_TRUE(f.time) << watts;
      EXPECT_LT(f.time->value, before + 1e-12) << to_string(model) << ' ' << watts;
      before = f.time->value;
    }
  }
}

TEST(Runtime, HalfTheChargeLastsHalfAsLongWhereNothingElseMatters) {
  Battery half = kLaptop;
  half.soc = 0.5;
  for (const BatteryModel model : {BatteryModel::constant, BatteryModel::peukert}) {
    const double whole = forecast(kLaptop, {Watts(30.0), {}}, model).time->value;
    EXPECT_DOUBLE_EQ(forecast(half, {Watts(30.0), {}}, model).time->value, whole / 2.0);
  }
  half.soc = 0.0;
  for (const BatteryModel model : kBatteryModels) {
    EXPECT_EQ(forecast(half, {Watts(30.0), {}}, model).time->value, 0.0) << to_string(model);
  }
}

TEST(Runtime, TheIntervalIsThatOfTheLoad) {
  for (const BatteryModel model : kBatteryModels) {
    const BatteryForecast f = forecast(kLaptop, {Watts(30.0), Watts(3.0)}, model);
    EXPECT_EQ(f.earliest->value, forecast(kLaptop, {Watts(33.0), {}}, model).time->value);
    EXPECT_EQ(f.latest->value, forecast(kLaptop, {Watts(27.0), {}}, model).time->value);
    EXPECT_LT(*f.earliest, *f.time);
    EXPECT_GT(*f.latest, *f.time);
    // The light end may be no load at all, which has no end.
    const BatteryForecast wide = forecast(kLaptop, {Watts(30.0), Watts(40.0)}, model);
    EXPECT_TRUE(wide.earliest);
    EXPECT_FALSE(wide.latest);
  }
}

TEST(Runtime, NoLoadNeverEnds) {
  for (const BatteryModel model : kBatteryModels) {
    const BatteryForecast f = forecast(kLaptop, {Watts(0.0), {}}, model);
    EXPECT_EQ(f.reason, EndReason::never) << to_string(model);
    EXPECT_FALSE(f.time);
    EXPECT_FALSE(f.delivered);
    EXPECT_FALSE(frames_left(f, {Watts(0.0), {}}, Joules(1.0)));
  }
}

TEST(Runtime, ExtremeLoadsStayFinite) {
  for (const BatteryModel model : kBatteryModels) {
    for (const double watts : {1e-9, 1e9, 1e300}) {
      const BatteryForecast f = forecast(kLaptop, {Watts(watts), {}}, model);
      ASSERT_TRUE(f.time) << to_string(model) << ' ' << watts;
      EXPECT_TRUE(std::isfinite(f.time->value));
      EXPECT_GE(f.time->value, 0.0);
    }
  }
  // Only models with a resistance know that some loads are impossible.
  EXPECT_EQ(forecast(kLaptop, {Watts(1e9), {}}, BatteryModel::constant).reason,
            EndReason::brown_out);
  const BatteryForecast f = forecast(kLaptop, {Watts(1e9), {}}, BatteryModel::thevenin);
  EXPECT_EQ(f.reason, EndReason::brown_out);
  EXPECT_FALSE(f.note.empty());
}

TEST(Runtime, LoadsThatAreNoneAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double watts : {-1.0, nan, infinity}) {
    EXPECT_THROW(forecast(kLaptop, {Watts(watts), {}}, BatteryModel::constant),
                 std::invalid_argument);
    EXPECT_THROW(forecast(kLaptop, {Watts(1.0), Watts(watts)}, BatteryModel::constant),
                 std::invalid_argument);
  }
  Battery broken = kLaptop;
  broken.soc = nan;
  EXPECT_THROW(forecast(broken, {Watts(1.0), {}}, BatteryModel::constant), std::invalid_argument);
}

TEST(Runtime, LoadsBelowTheRatedCurrentAreRemarkedOn) {
  const auto note = [](double watts, BatteryModel model) {
    return forecast(kLaptop, {Watts(watts), {}}, model).note;
  };
  EXPECT_NE(note(5.0, BatteryModel::peukert).find("below the rated"), std::string::npos);
  EXPECT_NE(note(5.0, BatteryModel::kinetic).find("below the rated"), std::string::npos);
  EXPECT_TRUE(note(5.0, BatteryModel::thevenin).empty());
  EXPECT_TRUE(note(30.0, BatteryModel::peukert).empty());
}

TEST(Runtime, FramesAreDeliveredEnergyOverThatOfAFrame) {
  const BatteryLoad load{Watts(30.0), Watts(3.0)};
  const BatteryForecast f = forecast(kLaptop, load, BatteryModel::constant);
  const Remaining frames = *frames_left(f, load, Joules(2.0));
  EXPECT_DOUBLE_EQ(frames.value, 53.0 * 3600.0 / 2.0);
  // 15 frames a second whatever the load's error.
  EXPECT_DOUBLE_EQ(*frames.low, 15.0 * f.earliest->value);
  EXPECT_DOUBLE_EQ(*frames.high, 15.0 * f.latest->value);
  EXPECT_FALSE(frames_left(f, load, Joules(0.0)));
}

TEST(Runtime, ModelsAndReasonsHaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const BatteryModel model : kBatteryModels) {
    names.insert(to_string(model));
    EXPECT_EQ(parse_battery_model(to_string(model)), model);
  }
  EXPECT_EQ(names.size(), kBatteryModels.size());
  EXPECT_FALSE(parse_battery_model("all"));
  std::set<std::string_view> reasons;
  for (const EndReason reason :
       {EndReason::empty, EndReason::cut_off, EndReason::brown_out, EndReason::never}) {
    reasons.insert(to_string(reason));
  }
  EXPECT_EQ(reasons.size(), 4U);
}

}  // namespace
}  // namespace encore::energy
