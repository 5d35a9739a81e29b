// `encore battery` as a user meets it.
#include "app/battery_report.h"
#include "energy/session_csv.h"
#include "profile_json_check.h"
#include "run_program.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace encore::app {
namespace {

using test::contains;

ProgramResult battery(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "battery");
  return run_encore(arguments);
}

/// Text with one blank where there were several: what tables say, not how wide they are.
std::string squeezed(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c != ' ' || result.empty() || result.back() != ' ') result += c;
  }
  return result;
}

/// The machine that runs the tests may have a battery or none; this folder has the one stated.
std::string fixture(const std::string& name) {
  return std::string(ENCORE_FIXTURES) + "/sysfs/" + name;
}

energy::SummaryRow row(const std::string& test, std::optional<double> watts) {
  energy::SummaryRow row;
  row.configuration = {{"scene", "toys"}, {"test", test}, {"structure", "grid"}};
  row.operations = 10;
  row.seconds = energy::Seconds(1.0);
  row.mean = energy::Seconds(0.1);
  if (watts) {
    row.source = "simulated";
    row.watts = energy::Watts(*watts);
    row.watts_ci95 = energy::Watts(*watts / 10.0);
    row.joules = energy::Joules(*watts / 10.0);
    row.origin = energy::Origin::simulated;
  }
  return row;
}

void write_session(const std::filesystem::path& folder,
                   const std::vector<energy::SummaryRow>& rows) {
  energy::SessionInfo info;
  info.sensor = {energy::Origin::unavailable, "no sensor was found"};
  energy::SessionWriter writer(folder, info, {{"scene", "test", "structure"}, {}});
  for (const energy::SummaryRow& row : rows) writer.add(row);
  writer.finish(energy::SessionState::complete);
}

TEST(BatteryCommand, TellsMinutesByEveryModelAndWhereTheLoadComesFrom) {
  const ProgramResult result = battery({"--watts", "30", "--preset", "thesis-laptop"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "11.1 V, 4.8 Ah, 53 Wh, 3S2P")) << result.out;
  EXPECT_TRUE(contains(result.out, "given with --watts")) << result.out;
  EXPECT_TRUE(contains(squeezed(result.out), "constant 106.0")) << result.out;
  EXPECT_TRUE(contains(squeezed(result.out), "peukert 101.2")) << result.out;
  EXPECT_TRUE(contains(squeezed(result.out), "kinetic 90.7")) << result.out;
  EXPECT_TRUE(contains(squeezed(result.out), "thevenin 102.5")) << result.out;
  EXPECT_TRUE(contains(result.out, "cut-off")) << result.out;
}

TEST(BatteryCommand, AnIntervalOfTheLoadIsOneOfTheTimeAndFrames) {
  for (const char* watts : {"30±3", "30+-3", "30 +/- 3"}) {
    const ProgramResult result = battery(
        {"--watts", watts, "--preset", "thesis-laptop", "--joules", "2", "--model", "constant"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "30 W ± 3 W")) << result.out;
    EXPECT_TRUE(contains(result.out, "96.4 to 117.8")) << result.out;
    EXPECT_TRUE(contains(result.out, "95,400 frames (86,727 to 106,000)")) << result.out;
    EXPECT_FALSE(contains(result.out, "peukert")) << "one model was asked for";
  }
}

TEST(BatteryCommand, TheLoadsOfASessionAreItsRows) {
  const test::TemporaryFolder folder;
  write_session(folder.path(), {row("static", 20.0), row("build", 40.0), row("dynamic", {})});
  const ProgramResult result =
      battery({"--session", folder.path(), "--preset", "generic-3s", "--model", "constant"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "simulated")) << result.out;
  // 53.28 Wh / 20 W, and 2 J a frame; 53.28 Wh / 40 W.
  EXPECT_TRUE(contains(result.out, "159.8")) << result.out;
  EXPECT_TRUE(contains(result.out, "95,904 frames")) << result.out;
  EXPECT_TRUE(contains(result.out, "79.9")) << result.out;
  EXPECT_TRUE(contains(result.out, "47,952 builds")) << result.out;
  EXPECT_TRUE(contains(result.err, "1 of 3 rows have no watts")) << result.err;
}

TEST(BatteryCommand, ASessionWithoutWattsSaysWhyAndWhatToDo) {
  const test::TemporaryFolder folder;
  write_session(folder.path(), {row("static", {})});
  const ProgramResult result = battery({"--session", folder.path(), "--preset", "generic-3s"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(contains(result.err, "no row has watts (unavailable: no sensor was found)"))
      << result.err;
  EXPECT_TRUE(contains(result.err, "--watts")) << result.err;
  EXPECT_TRUE(result.out.empty());
  EXPECT_EQ(battery({"--session", "no/such/folder", "--preset", "generic-3s"}).exit_code, 3);
}

TEST(BatteryCommand, TheBatteryPresentIsRead) {
  const ProgramResult result = battery({"--watts", "10", "--sysfs-root", fixture("bat_power")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "Battery: BAT0 (present in this machine")) << result.out;
  EXPECT_TRUE(contains(result.out, "51.32 Wh")) << "today's full charge: " << result.out;
  EXPECT_TRUE(contains(result.out, "charged to 60 %")) << result.out;
  EXPECT_TRUE(contains(squeezed(result.out), "constant 184.7"))
      << "30.79 Wh / 10 W: " << result.out;
  EXPECT_TRUE(result.err.empty()) << result.err;
  const ProgramResult plugged =
      battery({"--watts", "10", "--sysfs-root", fixture("bat_ac_online")});
  EXPECT_EQ(plugged.exit_code, 0);
  EXPECT_TRUE(contains(plugged.err, "BAT0 is being charged")) << plugged.err;
}

TEST(BatteryCommand, AFileDescribesTheBattery) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.write(
      "laptop.toml", "[battery]\nname = \"mine\"\nnominal_v = 10.0\ncapacity_wh = 60\nsoc = 0.5\n");
  const ProgramResult result = battery({"--watts", "30", "--battery", file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "Battery: mine (" + file.string() + ")")) << result.out;
  EXPECT_TRUE(contains(result.out, "60.0")) << result.out;
  const std::filesystem::path wrong =
      folder.write("wrong.toml", "[battery]\nnominal_v = 10.0\ncapacity_w = 60\n");
  const ProgramResult refused = battery({"--watts", "30", "--battery", wrong});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_TRUE(contains(refused.err, "wrong.toml:3:1: unknown key 'capacity_w'")) << refused.err;
}

TEST(BatteryCommand, WrongUsageExitsWithTwoAndSaysWhat) {
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const Case cases[] = {
      {{}, "battery: what is the load?"},
      {{"--watts", "much", "--preset", "generic-3s"}, "'much' is not a load"},
      {{"--watts", "-3", "--preset", "generic-3s"}, "-3"},
      {{"--watts", "nan", "--preset", "generic-3s"}, "'nan' is not a load"},
      {{"--watts", "30±", "--preset", "generic-3s"}, "'30±' is not a load"},
      {{"--watts", "30", "--preset", "generic3s"}, "did you mean 'generic-3s'"},
      {{"--watts", "30", "--model", "kinetik"}, "did you mean 'kinetic'"},
      {{"--watts", "30", "--sysfs-root", fixture("powercap_empty")}, "--preset NAME"},
      {{"--joules", "3", "--preset", "generic-3s"}, "--watts"},
      {{"--watts", "30", "--session", "x"}, "--session"},
      {{"--watts", "30", "--battery", "x", "--preset", "generic-3s"}, "--preset"},
  };
  for (const Case& c : cases) {
    const ProgramResult result = battery(c.arguments);
    EXPECT_EQ(result.exit_code, 2) << c.says << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, c.says)) << result.err;
    EXPECT_TRUE(result.out.empty()) << result.out;
  }
}

TEST(BatteryCommand, JsonIsWholeAndWithoutNumbersWhereThereAreNone) {
  const ProgramResult result =
      battery({"--watts", "30+-40", "--joules", "2", "--preset", "thesis-laptop", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(JsonChecker(result.out).valid()) << result.out;
  EXPECT_TRUE(contains(result.out, "\"minutes_left\": 106")) << result.out;
  EXPECT_TRUE(contains(result.out, "\"minutes_high\": null")) << result.out;
  EXPECT_TRUE(contains(result.out, "\"ends_by\": \"cut-off\"")) << result.out;
  const ProgramResult idle = battery({"--watts", "0", "--preset", "thesis-laptop", "--json"});
  EXPECT_TRUE(JsonChecker(idle.out).valid()) << idle.out;
  EXPECT_TRUE(contains(idle.out, "\"minutes_left\": null")) << idle.out;
  EXPECT_TRUE(contains(idle.out, "\"ends_by\": \"never\"")) << idle.out;
}

TEST(BatteryReport, StepTablesNameWhatIsUnstableOrLeftOut) {
  std::vector<energy::StepTable> tables{{"a scheme", "of something", {}}};
  energy::StepRow good;
  good.step = energy::Seconds(1e-3);
  good.steps = 36'000'000;
  good.error = 1.5e-10;
  energy::StepRow bad;
  bad.step = energy::Seconds(600.0);
  bad.stable = false;
  energy::StepRow skipped;
  skipped.step = energy::Seconds(36000.0);
  skipped.left_out = true;
  tables[0].rows = {good, bad, skipped};
  const std::string text = step_text(tables);
  EXPECT_TRUE(contains(squeezed(text), "1 ms 36,000,000 1.50e-10")) << text;
  EXPECT_TRUE(contains(text, "10 min")) << text;
  EXPECT_TRUE(contains(text, "beyond numbers")) << text;
  EXPECT_TRUE(contains(text, "unstable")) << text;
  EXPECT_TRUE(contains(text, "10 h")) << text;
  EXPECT_TRUE(contains(text, "left out")) << text;
  EXPECT_TRUE(JsonChecker("{" + step_json(tables) + "}").valid()) << step_json(tables);
}

}  // namespace
}  // namespace encore::app
