#include "energy/battery_life/battery_toml.h"

#include "energy/battery_life/runtime.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cmath>

namespace encore::energy {
namespace {

Battery parse(std::string_view text) {
  return parse_battery_toml(text, "b.toml");
}

std::string error_of(std::string_view text) {
  try {
    parse(text);
  } catch (const BatteryError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error for\n" << text;
  return {};
}

constexpr std::string_view kWhole = R"([battery]
name = "two cells"
capacity_ah = 2.0
capacity_wh = 14.6
nominal_v = 7.4
cutoff_v = 6.2
soc = 0.8
series = 2
parallel = 1
peukert_exponent = 1.08
rated_hours = 10
kinetic_c = 0.5
kinetic_rate_per_s = 1e-3
kinetic_capacity_ah = 2.2
[battery.cell]
r0_ohm = 0.05
rc = [{ ohm = 0.02, farad = 1000 }, { ohm = 0.01, farad = 0.5 }]
ocv = [[0, 3.0], [0.5, 3.7], [1, 4.2]]
)";

TEST(BatteryToml, ReadsEveryKey) {
  const Battery b = parse(kWhole);
  EXPECT_EQ(b.name, "two cells");
  EXPECT_EQ(b.source, "b.toml");
  EXPECT_EQ(b.coulombs, 7200.0);
  EXPECT_EQ(b.full.value, 14.6 * 3600.0);
  EXPECT_EQ(b.nominal_volts, 7.4);
  EXPECT_EQ(b.cutoff_volts, 6.2);
  EXPECT_EQ(b.soc, 0.8);
  EXPECT_EQ(b.series, 2);
  EXPECT_EQ(b.parallel, 1);
  EXPECT_EQ(b.peukert, (PeukertParameters{1.08, 10.0}));
  EXPECT_EQ(b.kinetic, (KineticParameters{0.5, 1e-3, 2.2 * 3600.0}));
  EXPECT_EQ(b.cell.r0_ohms, 0.05);
  EXPECT_EQ(b.cell.branches, (std::vector<RcBranch>{{0.02, 1000.0}, {0.01, 0.5}}));
  EXPECT_EQ(b.cell.ocv, (std::vector<OcvPoint>{{0.0, 3.0}, {0.5, 3.7}, {1.0, 4.2}}));
}

TEST(BatteryToml, ALabelIsEnough) {
  const Battery b = parse("[battery]\nnominal_v = 14.8\ncapacity_wh = 71.04\n");
  EXPECT_EQ(b.series, 4);
  EXPECT_EQ(b.parallel, 2);
  EXPECT_DOUBLE_EQ(b.coulombs, 4.8 * 3600.0);
  EXPECT_EQ(b.cutoff_volts, 12.0);
  EXPECT_EQ(b.cell, generic_cell());
  EXPECT_EQ(battery_fault(b), "");
}

TEST(BatteryToml, APresetIsOverriddenKeyByKey) {
  const Battery b = parse("[battery]\npreset = \"thesis-laptop\"\nsoc = 0.4\n");
  Battery expected = *battery_preset("thesis-laptop");
  expected.soc = 0.4;
  expected.source = b.source;
  EXPECT_EQ(b, expected);
  const Battery worn = parse("[battery]\npreset = \"thesis-laptop\"\ncapacity_ah = 4.0\n");
  EXPECT_DOUBLE_EQ(worn.full.value, 4.0 * 3600.0 * 11.1) << "the energy follows the charge";
}

TEST(BatteryToml, TwoDischargesGiveThePeukertExponent) {
  const std::string base = "[battery]\npreset = \"generic-3s\"\n";
  const Battery b =
      parse(base + "peukert_runs = [{amperes = 1.0, minutes = 280}, {amperes = 4, minutes = 64}]");
  EXPECT_NEAR(b.peukert.exponent, std::log(280.0 / 64.0) / std::log(4.0), 1e-14);
}

TEST(BatteryToml, OtherTablesOfTheFileAreNotLookedAt) {
  const Battery b =
      parse("[camera]\nfov = 3\n[battery]\npreset = \"generic-3s\"\n[[model]]\nx = 1\n");
  EXPECT_EQ(b.name, "generic-3s");
}

TEST(BatteryToml, EveryErrorNamesItsPlace) {
  struct Case {
    std::string_view text;
    std::string_view says;
  };
  const Case cases[] = {
      {"[battery\n", "b.toml:1:"},
      {"[batery]\n", "b.toml: there is no table [battery]"},
      {"battery = 3\n", "b.toml:1:11: [battery] must be a table"},
      {"[battery]\npreset = \"thesis-laptp\"\n", "b.toml:2:10: there is no preset 'thesis-laptp'"},
      {"[battery]\npreset = \"thesis-laptp\"\n", "did you mean 'thesis-laptop'?"},
      {"[battery]\nnominal_v = 11.1\n", "b.toml:1:1: a battery needs 'nominal_v' and"},
      {"[battery]\nnominal_v = \"11\"\n", "b.toml:2:13: 'nominal_v' must be a number"},
      {"[battery]\nnominal_v = 0\n", "b.toml:2:13: 'nominal_v' must be above 0, not 0"},
      {"[battery]\nnominal_v = nan\n", "b.toml:2:13: 'nominal_v' must be above 0"},
      {"[battery]\nnominal_v = inf\n", "b.toml:2:13: 'nominal_v' must be above 0"},
      {"[battery]\nseries = 2.5\nnominal_v = 7\ncapacity_ah = 1\n",
       "b.toml:2:10: 'series' must be a whole number"},
      {"[battery]\nseries = 0\nnominal_v = 7\ncapacity_ah = 1\n",
       "b.toml:2:10: 'series' must be at least 1"},
      {"[battery]\nname = 3\nnominal_v = 7\ncapacity_ah = 1\n", "'name' must be a string"},
      {"[battery]\npreset = \"generic-3s\"\nsoc = 1.5\n",
       "b.toml:3:7: 'soc' must be at least 0 and at most 1, not 1.5"},
      {"[battery]\npreset = \"generic-3s\"\npeukert_exponent = 0.9\n", "b.toml:3:20:"},
      {"[battery]\npreset = \"generic-3s\"\ncapacity = 3\n",
       "b.toml:3:1: unknown key 'capacity' in [battery]"},
      {"[battery]\npreset = \"generic-3s\"\ncapacity_aH = 3\n", "did you mean 'capacity_ah'?"},
      {"[battery]\nnominal_v = 11.1\ncapacity_ah = 4.8\ncapacity_wh = 530\n",
       "b.toml:1:1: 530 Wh is not about 4.8 Ah at 11.1 V"},
      {"[battery]\npreset = \"generic-3s\"\ncutoff_v = 13\n", "cut-off of 13 V is not below"},
      {"[battery]\nnominal_v = 1e15\ncapacity_wh = 5e-324\n",
       "b.toml:1:1: 'capacity_wh' by 'nominal_v' is no charge"},
      {"[battery]\nnominal_v = 1e-300\ncapacity_wh = 1e15\n",
       "b.toml:1:1: 'capacity_wh' by 'nominal_v' is no charge"},
      {"[battery]\npreset = \"generic-3s\"\n[battery.cell]\nr0 = 1\n",
       "b.toml:4:1: unknown key 'r0' in [battery.cell]"},
      {"[battery]\npreset = \"generic-3s\"\n[battery.cell]\nrc = [{ohm = 1}]\n",
       "b.toml:4:7: an RC branch needs 'ohm' and 'farad'"},
      {"[battery]\npreset = \"generic-3s\"\n[battery.cell]\nrc = [3]\n", "b.toml:4:7:"},
      {"[battery]\npreset = \"generic-3s\"\n[battery.cell]\nocv = [[0, 3]]\n",
       "'ocv' needs two points or more"},
      {"[battery]\npreset = \"generic-3s\"\n[battery.cell]\nocv = [[0, 3], [1]]\n",
       "b.toml:4:16: an element of 'ocv' must be a pair"},
      {"[battery]\npreset = \"generic-3s\"\n[battery.cell]\nocv = [[0, 3], [0, 4]]\n",
       "b.toml:4:16: the 'ocv' table must rise"},
      {"[battery]\npreset = \"generic-3s\"\npeukert_runs = [{amperes = 1, minutes = 2}]\n",
       "'peukert_runs' needs two discharges"},
      {"[battery]\npreset = \"generic-3s\"\npeukert_runs = [{amperes = 1, minutes = 60}, "
       "{amperes = 1, minutes = 60}]\n",
       "needs two different currents"},
      {"[battery]\npreset = \"generic-3s\"\npeukert_runs = [{amperes = 1, minutes = 60}, "
       "{amperes = 2, minutes = 59}]\n",
       "imply an exponent of 0.02"},
      {"[battery]\npreset = \"generic-3s\"\npeukert_runs = [{ampere = 1, minutes = 60}, "
       "{amperes = 2, minutes = 59}]\n",
       "did you mean 'amperes'?"},
  };
  for (const Case& c : cases) {
    const std::string message = error_of(c.text);
    EXPECT_NE(message.find(c.says), std::string::npos)
        << c.text << "says " << message << "\nnot " << c.says;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(BatteryToml, DeepKeysAreRefusedBeforeTheParserSeesThem) {
  std::string deep = "a";
  for (int i = 0; i < 200000; ++i) deep += ".a";
  EXPECT_EQ(error_of("b = 1\n" + deep + " = 1\n"), "b.toml:2: a key of more than 16 parts");
}

TEST(BatteryToml, FilesThatCannotBeReadAreNamed) {
  const test::TemporaryFolder folder;
  for (const auto& path : {folder.path() / "none.toml", folder.path()}) {
    try {
      read_battery_toml(path);
      ADD_FAILURE() << path;
    } catch (const BatteryError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
  }
  EXPECT_EQ(read_battery_toml(folder.write("b.toml", kWhole)).name, "two cells");
}

TEST(BatteryPresets, AreWhole) {
  ASSERT_FALSE(battery_presets().empty());
  for (const std::string_view name : battery_presets()) {
    const Battery b = *battery_preset(name);
    EXPECT_EQ(battery_fault(b), "") << name;
    for (const BatteryModel model : kBatteryModels) {
      EXPECT_TRUE(forecast(b, {Watts(20.0), {}}, model).time) << name;
    }
  }
  EXPECT_FALSE(battery_preset("no such battery"));
  const Battery thesis = *battery_preset("thesis-laptop");
  EXPECT_EQ(thesis.nominal_volts, 11.1);
  EXPECT_EQ(thesis.coulombs, 4.8 * 3600.0);
  EXPECT_EQ(thesis.full.value, 53.0 * 3600.0);
}

}  // namespace
}  // namespace encore::energy
