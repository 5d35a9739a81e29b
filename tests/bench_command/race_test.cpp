// How times are taken and what becomes of them.
#include "app/bench/race.h"

#include "app/bench/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>

namespace encore::app::bench {
namespace {

TEST(Race, EverybodyTakesTurnsRoundByRound) {
  std::string order;
  const std::vector<Runner> runners = {{"a", [&] { order += 'a'; }}, {"b", [&] { order += 'b'; }}};
  const RaceTimes times = race(runners, {.rounds = 3, .least_s = 0.0});
  EXPECT_EQ(order, "abababab");  // a round to warm up, and three
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].size(), 3U);
  EXPECT_EQ(times[1].size(), 3U);
}

TEST(Race, ShortRunsAreRepeatedUntilTheyAreLongEnough) {
  int runs = 0;
  race({{"quick", [&] { ++runs; }}}, {.rounds = 1, .least_s = 1e-3});
  EXPECT_GT(runs, 2);
}

TEST(Race, ARoundThatIsCancelledDoesNotCount) {
  std::atomic<bool> cancel{false};
  int runs = 0;
  const std::vector<Runner> runners = {{"a", [&] { cancel = ++runs == 3; }}, {"b", [] {}}};
  const RaceTimes times = race(runners, {.rounds = 5, .least_s = 0.0, .cancel = &cancel});
  EXPECT_EQ(runs, 3);  // to warm up, the first round, and the second, which is not ended
  EXPECT_EQ(times[0].size(), 1U);
  EXPECT_EQ(times[1].size(), 1U);
}

TEST(Race, NoFurtherRoundBeginsWhenTheBudgetIsSpent) {
  const RaceTimes times = race({{"a", [] {}}}, {.rounds = 50, .least_s = 0.0, .budget_s = 0.0});
  EXPECT_EQ(times[0].size(), static_cast<std::size_t>(RaceSettings::kLeastRounds));
}

TEST(Spread, IsSmallestMiddleAndLargest) {
  const Spread odd = spread_of({3.0, 1.0, 2.0});
  EXPECT_EQ(odd.min, 1.0);
  EXPECT_EQ(odd.median, 2.0);
  EXPECT_EQ(odd.max, 3.0);
  EXPECT_EQ(spread_of({1.0, 2.0, 4.0, 8.0}).median, 3.0);
  EXPECT_EQ(spread_of({}).median, 0.0);
}

TEST(SpeedRatio, IsOfPairsAndOverOneWhereOursIsFaster) {
  const Spread ratio = speed_ratio({1.0, 2.0, 1.0}, {2.0, 2.0, 4.0});
  EXPECT_EQ(ratio.min, 1.0);
  EXPECT_EQ(ratio.median, 2.0);
  EXPECT_EQ(ratio.max, 4.0);
}

TEST(RateRow, CountsWhatEachDidInARun) {
  // Ours did a tenth of the work in half the time.
  const std::vector<double> peer = {2.0};
  const BenchRow row = rate_row({.part = "trace", .peer = "x"}, 1e6, {1.0}, 1e7, &peer);
  EXPECT_DOUBLE_EQ(row.our_value, 1.0);
  EXPECT_DOUBLE_EQ(row.peer_value, 5.0);
  EXPECT_DOUBLE_EQ(row.ratio.median, 0.2);
  EXPECT_EQ(row.repeats, 1U);
}

TEST(Contestants, AreEveryStructureOnceAndEveryPreset) {
  EXPECT_EQ(contestants(BenchPlan{}).size(), accel::all_structure_kinds().size() - 1 + 2);
  BenchPlan grids;
  grids.structures = {accel::StructureKind::grid_box};
  ASSERT_EQ(contestants(grids).size(), 1U);
  EXPECT_EQ(contestants(grids)[0].name, "grid-box");
  EXPECT_EQ(contestants(grids)[0].peer, EmbreeQuality::low);
}

TEST(Csv, HasACellForEveryColumnAndQuotesCommas) {
  BenchRow row{.part = "dynamic", .ours = "bvh-sah, \"fast\""};
  const std::string line = csv_line(row);
  EXPECT_NE(line.find("\"bvh-sah, \"\"fast\"\"\""), std::string::npos) << line;
  const std::string header = csv_header();
  EXPECT_EQ(std::count(header.begin(), header.end(), ',') + 1,
            std::count(line.begin(), line.end(), ','));
}

}  // namespace
}  // namespace encore::app::bench
