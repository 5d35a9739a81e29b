// Error against run time: what has a place on logarithmic axes, and what the slope promises.
#include "ui/plot/scatter_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace encore::ui;

constexpr PlotRect kArea{50.0F, 20.0F, 450.0F, 320.0F};

ErrorSeries series_of(std::size_t count, double factor) {
  ErrorSeries series;
  series.name = "watts";
  for (std::size_t i = 1; i <= count; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    series.points.push_back({t, factor / std::sqrt(t)});
  }
  return series;
}

TEST(ScatterLayout, FitShowsAllPointsAndTheTarget) {
  ErrorData data;
  data.series = {series_of(1000, 0.1), series_of(50, 0.5)};
  data.target = 1e-4;
  Axis x = elapsed_axis();
  Axis y = error_axis();
  fit_errors(data, x, y);
  EXPECT_LT(y.low, 0.01);
  for (const ErrorSeries& series : data.series) {
    for (const PlacedPoint& p : place_errors(series, x, y, kArea)) {
      EXPECT_GE(p.x, kArea.x0);
      EXPECT_LE(p.x, kArea.x1);
      EXPECT_GE(p.y, kArea.y0);
      EXPECT_LE(p.y, kArea.y1);
      const ErrorSample& point = series.points[p.index];
      EXPECT_NEAR(axis_value(x, (p.x - kArea.x0) / kArea.width()), point.elapsed_s,
                  1e-4 * point.elapsed_s);
    }
  }
}

TEST(ScatterLayout, WhatHasNoPlaceIsLeftOut) {
  ErrorSeries series;
  series.points = {{0.0, 0.1}, {-1.0, 0.1},         {1.0, std::nullopt},
                   {1.0, 0.0}, {1.0, std::nan("")}, {std::numeric_limits<double>::infinity(), 0.1},
                   {2.0, 0.1}};
  const auto placed = place_errors(series, elapsed_axis(), error_axis(), kArea);
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_EQ(placed[0].index, 6U);
  ErrorData none;
  none.series = {ErrorSeries{}};
  Axis x = elapsed_axis();
  Axis y = error_axis();
  fit_errors(none, x, y);
  EXPECT_LT(x.low, x.high);
  EXPECT_FALSE(reference_error(none.series[0], 1.0));
  EXPECT_FALSE(target_time(none.series[0], 0.01));
}

TEST(ScatterLayout, ManyPointsBecomeFewAndKeepTheExtremes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(0.5, 2.0);
  ErrorSeries series = series_of(200000, 0.1);
  double highest = 0.0;
  for (ErrorSample& point : series.points) {
    *point.relative_ci95 *= noise(random);
    highest = std::max(highest, *point.relative_ci95);
  }
  ErrorData data;
  data.series = {series};
  Axis x = elapsed_axis();
  Axis y = error_axis();
  fit_errors(data, x, y);
  const auto placed = place_errors(series, x, y, kArea);
  EXPECT_LE(placed.size(), 2U * 401U);
  bool seen = false;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    seen = seen || *series.points[placed[i].index].relative_ci95 == highest;
    if (i > 0) {
      EXPECT_GT(placed[i].index, placed[i - 1].index);
    }
  }
  EXPECT_TRUE(seen);
}

TEST(ScatterLayout, LinesRunToTheEdges) {
  const ErrorSeries series = series_of(1000, 0.1);
  Axis x = elapsed_axis();
  set_range(x, 10.0, 20.0);
  const auto placed = place_errors(series, x, error_axis(), kArea);
  EXPECT_LT(placed.front().x, kArea.x0);
  EXPECT_GT(placed.back().x, kArea.x1);
}

TEST(ScatterLayout, TheSlopeSaysWhenTheTargetIsReached) {
  const ErrorSeries series = series_of(100, 0.1);  // 0.1 / sqrt(10 s) at the end
  EXPECT_NEAR(reference_error(series, 40.0).value(), 0.1 / std::sqrt(40.0), 1e-12);
  const auto later = target_time(series, 0.01);
  EXPECT_FALSE(later->reached);
  EXPECT_NEAR(later->elapsed_s, 100.0, 1e-9);
  const auto reached = target_time(series, 0.05);
  EXPECT_TRUE(reached->reached);
  EXPECT_NEAR(reached->elapsed_s, 4.0, 0.11);
  // A dip below the target that does not last does not count.
  ErrorSeries dip = series;
  dip.points[5].relative_ci95 = 1e-6;
  EXPECT_NEAR(target_time(dip, 0.05)->elapsed_s, reached->elapsed_s, 1e-12);
}

TEST(ScatterLayout, TheMouseFindsTheNearestPoint) {
  const std::vector<std::vector<PlacedPoint>> placed{{{10, 10, 0}, {20, 10, 1}}, {{12, 14, 7}}};
  EXPECT_EQ(nearest_error(placed, 11.0F, 10.0F, 5.0F)->point, 0U);
  EXPECT_EQ(nearest_error(placed, 12.0F, 13.0F, 5.0F)->series, 1U);
  EXPECT_FALSE(nearest_error(placed, 100.0F, 100.0F, 5.0F));
}

TEST(ScatterLayout, OfTooFewSamplesNothingIsDrawnOrForetold) {
  ErrorSeries series;
  series.points = {
      {0.1, 0.01, 2.0}, {1.0, 0.4, 8.0}, {2.0, 0.3, 20.0}, {3.0, 12.7, 2.0}, {4.0, 0.2, 30.0}};
  EXPECT_FALSE(drawable(series.points[0]));
  EXPECT_TRUE(drawable(series.points[1])) << "8 are enough";
  EXPECT_TRUE(drawable({1.0, 0.4})) << "their number is not known";
  Axis x = elapsed_axis();
  Axis y = error_axis();
  fit_errors({{series}, {}}, x, y);
  EXPECT_LT(y.high, 100.0) << "the wild one counts for nothing";
  EXPECT_GT(x.low, 0.5);
  const auto placed = place_errors(series, x, y, {0.0F, 0.0F, 400.0F, 200.0F});
  ASSERT_EQ(placed.size(), 3U);
  EXPECT_FALSE(placed[1].apart);
  EXPECT_TRUE(placed[2].apart) << "no line over what is left out";
  EXPECT_TRUE(target_time(series, 0.01));
  series.points.push_back({5.0, 6.0, 2.0});
  EXPECT_EQ(last_point(series), nullptr);
  EXPECT_FALSE(target_time(series, 0.01)) << "an older point says nothing of now";
  EXPECT_FALSE(reference_error(series, 1.0));
}

}  // namespace
