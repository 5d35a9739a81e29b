// The Pareto front and the files of accuracy.
#include "app/accuracy/accuracy_rows.h"
#include "scene/sample_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace encore::app {
namespace {

AccuracyRow row_of(double rmse, std::optional<double> ms, std::optional<double> joules = {}) {
  AccuracyRow row;
  row.spec.scene = std::make_shared<scene::Scene>();
  row.errors.rmse = rmse;
  row.ms = ms;
  row.joules = joules;
  return row;
}

std::vector<bool> by_time(std::vector<AccuracyRow> rows) {
  mark_pareto_fronts(rows);
  std::vector<bool> marks;
  for (const AccuracyRow& row : rows) marks.push_back(row.best_by_time);
  return marks;
}

TEST(ParetoFront, HoldsWhatNothingBeatsInBoth) {
  // The third costs more than the second and errs more.
  EXPECT_EQ(by_time({row_of(0.4, 1.0), row_of(0.2, 2.0), row_of(0.3, 3.0), row_of(0.1, 4.0)}),
            (std::vector<bool>{true, true, false, true}));
}

TEST(ParetoFront, OfOnePriceTheLeastErrorCounts) {
  EXPECT_EQ(by_time({row_of(0.4, 1.0), row_of(0.3, 1.0)}), (std::vector<bool>{false, true}));
}

TEST(ParetoFront, OfOneErrorTheLeastPriceCounts) {
  EXPECT_EQ(by_time({row_of(0.4, 2.0), row_of(0.4, 1.0)}), (std::vector<bool>{false, true}));
}

TEST(ParetoFront, EqualsAreBothOnIt) {
  EXPECT_EQ(by_time({row_of(0.4, 1.0), row_of(0.4, 1.0)}), (std::vector<bool>{true, true}));
}

TEST(ParetoFront, WhatHasNoCostIsOnNone) {
  std::vector<AccuracyRow> rows{row_of(0.0, {}), row_of(0.4, 1.0, 5.0), row_of(0.2, 2.0)};
  mark_pareto_fronts(rows);
  EXPECT_FALSE(rows[0].best_by_time);
  EXPECT_TRUE(rows[1].best_by_time);
  EXPECT_TRUE(rows[2].best_by_time);
  EXPECT_TRUE(rows[1].best_by_energy);
  EXPECT_FALSE(rows[2].best_by_energy);
}

TEST(ParetoFront, MarksOfAnEarlierTimeGo) {
  std::vector<AccuracyRow> rows{row_of(0.4, 1.0), row_of(0.2, 2.0)};
  mark_pareto_fronts(rows);
  rows[1].ms.reset();
  rows[1].best_by_energy = true;
  mark_pareto_fronts(rows);
  EXPECT_FALSE(rows[1].best_by_time);
  EXPECT_FALSE(rows[1].best_by_energy);
}

TEST(AccuracyFile, MissingIsEmptyAndNever0) {
  const auto header = accuracy_header();
  const auto cell = [&](const AccuracyRow& row, const char* name) {
    const auto at = std::find(header.begin(), header.end(), name);
    EXPECT_NE(at, header.end()) << name;
    return to_record(row).at(static_cast<std::size_t>(at - header.begin()));
  };
  const AccuracyRow unknown = row_of(0.25, {});
  ASSERT_EQ(to_record(unknown).size(), header.size());
  for (const char* name : {"ms_per_frame", "ms_per_frame_ci95", "joules_per_frame",
                           "joules_per_frame_ci95", "largest_relative_t"}) {
    EXPECT_EQ(cell(unknown, name), "") << name;
  }
  EXPECT_EQ(cell(unknown, "energy_provenance"), "unavailable");
  EXPECT_EQ(cell(unknown, "rmse"), "0.25");
  EXPECT_EQ(cell(row_of(0.25, 1.5), "ms_per_frame"), "1.5");
}

TEST(AccuracyFile, TextHasOneLineARowAndTheSameNumberOfFields) {
  const std::string text = accuracy_csv({row_of(0.25, 1.5), row_of(0.5, {})});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  const std::string first = text.substr(0, text.find('\n'));
  EXPECT_EQ(std::count(first.begin(), first.end(), ',') + 1,
            static_cast<std::ptrdiff_t>(accuracy_header().size()));
}

scene::Hit hit(float t, std::uint32_t triangle) {
  scene::Hit hit;
  hit.t = t;
  hit.triangle = triangle;
  return hit;
}

TEST(CompareHits, CountsEachKindOfErrorOnce) {
  const scene::Hit none;
  ASSERT_FALSE(none.found());
  const std::vector<scene::Hit> truth{hit(2.0F, 1), hit(2.0F, 1), hit(2.0F, 1), none, none};
  const std::vector<scene::Hit> found{hit(2.5F, 1), none, hit(2.0F, 3), hit(1.0F, 1), none};
  const HitErrors errors = compare_hits(truth, found);
  EXPECT_EQ(errors.rays, 5U);
  EXPECT_EQ(errors.missed, 1U);
  EXPECT_EQ(errors.invented, 1U);
  EXPECT_EQ(errors.wrong_triangle, 1U);
  EXPECT_EQ(errors.wrong(), 3U);
  EXPECT_EQ(errors.largest_t, 0.25);
}

TEST(CompareHits, DistancesAreOnlyOfTheSameTriangle) {
  EXPECT_FALSE(compare_hits({hit(2.0F, 1)}, {hit(7.0F, 2)}).largest_t.has_value());
  EXPECT_EQ(compare_hits({hit(2.0F, 1)}, {hit(2.0F, 1)}).largest_t, 0.0);
}

TEST(CompareHits, PicturesOfOtherSizesAreRefused) {
  EXPECT_THROW(compare_hits({hit(2.0F, 1)}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace encore::app
