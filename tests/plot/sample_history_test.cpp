// The history holds what was added, in bounded memory, and answers in bounded size.
#include "ui/plot/sample_history.h"

#include "tests/plot/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace {

using encore::ui::Bucket;
using encore::ui::Reading;
using encore::ui::SampleHistory;
using encore::ui::test::fill;
using encore::ui::test::Given;
using encore::ui::test::random_series;

constexpr std::size_t kSmallRaw = 64;
constexpr std::size_t kSmallMerged = 32;

/// What the samples that the buckets hold say together.
struct Whole {
  std::uint64_t count = 0;
  std::uint64_t changed = 0;
  double sum = 0.0;
  double integral = 0.0;
  double covered = 0.0;
  float min = std::numeric_limits<float>::max();
  float max = std::numeric_limits<float>::lowest();
};

Whole whole_of(const std::vector<Bucket>& buckets) {
  Whole whole;
  for (const Bucket& b : buckets) {
    whole.count += b.count;
    whole.changed += b.changed;
    whole.sum += b.sum;
    whole.integral += b.integral;
    whole.covered += b.covered;
    whole.min = std::min(whole.min, b.min);
    whole.max = std::max(whole.max, b.max);
  }
  return whole;
}

Whole whole_of(const std::vector<Given>& series) {
  Whole whole;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Given& s = series[i];
    ++whole.count;
    whole.changed += s.changed ? 1 : 0;
    whole.sum += s.value;
    whole.min = std::min(whole.min, static_cast<float>(s.value));
    whole.max = std::max(whole.max, static_cast<float>(s.value));
    if (i == 0 || s.gap_before) continue;
    const double length = s.time - series[i - 1].time;
    whole.covered += length;
    whole.integral += 0.5 * length * (s.value + series[i - 1].value);
  }
  return whole;
}

void expect_in_order(const std::vector<Bucket>& buckets) {
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    const Bucket& b = buckets[i];
    EXPECT_LE(b.from, b.t0);
    EXPECT_LE(b.t0, b.t1);
    EXPECT_LE(b.min, b.max);
    EXPECT_GE(b.first, b.min);
    EXPECT_LE(b.last, b.max);
    if (i > 0) {
      EXPECT_LE(buckets[i - 1].t1, b.t0);
    }
  }
}

TEST(SampleHistory, ForgetsNothingOfTheWholeWhateverItsSize) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const auto series = random_series(seed, 200 * seed * seed);
    SampleHistory history(Reading::point, kSmallRaw, kSmallMerged);
    fill(history, series);
    const Whole truth = whole_of(series);
    for (const std::size_t most : {1U, 2U, 7U, 300U}) {
      const auto buckets = history.between(series.front().time, series.back().time, most);
      ASSERT_LE(buckets.size(), most);
      expect_in_order(buckets);
      const Whole found = whole_of(buckets);
      EXPECT_EQ(found.count, truth.count);
      EXPECT_EQ(found.changed, truth.changed);
      EXPECT_EQ(found.sum, truth.sum);
      EXPECT_EQ(found.min, truth.min);
      EXPECT_EQ(found.max, truth.max);
      EXPECT_NEAR(found.integral, truth.integral, 1e-9 * std::abs(truth.integral));
      EXPECT_NEAR(found.covered, truth.covered, 1e-9 * truth.covered);
      EXPECT_EQ(buckets.front().first, static_cast<float>(series.front().value));
      EXPECT_EQ(buckets.back().last, static_cast<float>(series.back().value));
    }
  }
}

TEST(SampleHistory, ARangeHoldsItsSamplesAndNoOthersWhereTheyAreRaw) {
  for (unsigned seed = 20; seed < 40; ++seed) {
    const auto series = random_series(seed, 900);
    SampleHistory history;
    fill(history, series);
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::size_t> pick(0, series.size() - 1);
    for (int round = 0; round < 20; ++round) {
      double t0 = series[pick(random)].time;
      double t1 = series[pick(random)].time;
      if (t0 > t1) std::swap(t0, t1);
      std::vector<Given> inside;
      std::copy_if(series.begin(), series.end(), std::back_inserter(inside),
                   [&](const Given& s) { return s.time >= t0 && s.time <= t1; });
      // With enough room each sample stays alone; equal times only share the parts' order.
      const auto buckets = history.between(t0, t1, 4000);
      const Whole found = whole_of(buckets);
      // A merged bucket is kept whole where it is no wider than a cell: at most that much more.
      const double cell = (t1 - t0) / 3999.0;
      std::uint64_t near = 0;
      for (const Given& s : series) near += s.time >= t0 - cell && s.time <= t1 + cell ? 1 : 0;
      EXPECT_GE(found.count, inside.size());
      EXPECT_LE(found.count, near);
    }
  }
}

TEST(SampleHistory, AnAnswerIsNeverLongerThanAskedFor) {
  const auto series = random_series(3, 20000);
  SampleHistory history(Reading::point, kSmallRaw, kSmallMerged);
  fill(history, series);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> time(series.front().time - 10.0,
                                              series.back().time + 10.0);
  std::uniform_int_distribution<std::size_t> room(1, 500);
  for (int round = 0; round < 300; ++round) {
    double t0 = time(random);
    double t1 = time(random);
    if (t0 > t1) std::swap(t0, t1);
    const std::size_t most = room(random);
    const auto buckets = history.between(t0, t1, most);
    ASSERT_LE(buckets.size(), most);
    expect_in_order(buckets);
    for (const Bucket& b : buckets) {
      EXPECT_TRUE(b.t1 >= t0 && b.t0 <= t1);
    }
  }
  EXPECT_TRUE(history.between(0.0, 1.0, 0).empty());
  EXPECT_TRUE(history.between(1.0, 0.0, 10).empty());
  EXPECT_TRUE(history.between(std::nan(""), 1.0, 10).empty());
}

TEST(SampleHistory, FiveMillionSamplesStaySmall) {
  SampleHistory history;
  constexpr int kCount = 5'000'000;
  double sum = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double value = (i * 7) % 64;
    sum += value;
    ASSERT_TRUE(history.add(i * 1e-3, value, i % 3 == 0));
  }
  EXPECT_EQ(history.samples(), static_cast<std::uint64_t>(kCount));
  EXPECT_LT(history.bytes(), 50U << 20U);
  const auto all = history.between(0.0, kCount * 1e-3, 1000);
  ASSERT_LE(all.size(), 1000U);
  EXPECT_GT(all.size(), 500U);
  EXPECT_EQ(whole_of(all).count, static_cast<std::uint64_t>(kCount));
  EXPECT_EQ(whole_of(all).sum, sum);
  // The newest samples are there one by one, the oldest as buckets.
  const auto newest = history.between(4999.9, 5000.0, 1000);
  EXPECT_EQ(newest.size(), 100U);
  EXPECT_EQ(newest.back().count, 1U);
  const auto oldest = history.between(0.0, 1.0, 1000);
  EXPECT_GT(oldest.front().count, 1U);
  EXPECT_LE(oldest.size(), 20U);
}

TEST(SampleHistory, ALongPauseIsNotHiddenInsideABucket) {
  // Few samples on either side of a pause: a bucket of 4 or 16 must not bridge it in a picture.
  SampleHistory history(Reading::point, kSmallRaw, kSmallMerged);
  for (int i = 0; i < 30; ++i) history.add(i * 0.01, 1.0);
  for (int i = 0; i < 30; ++i) history.add(100.0 + i * 0.01, 2.0, true, i == 0);
  const auto buckets = history.between(0.0, 101.0, 50);
  bool gap_seen = false;
  for (const Bucket& b : buckets) {
    EXPECT_LT(b.t1 - b.t0, 10.0);
    gap_seen = gap_seen || b.gap_before;
  }
  EXPECT_TRUE(gap_seen);
}

TEST(SampleHistory, BordersStayWhenTheRangeMoves) {
  SampleHistory history;
  for (int i = 0; i < 100000; ++i) history.add(i * 1e-3, i % 10);
  const auto a = history.between(10.0, 20.0, 101);
  const auto b = history.between(10.037, 20.037, 101);
  // The inner buckets are the same ones: those of the second that the first does not know are few.
  std::size_t unknown = 0;
  for (const Bucket& bucket : b) {
    const bool known = std::any_of(a.begin(), a.end(), [&](const Bucket& other) {
      return std::abs(other.t0 - bucket.t0) < 1e-9 && other.count == bucket.count;
    });
    unknown += known ? 0 : 1;
  }
  EXPECT_LE(unknown, 4U);
}

TEST(SampleHistory, RefusesWhatIsNoSampleAndNotesTheGap) {
  SampleHistory history;
  EXPECT_TRUE(history.empty());
  EXPECT_FALSE(history.latest());
  EXPECT_FALSE(history.before(1.0));
  EXPECT_FALSE(history.after(1.0));
  EXPECT_TRUE(history.add(1.0, 5.0));
  EXPECT_FALSE(history.add(0.5, 5.0));
  EXPECT_FALSE(history.add(2.0, std::nan("")));
  EXPECT_FALSE(history.add(std::numeric_limits<double>::infinity(), 1.0));
  EXPECT_FALSE(history.add(2.0, 1e300));
  EXPECT_EQ(history.samples(), 1U);
  EXPECT_TRUE(history.add(3.0, 6.0));
  EXPECT_TRUE(history.latest()->gap_before);
  EXPECT_EQ(history.latest()->covered, 0.0);
  EXPECT_TRUE(history.add(3.0, 7.0));
  EXPECT_FALSE(history.latest()->gap_before);
  history.clear();
  EXPECT_TRUE(history.empty());
  EXPECT_EQ(history.bytes(), 0U);
  EXPECT_TRUE(history.add(0.0, 1.0));
  EXPECT_FALSE(history.latest()->gap_before);
}

TEST(SampleHistory, FindsTheNeighboursOfATime) {
  const auto series = random_series(8, 3000);
  SampleHistory history;
  fill(history, series);
  for (std::size_t i = 0; i < series.size(); i += 7) {
    const double time = series[i].time + 1e-6;
    const auto later =
        std::find_if(series.begin(), series.end(), [&](const Given& s) { return s.time > time; });
    const auto after = history.after(time);
    ASSERT_EQ(after.has_value(), later != series.end());
    if (after) {
      EXPECT_EQ(after->t0, later->time);
      EXPECT_EQ(after->first, static_cast<float>(later->value));
    }
    const auto before = history.before(time);
    ASSERT_TRUE(before);
    EXPECT_EQ(before->t1, (later - 1)->time);
    EXPECT_EQ(before->last, static_cast<float>((later - 1)->value));
  }
  EXPECT_FALSE(history.before(series.front().time));
  // Where the raw samples are gone, the neighbours are buckets around the time.
  SampleHistory small(Reading::point, 16, 16);
  fill(small, series);
  const double old = 0.5 * (series[10].time + series[11].time);
  EXPECT_LE(small.before(old)->t0, old);
  EXPECT_GE(small.after(old)->t0, old);
}

TEST(SampleHistory, KeepsTheWidestBand) {
  SampleHistory history(Reading::point, 16, 16);
  for (int i = 0; i < 200; ++i) history.add(i, 10.0, true, false, i == 50 ? 3.0 : 1.0);
  const auto all = history.between(0.0, 200.0, 1);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].low, 7.0F);
  EXPECT_EQ(all[0].high, 13.0F);
  EXPECT_EQ(all[0].min, 10.0F);
}

}  // namespace
