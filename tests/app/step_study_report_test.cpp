// What `encore battery --steps` prints, writes and draws.
#include "app/log_plot_svg.h"
#include "app/time_constant_report.h"
#include "energy/csv.h"
#include "energy/session.h"
#include "scene/diagnostics.h"
#include "tests/support/fake_clock.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace encore::app {
namespace {

using test::contains;

std::size_t times_in(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

StepStudy small_study() {
  const energy::FakeClock clock;
  return {
      energy::study_steps(*energy::battery_preset("thesis-laptop"), energy::Watts(30), clock, 4000),
      energy::study_time_constants(clock, 1000)};
}

TEST(StepStudyReport, TextTellsWhatIsUnstableAndWhatCannotBeTold) {
  const std::string text = time_constant_text(small_study().time_constants);
  for (const char* word : {"explicit Euler", "thermal drift", "1 ms", "10 h", "1e+06 s", "!",
                           "short", "coarse", "unstable at this step"}) {
    EXPECT_TRUE(contains(text, word)) << word << '\n' << text;
  }
  EXPECT_FALSE(contains(text, "nan"));
}

TEST(StepStudyReport, CsvHoldsEveryCombination) {
  const test::TemporaryFolder folder;
  const StepStudy study = small_study();
  const auto file = folder.path() / "steps.csv";
  write_step_csv(file, study);
  const auto records = energy::parse_csv(test::contents_of(file));
  std::size_t rows = 1;
  for (const auto& table : study.battery) rows += table.rows.size();
  for (const auto& table : study.time_constants) rows += table.rows.size();
  ASSERT_EQ(records.size(), rows);
  for (const auto& record : records) EXPECT_EQ(record.size(), records[0].size());
  EXPECT_TRUE(std::any_of(records.begin(), records.end(), [](const auto& record) {
    return contains(record.back(), "too short");
  })) << "a time constant that is not known is empty, with its reason";
}

TEST(LogPlotSvg, EscapesTextAndLeavesOutWhatAnAxisCannotHold) {
  LogPlot plot{"a < b & \"c\"", "x (s)", "y", {}};
  plot.series.push_back({"one", {{1.0, 1e-3, "here"}, {10.0, 1.0, ""}, {0.0, 1.0, ""}}});
  plot.series.push_back({"two", {{2.0, NAN, ""}, {3.0, -1.0, ""}, {4.0, INFINITY, ""}}});
  const std::string svg = plots_svg({plot});
  EXPECT_TRUE(contains(svg, "a &lt; b &amp; &quot;c&quot;"));
  EXPECT_FALSE(contains(svg, "nan"));
  EXPECT_FALSE(contains(svg, "inf"));
  EXPECT_TRUE(contains(svg, ">here</text>"));
  EXPECT_TRUE(contains(svg, "10⁻³"));
  // The points of the first series and its mark in the legend; of the second, the legend's alone.
  EXPECT_EQ(times_in(svg, "<circle"), 3U);
  EXPECT_EQ(times_in(svg, "height=\"7\""), 1U);
}

TEST(LogPlotSvg, LimitsMovePointsToTheEdge) {
  LogPlot plot{"t", "x", "y", {{"s", {{1.0, 0.0, ""}, {2.0, INFINITY, ""}, {3.0, 1.0, ""}}}}};
  plot.least_y = 1e-6;
  plot.most_y = 100.0;
  EXPECT_EQ(times_in(plots_svg({plot}), "<circle"), 4U);
}

TEST(LogPlotSvg, EmptyAndSinglePointsAndLinearAxesAreDrawn) {
  EXPECT_TRUE(contains(plots_svg({{"t", "x", "y", {}}}), "no points"));
  EXPECT_TRUE(contains(plots_svg({}), "</svg>"));
  LogPlot plot{"t", "x", "y", {{"s", {{0.0, -5.0, ""}}}}, false, false};
  const std::string svg = plots_svg({plot});
  EXPECT_EQ(times_in(svg, "<circle"), 2U);
  EXPECT_FALSE(contains(svg, "nan"));
}

TEST(LogPlotSvg, AFileThatCannotBeWrittenIsNamed) {
  try {
    write_plots_svg("/nowhere/at/all.svg", {});
    FAIL() << "it was written";
  } catch (const scene::InputError& error) {
    EXPECT_TRUE(contains(error.what(), "/nowhere/at/all.svg: the plot cannot be written: No such"))
        << error.what();
  }
}

}  // namespace
}  // namespace encore::app
