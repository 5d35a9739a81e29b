// Statistics of a range are those of its samples, and say where they are not.
#include "energy/statistics.h"
#include "tests/plot/series.h"
#include "ui/plot/sample_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using encore::ui::Reading;
using encore::ui::SampleHistory;
using encore::ui::test::fill;
using encore::ui::test::Given;
using encore::ui::test::random_series;

/// Integral and covered time in a range, piece by piece in tiny steps of the definition.
struct Area {
  double integral = 0.0;
  double covered = 0.0;
};

Area area_of(const std::vector<Given>& series, Reading reading, double t0, double t1) {
  Area area;
  for (std::size_t i = 1; i < series.size(); ++i) {
    const Given& a = series[i - 1];
    const Given& b = series[i];
    const double from = std::max(a.time, t0);
    const double to = std::min(b.time, t1);
    if (b.gap_before || !(to > from)) continue;
    const auto value = [&](double t) {
      if (reading == Reading::mean_since) return b.value;
      return a.value + (b.value - a.value) * (t - a.time) / (b.time - a.time);
    };
    area.integral += (to - from) * 0.5 * (value(from) + value(to));
    area.covered += to - from;
  }
  return area;
}

TEST(RangeStatistics, AreThoseOfTheSortedSamples) {
  for (const Reading reading : {Reading::point, Reading::mean_since}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const auto series = random_series(seed, 1500);
      SampleHistory history(reading);
      fill(history, series);
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> time(series.front().time, series.back().time);
      double t0 = time(random);
      double t1 = time(random);
      if (t0 > t1) std::swap(t0, t1);
      std::vector<double> values;
      std::uint64_t changes = 0;
      for (const Given& s : series) {
        if (s.time < t0 || s.time > t1) continue;
        values.push_back(s.value);
        changes += s.changed ? 1 : 0;
      }
      const auto s = history.statistics(t0, t1);
      ASSERT_EQ(s.has_value(), !values.empty());
      if (!s) continue;
      EXPECT_FALSE(s->approximate);
      EXPECT_EQ(s->samples, values.size());
      EXPECT_EQ(s->changes, changes);
      const auto percentile = [&](double q) {
        return encore::energy::percentile(values, q).value();
      };
      EXPECT_NEAR(s->min, percentile(0.0), 1e-9);
      EXPECT_NEAR(s->p5, percentile(0.05), 1e-9);
      EXPECT_NEAR(s->p25, percentile(0.25), 1e-9);
      EXPECT_NEAR(s->median, percentile(0.5), 1e-9);
      EXPECT_NEAR(s->p75, percentile(0.75), 1e-9);
      EXPECT_NEAR(s->p95, percentile(0.95), 1e-9);
      EXPECT_NEAR(s->p99, percentile(0.99), 1e-9);
      EXPECT_NEAR(s->max, percentile(1.0), 1e-9);
      const Area area = area_of(series, reading, t0, t1);
      EXPECT_NEAR(s->covered_s, area.covered, 1e-9);
      EXPECT_NEAR(s->without_data_s, t1 - t0 - area.covered, 1e-9);
      EXPECT_NEAR(s->integral.value(), area.integral, 1e-7 * std::abs(area.integral));
    }
  }
}

TEST(RangeStatistics, NothingWhereThereIsNoSample) {
  SampleHistory history;
  EXPECT_FALSE(history.statistics(0.0, 1.0));
  history.add(5.0, 1.0);
  EXPECT_FALSE(history.statistics(0.0, 1.0));
  EXPECT_FALSE(history.statistics(6.0, 5.0));
  const auto one = history.statistics(4.0, 6.0);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->samples, 1U);
  EXPECT_FALSE(one->integral) << "one sample covers no time: its energy is unknown, not 0";
  EXPECT_FALSE(one->time_mean);
  EXPECT_EQ(one->without_data_s, 2.0);
}

TEST(RangeStatistics, AGapHasNoEnergy) {
  SampleHistory history;
  for (int i = 0; i <= 10; ++i) history.add(i, 10.0);
  for (int i = 20; i <= 30; ++i) history.add(i, 10.0, true, i == 20);
  const auto s = history.statistics(0.0, 30.0);
  ASSERT_TRUE(s);
  EXPECT_DOUBLE_EQ(*s->integral, 200.0);
  EXPECT_DOUBLE_EQ(s->covered_s, 20.0);
  EXPECT_DOUBLE_EQ(s->without_data_s, 10.0);
  EXPECT_DOUBLE_EQ(*s->time_mean, 10.0);
}

TEST(RangeStatistics, UnevenSamplesHaveTwoMeans) {
  SampleHistory history(Reading::mean_since);
  history.add(0.0, 0.0);
  history.add(9.0, 10.0);
  history.add(10.0, 20.0);
  const auto s = history.statistics(0.0, 10.0);
  ASSERT_TRUE(s);
  EXPECT_DOUBLE_EQ(*s->time_mean, 11.0);
  EXPECT_DOUBLE_EQ(s->mean, 10.0);
}

TEST(RangeStatistics, OldRangesAreFlaggedAndClose) {
  SampleHistory history(Reading::point, 256, 4096);
  std::mt19937 random(4);
  std::normal_distribution<double> noise(35.0, 2.0);
  std::vector<double> values;
  for (int i = 0; i < 8000; ++i) {
    values.push_back(noise(random));
    history.add(i * 0.01, values.back());
  }
  const auto all = history.statistics(0.0, 80.0);
  ASSERT_TRUE(all);
  EXPECT_TRUE(all->approximate);
  EXPECT_EQ(all->samples, 8000U);
  EXPECT_FLOAT_EQ(static_cast<float>(all->min),
                  static_cast<float>(*std::min_element(values.begin(), values.end())));
  EXPECT_FLOAT_EQ(static_cast<float>(all->max),
                  static_cast<float>(*std::max_element(values.begin(), values.end())));
  EXPECT_NEAR(all->median, encore::energy::median(values).value(), 0.1);
  EXPECT_NEAR(all->p95, encore::energy::percentile(values, 0.95).value(), 0.3);
  EXPECT_FALSE(history.statistics(79.0, 80.0)->approximate);
}

TEST(RangeStatistics, RepeatsAreNoChanges) {
  SampleHistory history;
  for (int i = 0; i < 100; ++i) history.add(i, i / 10, i % 10 == 0);
  const auto s = history.statistics(0.0, 99.0);
  EXPECT_EQ(s->samples, 100U);
  EXPECT_EQ(s->changes, 10U);
}

}  // namespace
