// What the thesis' tables say of each other (assets/thesis/README.md).
#include "tests/energy_model/thesis_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace encore::energy {
namespace {

TEST(ThesisTables, HaveAllTheirRowsAndNumbers) {
  struct File {
    std::string name;
    std::size_t rows;
    std::size_t without_rate;
  };
  for (const File& file :
       {File{"appendix_a_build", 63, 0}, File{"appendix_a_memory", 20, 0},
        File{"appendix_a_combined", 108, 16}, File{"table_4", 27, 0}, File{"table_5", 36, 0}}) {
    const auto rows = thesis_rows(file.name);
    EXPECT_EQ(rows.size(), file.rows) << file.name;
    std::size_t without = 0;
    for (const ThesisRow& row : rows) {
      const double rate = number(row, "discharge_rate_mw");
      const double deviation = number(row, "standard_deviation_mw");
      EXPECT_EQ(std::isnan(rate), std::isnan(deviation)) << file.name;
      if (std::isnan(rate)) {
        ++without;
        continue;
      }
      EXPECT_GT(rate, 30'000.0) << file.name;
      EXPECT_LT(rate, 43'000.0) << file.name;
      EXPECT_GT(deviation, 100.0) << file.name;
      EXPECT_LT(deviation, 3'200.0) << file.name;
    }
    EXPECT_EQ(without, file.without_rate) << file.name;
  }
  EXPECT_EQ(thesis_rows("table_6").size(), 8U);
  EXPECT_EQ(thesis_rows("table_7").size(), 2U);
  EXPECT_EQ(thesis_rows("table_10").size(), 3U);
}

TEST(ThesisTables, FourAndFiveAreAppendixA) {
  auto both = thesis_rows("table_4");
  const auto second = thesis_rows("table_5");
  both.insert(both.end(), second.begin(), second.end());
  auto appendix = thesis_rows("appendix_a_build");
  std::sort(both.begin(), both.end());
  std::sort(appendix.begin(), appendix.end());
  EXPECT_EQ(both, appendix);
}

TEST(ThesisTables, DeviationsAreAboutOnePercentWithOneOfFour) {
  double sum = 0.0;
  double largest = 0.0;
  const auto rows = thesis_rows("appendix_a_build");
  for (const ThesisRow& row : rows) {
    const double relative = number(row, "standard_deviation_mw") / number(row, "discharge_rate_mw");
    sum += relative;
    largest = std::max(largest, relative);
  }
  EXPECT_NEAR(sum / static_cast<double>(rows.size()), 0.0114, 5e-5);
  EXPECT_NEAR(largest, 0.0416, 5e-5);
}

TEST(ThesisTables, TenBuildTestsThatWereRunTwiceDifferByThreePercent) {
  double squares = 0.0;
  double largest = 0.0;
  int pairs = 0;
  for (const ThesisRow& again : thesis_rows("appendix_a_combined")) {
    if (again.at("test") != "build") continue;
    for (const ThesisRow& row : thesis_rows("appendix_a_build")) {
      if (row.at("scene") != again.at("scene") || row.at("structure") != again.at("structure") ||
          row.at("action") != again.at("action")) {
        continue;
      }
      const double off =
          number(again, "discharge_rate_mw") / number(row, "discharge_rate_mw") - 1.0;
      squares += off * off;
      largest = std::max(largest, std::fabs(off));
      ++pairs;
    }
  }
  EXPECT_EQ(pairs, 10);
  EXPECT_NEAR(std::sqrt(squares / pairs), 0.030, 5e-4);
  EXPECT_NEAR(largest, 0.068, 5e-4);
}

TEST(ThesisTables, SixSavesWhatTheTextSaysOnlyInTheOtherOrder) {
  std::map<std::string, std::map<std::string, double>> joules;
  for (const ThesisRow& row : thesis_rows("table_6")) {
    joules[row.at("scene")][row.at("structure") + " " + row.at("action")] =
        number(row, "joules_per_build");
  }
  struct Range {
    double least;
    double most;
  };
  // Rounded to 0.05 either way.
  const auto saving = [&](const std::string& scene) {
    const double full = joules[scene]["grid-exact build"];
    const double coarse = joules[scene]["grid-box build"];
    return Range{1.0 - (coarse + 0.05) / (full - 0.05), 1.0 - (coarse - 0.05) / (full + 0.05)};
  };
  EXPECT_LT(saving("Sdragon").most, 0.66);
  EXPECT_LT(saving("Sdragon").least, 0.61);
  EXPECT_GT(saving("Sdragon").most, 0.61);
  EXPECT_LT(saving("Toaster").least, 0.66);
  EXPECT_GT(saving("Toaster").most, 0.66);
}

TEST(ThesisTables, SevenFollowsFromTheScenesOwnRateInOneRowOfTwo) {
  const auto grid_rate = [](const std::string& scene) {
    return rates_of(thesis_rows("appendix_a_build"),
                    [&](const ThesisRow& row) {
                      return row.at("scene") == scene && row.at("structure") == "grid-exact";
                    })
        .at(0);
  };
  const auto rows = thesis_rows("table_7");
  const double mean_rate = 33.6;
  EXPECT_NEAR(mean_rate * number(rows[0], "build_ms") / 1e3, 4.13, 0.005);
  EXPECT_NEAR(mean_rate * number(rows[1], "build_ms") / 1e3, 4.60, 0.005);
  const double first = grid_rate("Bbunny") * number(rows[0], "build_ms") / 1e3;
  const double second = grid_rate("Complex") * number(rows[1], "build_ms") / 1e3;
  EXPECT_NEAR(first, 4.289, 0.0005);
  EXPECT_FALSE(rounds_to(first, number(rows[0], "joules_per_build"), 1));
  EXPECT_NEAR(second, 4.494, 0.0005);
  EXPECT_TRUE(rounds_to(second, number(rows[1], "joules_per_build"), 1));
}

TEST(ThesisTables, EightAndNineAddUp) {
  for (const char* name : {"table_8", "table_9"}) {
    const auto rows = thesis_rows(name);
    EXPECT_EQ(rows.size(), 6U);
    for (const ThesisRow& row : rows) {
      EXPECT_NEAR(number(row, "build_saving_joules") - number(row, "render_increase_joules"),
                  number(row, "total_saving_joules"), 1e-9)
          << name;
    }
  }
}

/// The rate of one test of the combined tables; BV-U has no static rate and takes BV-F's.
double combined_rate(const std::vector<ThesisRow>& rows, const std::string& test,
                     const std::string& device, const ThesisRow& like) {
  for (const ThesisRow& row : rows) {
    if (row.at("test") != test || row.at("device") != device) continue;
    if (row.at("scene") != like.at("scene") || row.at("structure") != like.at("structure")) {
      continue;
    }
    if (test == "static" && row.at("image_side_px") != like.at("image_side_px")) continue;
    const std::string action = test == "static" ? "build" : like.at("action");
    if (row.at("action") == action) return number(row, "discharge_rate_mw");
  }
  return std::nan("");
}

TEST(ThesisTables, ManyDynamicRatesAreNoMixOfBuildAndStatic) {
  const auto rows = thesis_rows("appendix_a_combined");
  std::map<std::string, int> count;
  std::map<std::string, int> outside;
  std::map<std::string, double> furthest;
  for (const ThesisRow& row : rows) {
    const double dynamic = number(row, "discharge_rate_mw");
    if (row.at("test") != "dynamic" || std::isnan(dynamic)) continue;
    const std::string device = row.at("device");
    const double build = combined_rate(rows, "build", "cpu", row);
    const double fixed = combined_rate(rows, "static", device, row);
    ASSERT_FALSE(std::isnan(build) || std::isnan(fixed)) << row.at("thesis_code");
    const double off =
        std::max(std::min(build, fixed) - dynamic, dynamic - std::max(build, fixed)) / dynamic;
    ++count[device];
    if (off > 0.0) ++outside[device];
    furthest[device] = std::max(furthest[device], off);
  }
  EXPECT_EQ(count["cpu"], 24);
  EXPECT_EQ(count["gpu"], 20);
  EXPECT_EQ(outside["cpu"], 12);
  EXPECT_EQ(outside["gpu"], 6);
  EXPECT_NEAR(furthest["cpu"], 0.047, 5e-4);
  EXPECT_NEAR(furthest["gpu"], 0.109, 5e-4);
}

}  // namespace
}  // namespace encore::energy
