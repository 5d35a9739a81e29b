#include "app/profile_report.h"

#include "app/profile_table.h"
#include "app/workloads.h"
#include "tests/app/profile_json_check.h"

#include <gtest/gtest.h>

#include <sstream>

namespace encore::app {
namespace {

using energy::Phase;

energy::SummaryRow row_of(const std::string& test) {
  energy::FrameRow frame;
  for (const std::string& column : configuration_columns()) {
    frame.configuration.push_back({column, column == "test" ? test : "7"});
  }
  frame.configuration[1].value = "a \"quoted\" scene";
  frame.operations = 2;
  const Phase phase = test == "build" ? Phase::build : Phase::render;
  frame.phases[phase] = energy::Seconds(0.012);
  energy::PerPhase<std::uint64_t> counts{};
  counts[phase] = 2;
  energy::SummaryRow row = energy::summarise({frame}, counts);
  for (const std::string& column : counter_columns()) row.counters.push_back({column, {}});
  row.counters[0].value = 2551;
  return row;
}

ProfileReport report_of(std::vector<energy::SummaryRow> rows) {
  ProfileReport report;
  report.folder = "/some/folder";
  report.sensor = {energy::Origin::unavailable, "no source"};
  report.rows = std::move(rows);
  return report;
}

TEST(ProfileReport, UncertaintyDecidesHowManyDigitsAreShown) {
  EXPECT_EQ(with_uncertainty(12.34567, 0.0123), "12.346 ± 0.012");
  EXPECT_EQ(with_uncertainty(1234.567, 25.4), "1235 ± 25");
  EXPECT_EQ(with_uncertainty(0.00123456, 0.0000012), "0.0012346 ± 0.0000012");
  EXPECT_EQ(with_uncertainty(12.34567, std::nullopt), "12.35 ± ?");
}

TEST(ProfileReport, SaysFirstWhereEnergyAndSessionAre) {
  std::istringstream lines(report_text(report_of({row_of("build")})));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "Energy: unavailable (no source)");
  std::getline(lines, line);
  EXPECT_EQ(line, "Session: /some/folder");
}

TEST(ProfileReport, ShowsATableOnlyForTestsThatWereRun) {
  const std::string builds = report_text(report_of({row_of("build")}));
  EXPECT_NE(builds.find("\nBuilds\n"), std::string::npos);
  EXPECT_EQ(builds.find("\nFrames\n"), std::string::npos);
  const std::string frames = report_text(report_of({row_of("static")}));
  EXPECT_EQ(frames.find("\nBuilds\n"), std::string::npos);
  EXPECT_NE(frames.find("\nFrames\n"), std::string::npos);
  EXPECT_NE(report_text(report_of({})).find("Nothing was measured."), std::string::npos);
}

TEST(ProfileReport, ColumnsWithoutContentAreLeftOut) {
  const std::string text = report_text(report_of({row_of("static")}));
  EXPECT_EQ(text.find("animate"), std::string::npos);
  EXPECT_EQ(text.find("transfer"), std::string::npos);
  EXPECT_NE(text.find("render"), std::string::npos);
}

TEST(ProfileReport, JsonIsJsonWithNullForWhatDoesNotApply) {
  for (const auto& rows :
       {std::vector<energy::SummaryRow>{}, std::vector{row_of("build"), row_of("dynamic")}}) {
    const std::string json = report_json(report_of(rows));
    EXPECT_TRUE(JsonChecker(json).valid()) << json;
  }
  const std::string json = report_json(report_of({row_of("build")}));
  EXPECT_NE(json.find(R"("scene": "a \"quoted\" scene")"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("device": "7")"), std::string::npos) << "text stays text";
  EXPECT_NE(json.find(R"("triangles": 7)"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("nodes": 2551)"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("grid_x": null)"), std::string::npos) << json;
  EXPECT_NE(json.find(R"("watts": "unavailable")"), std::string::npos) << json;
}

TEST(TextTable, AlignsByCharactersNotBytes) {
  TextTable table;
  table.add_column("name", TextTable::Align::left);
  table.add_column("value");
  table.add_row({"ö ± ü", "1"});
  table.add_row({"plain", "22"});
  EXPECT_EQ(table.text(), "name   value\nö ± ü      1\nplain     22\n");
}

TEST(JsonChecker, TellsJsonFromWhatIsNot) {
  for (const char* good : {"{}", "[1, -2.5e+3, null]", R"({"a": {"b": ["c\"", true]}})"}) {
    EXPECT_TRUE(JsonChecker(good).valid()) << good;
  }
  for (const char* bad : {"", "{", "[1,]", "{\"a\" 1}", "nul", "[1] 2", "\"a\nb\"", "1.", "nan"}) {
    EXPECT_FALSE(JsonChecker(bad).valid()) << bad;
  }
}

}  // namespace
}  // namespace encore::app
