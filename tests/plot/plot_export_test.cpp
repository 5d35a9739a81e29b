// What is copied from a plot is what it shows, with its units.
#include "ui/plot/plot_export.h"

#include "energy/csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace {

using namespace encore::ui;
using encore::energy::CsvRecord;
using encore::energy::Origin;
using encore::energy::parse_csv;
using encore::energy::parse_csv_number;

std::size_t column(const CsvRecord& header, const std::string& name) {
  const auto found = std::find(header.begin(), header.end(), name);
  EXPECT_NE(found, header.end()) << name;
  return static_cast<std::size_t>(found - header.begin());
}

TEST(PlotExport, StripHasARowABucket) {
  SampleHistory history;
  for (int i = 0; i < 100; ++i) history.add(i * 0.1, 30.0 + i % 5, i % 2 == 0);
  StripData data;
  StripSeries series;
  series.name = "RAPL, package \"0\"";
  series.history = &history;
  series.provenance = {Origin::measured, "x"};
  data.series = {series, series};
  data.series[1].name = "hidden";
  StripState state;
  state.hidden = {"hidden"};
  set_range(state.x, 2.0, 5.0);
  const auto rows = parse_csv(strip_csv(data, state, 1000));
  const auto shown = history.between(2.0, 5.0, 1000);
  ASSERT_EQ(rows.size(), shown.size() + 1);
  const CsvRecord& header = rows[0];
  std::uint64_t changed = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    ASSERT_EQ(rows[i + 1].size(), header.size());
    EXPECT_EQ(rows[i + 1][0], series.name);
    EXPECT_EQ(rows[i + 1][1], "measured");
    EXPECT_EQ(parse_csv_number(rows[i + 1][column(header, "from_s")]), shown[i].t0);
    EXPECT_EQ(parse_csv_number(rows[i + 1][column(header, "last_W")]), shown[i].last);
    EXPECT_EQ(parse_csv_number(rows[i + 1][column(header, "integral_J")]), shown[i].integral);
    changed += rows[i + 1][column(header, "changed")] == "1" ? 1 : 0;
  }
  EXPECT_EQ(changed, (shown.size() + 1) / 2);
}

TEST(PlotExport, SelectionHasARowASeries) {
  SampleHistory history;
  for (int i = 0; i <= 10; ++i) history.add(i, 20.0);
  StripData data;
  data.series.resize(2);
  data.series[0].name = "a";
  data.series[0].history = &history;
  data.series[1].name = "nothing";
  StripState state;
  EXPECT_EQ(parse_csv(selection_csv(data, state)).size(), 1U);
  state.selection = AxisRange{2.0, 7.0};
  const auto rows = parse_csv(selection_csv(data, state));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(parse_csv_number(rows[1][column(rows[0], "integral_J")]), 100.0);
  EXPECT_EQ(parse_csv_number(rows[1][column(rows[0], "median_W")]), 20.0);
  EXPECT_EQ(rows[1][column(rows[0], "approximate")], "false");
}

TEST(PlotExport, MissingIsEmpty) {
  BarData bars;
  bars.groups.push_back({"bvh, cpu", {{"energy", "J", false, {}, {}}}});
  bars.groups[0].bars[0].parts = {
      {"build", PlotColor::build, 2.5, 0.25, {Origin::modelled, "constants"}},
      {"render", PlotColor::render, {}, {}, {Origin::unavailable, "too short"}}};
  const auto rows = parse_csv(bars_csv(bars));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1], (CsvRecord{"bvh, cpu", "energy", "build", "2.5", "0.25", "J", "modelled",
                                "constants"}));
  EXPECT_EQ(rows[2],
            (CsvRecord{"bvh, cpu", "energy", "render", "", "", "J", "unavailable", "too short"}));
  ErrorData errors;
  errors.series.resize(1);
  errors.series[0].name = "watts";
  errors.series[0].points = {{0.5, {}}, {1.0, 0.02, 12.5}};
  errors.series[0].provenance = {Origin::simulated, ""};
  const auto points = parse_csv(errors_csv(errors));
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1][2], "");
  EXPECT_EQ(points[2][2], "0.02");
  EXPECT_EQ(points[1][3], "");
  EXPECT_EQ(points[2][3], "12.5");
  EXPECT_EQ(points[2][4], "simulated");
}

}  // namespace
