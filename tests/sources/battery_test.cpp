#include "energy/sources/battery.h"

#include "tests/sources/fixture_tree.h"
#include "tests/sources/supply_tree.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cmath>

namespace encore::energy {
namespace {

Finding only_finding(const SensorRoot& root) {
  std::vector<Finding> findings = find_batteries(root);
  EXPECT_EQ(findings.size(), 1U);
  return findings.at(0);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The power of the first reading; a failure's message goes to the test's output.
double first_watts(const SensorRoot& root) {
  const ReadResult result = only_finding(root).open()->read(Seconds(100));
  EXPECT_EQ(result.state, ReadState::ok) << result.message;
  return result.reading.power.value_or(Watts(-1)).value;
}

TEST(Battery, IsOneGaugeOfTheWholeSystem) {
  const Finding finding = only_finding(fixture_root("bat_power"));
  EXPECT_FALSE(finding.obstacle);
  EXPECT_EQ(finding.info.name, "battery:BAT0");
  EXPECT_EQ(finding.info.kind, SourceKind::battery);
  EXPECT_EQ(finding.info.domain, Domain::system);
  EXPECT_FALSE(finding.info.is_counter);
  EXPECT_EQ(finding.info.provenance.origin, Origin::measured);
  EXPECT_EQ(finding.info.poll_period, Seconds(0.3));
  EXPECT_FALSE(finding.info.includes.empty());
}

TEST(Battery, KnowsTheUnitsOfEachFile) {
  EXPECT_DOUBLE_EQ(first_watts(fixture_root("bat_power")), 9.48);
  EXPECT_DOUBLE_EQ(first_watts(fixture_root("bat_current")), 0.386 * 12.233)
      << "microamperes, volts";
  EXPECT_NEAR(first_watts(fixture_root("bat_current")), 4.721938, 1e-9);
}

TEST(Battery, TakesTheSizeWhateverTheSign) {
  SupplyTree tree;
  tree.set_laptop();
  tree.set("BAT0", {{"power_now", "-4721000"}});
  EXPECT_DOUBLE_EQ(first_watts(tree.root()), 4.721);
}

TEST(Battery, AddsThePacksThatDischarge) {
  EXPECT_EQ(only_finding(fixture_root("bat_dual")).info.name, "battery:BAT0+BAT1");
  EXPECT_DOUBLE_EQ(first_watts(fixture_root("bat_dual")), 12.5);
}

TEST(Battery, AnIdlePackDoesNotVoidTheOther) {
  SupplyTree tree;
  tree.set_laptop();
  tree.set("BAT1", {{"type", "Battery"}, {"status", "Not charging"}, {"power_now", "0"}});
  EXPECT_DOUBLE_EQ(first_watts(tree.root()), 10.0);
}

TEST(Battery, ASumWithoutOneOfItsPacksIsNoSum) {
  SupplyTree tree;
  tree.set_laptop();
  tree.set("BAT1", {{"type", "Battery"}, {"status", "Discharging"}, {"power_now", "0"}});
  const ReadResult result = only_finding(tree.root()).open()->read(Seconds(1));
  EXPECT_EQ(result.state, ReadState::failed);
  EXPECT_TRUE(contains(result.message, "BAT1")) << result.message;
}

TEST(Battery, AMousesBatteryIsNotTheMachines) {
  EXPECT_EQ(only_finding(fixture_root("bat_mouse_scope")).info.name, "battery:BAT0");
  SupplyTree tree;
  tree.set("hidpp_battery_0",
           {{"type", "Battery"}, {"scope", "Device"}, {"status", "Discharging"}});
  tree.set("ups", {{"type", "UPS"}, {"status", "Discharging"}});
  tree.set("BAT1", {{"type", "Battery"}, {"present", "0"}});
  const Finding finding = only_finding(tree.root());
  ASSERT_TRUE(finding.obstacle);
  EXPECT_TRUE(contains(finding.obstacle->reason, "hidpp_battery_0")) << finding.obstacle->reason;
  EXPECT_TRUE(contains(finding.obstacle->reason, "BAT1 is not in its place"));
  EXPECT_EQ(finding.info.provenance.origin, Origin::unavailable);
}

TEST(Battery, AMachineWithoutOneSaysSo) {
  const SupplyTree tree;
  const Finding finding = only_finding(tree.root());
  ASSERT_TRUE(finding.obstacle);
  EXPECT_TRUE(contains(finding.obstacle->reason, "no battery of this machine below /sys/class"));
}

TEST(Battery, OnMainsThereIsNoReading) {
  const Finding finding = only_finding(fixture_root("bat_ac_online"));
  ASSERT_TRUE(finding.obstacle);
  EXPECT_TRUE(contains(finding.obstacle->reason, "on mains (AC is online, BAT0 is Charging)"))
      << finding.obstacle->reason;
  EXPECT_TRUE(contains(finding.obstacle->fix, "unplug"));
  EXPECT_FALSE(finding.open);

  SupplyTree weak_charger;
  weak_charger.set_laptop();
  weak_charger.set("ucsi-source-psy-1", {{"type", "USB"}, {"online", "1"}});
  EXPECT_TRUE(only_finding(weak_charger.root()).obstacle)
      << "beside a charger the battery gives only a part";
}

TEST(Battery, AnUnknownRateIsNoRate) {
  const Finding finding = only_finding(fixture_root("bat_rate_unknown"));
  EXPECT_FALSE(finding.obstacle) << "the energy left still falls";
  const ReadResult result = finding.open()->read(Seconds(1));
  EXPECT_EQ(result.state, ReadState::failed);
  EXPECT_TRUE(contains(result.message, "has not fallen twice yet")) << result.message;

  SupplyTree tree;
  tree.set("BAT0", {{"type", "Battery"}, {"status", "Discharging"}, {"power_now", "-1000"}});
  const Finding hopeless = only_finding(tree.root());
  ASSERT_TRUE(hopeless.obstacle);
  EXPECT_TRUE(contains(hopeless.obstacle->reason, "neither")) << hopeless.obstacle->reason;
}

TEST(Battery, ZeroWhileDischargingIsNoData) {
  const ReadResult result = only_finding(fixture_root("bat_zero_rate")).open()->read(Seconds(1));
  EXPECT_EQ(result.state, ReadState::failed);
  EXPECT_FALSE(result.message.empty());

  SupplyTree tree;
  tree.set_laptop();
  const auto source = only_finding(tree.root()).open();
  source->read(Seconds(0));
  source->read(Seconds(1));
  tree.set("BAT0", {{"power_now", "0"}});
  EXPECT_EQ(source->read(Seconds(2)).state, ReadState::failed);
  tree.set("BAT0", {{"power_now", "20000000"}});
  const ReadResult back = source->read(Seconds(3));
  EXPECT_EQ(back.state, ReadState::restarted);
  EXPECT_EQ(back.reading.energy, Joules(10)) << "two seconds are a gap";
}

TEST(Battery, IntegratesByTrapezoidsAndMarksChanges) {
  SupplyTree tree;
  tree.set_laptop();
  const auto source = only_finding(tree.root()).open();
  EXPECT_TRUE(source->read(Seconds(0)).reading.changed);
  tree.set("BAT0", {{"voltage_now", "11990000"}});
  EXPECT_FALSE(source->read(Seconds(1)).reading.changed) << "the power stayed";
  tree.set("BAT0", {{"power_now", "20000000"}});
  const ReadResult result = source->read(Seconds(3));
  EXPECT_TRUE(result.reading.changed);
  EXPECT_EQ(result.reading.energy, Joules(10 + 30));
}

TEST(Battery, PluggingInEndsTheRun) {
  SupplyTree tree;
  tree.set_laptop();
  const auto source = only_finding(tree.root()).open();
  EXPECT_EQ(source->read(Seconds(0)).state, ReadState::ok);
  tree.set("AC", {{"online", "1"}});
  const ReadResult lost = source->read(Seconds(1));
  EXPECT_EQ(lost.state, ReadState::lost);
  EXPECT_TRUE(contains(lost.message, "AC was plugged in")) << lost.message;
}

TEST(Battery, AChargerThatAppearsWhileRunningEndsTheRun) {
  SupplyTree tree;
  tree.set_laptop();
  const auto source = only_finding(tree.root()).open();
  EXPECT_EQ(source->read(Seconds(0)).state, ReadState::ok);
  tree.set("ucsi-source-psy-1", {{"type", "USB"}, {"online", "1"}});
  EXPECT_EQ(source->read(Seconds(1)).state, ReadState::lost);

  SupplyTree silent;
  silent.set_laptop();
  silent.remove("AC");
  const auto other = only_finding(silent.root()).open();
  EXPECT_EQ(other->read(Seconds(0)).state, ReadState::ok);
  silent.set("BAT0", {{"status", "Unknown"}});
  EXPECT_EQ(other->read(Seconds(1)).state, ReadState::failed) << "may be discharging again soon";
  silent.set("BAT0", {{"status", "Charging"}});
  EXPECT_EQ(other->read(Seconds(2)).state, ReadState::lost) << "even where no charger is listed";
}

TEST(Battery, APackThatIsTakenOutEndsTheRun) {
  SupplyTree tree;
  tree.set_laptop();
  const Finding finding = only_finding(tree.root());
  const auto source = finding.open();
  EXPECT_EQ(source->read(Seconds(0)).state, ReadState::ok);
  tree.remove("BAT0");
  EXPECT_EQ(source->read(Seconds(1)).state, ReadState::lost);
  EXPECT_THROW(finding.open(), SensorError);
}

/// Reads every 0.25 s while the pack gives 9 W and says what is left in steps of 36 "units" each
/// 4 s; returns the power at the end.
double watts_by_slope(SupplyTree& tree, const char* key, double per_step) {
  const auto source = find_batteries(tree.root()).at(0).open();
  ReadResult result;
  for (int i = 0; i <= 80; ++i) {
    const double left = 50e6 - per_step * (i / 16);
    tree.set("BAT0", {{key, std::to_string(static_cast<long long>(left))}});
    result = source->read(Seconds(i * 0.25));
    if (i < 32) {
      EXPECT_EQ(result.state, ReadState::failed) << i;
    }
  }
  EXPECT_EQ(result.state, ReadState::ok) << result.message;
  return result.reading.power.value_or(Watts(-1)).value;
}

TEST(Battery, FallsBackToTheSlopeOfTheEnergyLeft) {
  SupplyTree tree;
  tree.set_laptop();
  tree.set("BAT0", {{"power_now", "-1000"}});
  EXPECT_NEAR(watts_by_slope(tree, "energy_now", 10000), 9.0, 1e-9) << "10 mWh in 4 s";
}

TEST(Battery, FallsBackToTheSlopeOfTheChargeLeft) {
  SupplyTree tree;
  tree.set("BAT0", {{"type", "Battery"},
                    {"status", "Discharging"},
                    {"voltage_now", "12000000"},
                    {"charge_now", "50000000"}});
  EXPECT_NEAR(watts_by_slope(tree, "charge_now", 1000), 0.9 * 12.0, 1e-9) << "1 mAh in 4 s";
}

TEST(Battery, AnOldSlopeIsNotBelieved) {
  SupplyTree tree;
  tree.set_laptop();
  tree.set("BAT0", {{"power_now", "-1000"}});
  const auto source = only_finding(tree.root()).open();
  const auto read = [&](double time, const char* left) {
    tree.set("BAT0", {{"energy_now", left}});
    return source->read(Seconds(time));
  };
  read(0, "50000000");
  read(4, "49990000");
  EXPECT_EQ(read(8, "49980000").reading.power, Watts(9));
  EXPECT_EQ(read(20, "49980000").state, ReadState::ok);
  EXPECT_EQ(read(21, "49980000").state, ReadState::failed) << "three steps should have come";
  EXPECT_EQ(read(22, "49990000").state, ReadState::failed) << "a rise is a gauge that learns";
  EXPECT_EQ(read(26, "49980000").state, ReadState::failed) << "and starts the slope anew";
}

TEST(Battery, AsksTheFilesWhereTheUeventFails) {
  const SensorRoot root = fixture_root("bat_power");
  const SensorFiles files(root, [root](std::string_view path) -> FileText {
    if (path.ends_with("BAT0/uevent")) return {std::nullopt, EIO};
    return root.read(path);
  });
  const ReadResult result = find_batteries(files).at(0).open()->read(Seconds(0));
  EXPECT_EQ(result.state, ReadState::ok) << result.message;
  EXPECT_EQ(result.reading.power, Watts(9.48));

  const SensorFiles no_rate(root, [root](std::string_view path) -> FileText {
    if (path.ends_with("BAT0/uevent")) return {std::nullopt, EIO};
    if (path.ends_with("power_now")) return {std::nullopt, ENODEV};
    return root.read(path);
  });
  EXPECT_EQ(find_batteries(no_rate).at(0).open()->read(Seconds(0)).state, ReadState::failed);
}

TEST(BatteryCheck, ComparesTheGaugeWithTheEnergyLeft) {
  SupplyTree tree;
  tree.set_laptop();
  BatterySource source(only_finding(tree.root()).info, {"BAT0"}, SensorFiles(tree.root()));
  EXPECT_FALSE(source.check());
  const auto run = [&](int from, int to) {
    for (int i = from; i <= to; ++i) {
      // 10 W for i seconds, in whole steps of 10 mWh.
      const long long left = 50'000'000 - static_cast<long long>(i * 10 / 36) * 10'000;
      tree.set("BAT0", {{"energy_now", std::to_string(left)}, {"power_now", "10000000"}});
      source.read(Seconds(i));
    }
  };
  run(0, 100);
  auto check = source.check();
  ASSERT_TRUE(check);
  EXPECT_DOUBLE_EQ(check->integral.value, 1000.0);
  EXPECT_NEAR(check->drawn.value, 27 * 36.0, 1e-6);
  EXPECT_NEAR(check->step.value, 36.0, 1e-6);
  EXPECT_NEAR(check->uncertainty.value, 36.0 / std::sqrt(6.0), 1e-6);
  EXPECT_TRUE(check->agrees(0.0));

  // A gap is left out of both, and its edges are two roundings more.
  tree.set("BAT0", {{"status", "Unknown"}});
  EXPECT_EQ(source.read(Seconds(101)).state, ReadState::failed);
  tree.set("BAT0", {{"status", "Discharging"}});
  run(201, 300);
  check = source.check();
  ASSERT_TRUE(check);
  EXPECT_DOUBLE_EQ(check->integral.value, 1990.0);
  EXPECT_NEAR(check->difference().value, 0.0, 3 * 36.0);
  EXPECT_NEAR(check->uncertainty.value, 36.0 / std::sqrt(3.0), 1e-6);
}

TEST(BatteryCheck, SeesAGaugeThatLies) {
  SupplyTree tree;
  tree.set_laptop();
  BatterySource source(only_finding(tree.root()).info, {"BAT0"}, SensorFiles(tree.root()));
  for (int i = 0; i <= 100; ++i) {
    // What is left falls by 20 W although the gauge says 10 W.
    const long long left = 50'000'000 - static_cast<long long>(i * 20 / 36) * 10'000;
    tree.set("BAT0", {{"energy_now", std::to_string(left)}});
    source.read(Seconds(i));
  }
  const auto check = source.check();
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->agrees());
}

TEST(BatteryState, KnowsWhatThePackHolds) {
  const auto state = read_battery_state(fixture_root("bat_power"));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->name, "BAT0");
  EXPECT_EQ(state->status, "Discharging");
  EXPECT_DOUBLE_EQ(state->now.value_or(Joules(0)).value, 30.79 * 3600);
  EXPECT_DOUBLE_EQ(state->full.value_or(Joules(0)).value, 51.32 * 3600);
  EXPECT_DOUBLE_EQ(state->design.value_or(Joules(0)).value, 57.02 * 3600);
  EXPECT_DOUBLE_EQ(state->voltage.value_or(0), 11.85);
  EXPECT_DOUBLE_EQ(state->design_voltage.value_or(0), 11.4);
  EXPECT_EQ(state->power, Watts(9.48));
  EXPECT_EQ(state->on_mains, false);
  EXPECT_NEAR(state->charge().value_or(0), 0.59996, 1e-4);
  EXPECT_NEAR(state->health().value_or(0), 0.90004, 1e-4);
}

TEST(BatteryState, TurnsChargeIntoEnergyAtTheDesignVoltage) {
  const auto state = read_battery_state(fixture_root("bat_current"));
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->full.value_or(Joules(0)).value, 4.8 * 11.4 * 3600, 1e-6);
  EXPECT_NEAR(state->charge().value_or(0), 0.65, 1e-9);
}

TEST(BatteryState, AddsPacksAndKeepsUnknownsUnknown) {
  const auto state = read_battery_state(fixture_root("bat_dual"));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->name, "BAT0+BAT1");
  EXPECT_DOUBLE_EQ(state->full.value_or(Joules(0)).value, (51.32 + 21.0) * 3600);
  EXPECT_EQ(state->power, Watts(12.5));

  const auto charging = read_battery_state(fixture_root("bat_ac_online"));
  ASSERT_TRUE(charging);
  EXPECT_EQ(charging->on_mains, true);
  EXPECT_FALSE(charging->power);

  SupplyTree tree;
  tree.set_laptop();
  tree.set("BAT1", {{"type", "Battery"}, {"status", "Full"}});
  const auto half = read_battery_state(tree.root());
  ASSERT_TRUE(half);
  EXPECT_FALSE(half->full) << "BAT1 does not say";
  EXPECT_FALSE(read_battery_state(fixture_root("hwmon_ina226")));
}

}  // namespace
}  // namespace encore::energy
