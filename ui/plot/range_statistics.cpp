// The questions of SampleHistory that look at single samples.
#include "ui/plot/sample_history.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::ui {

namespace {

/// A value that stands for `weight` samples.
struct Weighted {
  double value = 0.0;
  std::uint64_t weight = 0;
};

/// The samples of a bucket as far as they are known: the extremes are, the others share a mean.
void add_values(const Bucket& bucket, std::vector<Weighted>& values) {
  const auto low = static_cast<double>(bucket.min);
  const auto high = static_cast<double>(bucket.max);
  values.push_back({low, 1});
  if (bucket.count > 1) values.push_back({high, 1});
  if (bucket.count > 2) {
    const double rest = bucket.sum - low - high;
    values.push_back(
        {std::clamp(rest / static_cast<double>(bucket.count - 2), low, high), bucket.count - 2});
  }
}

/// The percentiles of values in order, asked for in rising order.
class Percentiles {
 public:
  explicit Percentiles(std::vector<Weighted> values) : values_(std::move(values)) {
    std::sort(values_.begin(), values_.end(),
              [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    for (const Weighted& value : values_) total_ += value.weight;
  }

  double operator()(double share) {
    const double place = share * static_cast<double>(total_ - 1);
    const auto rank = static_cast<std::uint64_t>(place);
    const double lower = at(rank);
    const double part = place - static_cast<double>(rank);
    if (part <= 0.0) return lower;
    // The neighbour's place is passed without moving on, as the next question may begin before it.
    const std::size_t index = index_;
    const std::uint64_t passed = passed_;
    const double upper = at(rank + 1);
    index_ = index;
    passed_ = passed;
    return lower + part * (upper - lower);
  }

 private:
  double at(std::uint64_t rank) {
    while (passed_ + values_[index_].weight <= rank) passed_ += values_[index_++].weight;
    return values_[index_].value;
  }

  std::vector<Weighted> values_;
  std::uint64_t total_ = 0;
  std::size_t index_ = 0;
  std::uint64_t passed_ = 0;  // samples before index_
};

/// What of a bucket's integral falls in [t0, t1], in seconds and value x seconds.
struct Share {
  double seconds = 0.0;
  double integral = 0.0;
};

Share share_within(const Bucket& b, Reading reading, double t0, double t1) {
  const double begin = std::max(b.from, t0);
  const double end = std::min(b.t1, t1);
  const double length = b.t1 - b.from;
  if (!(end > begin) || b.covered <= 0.0) return {};
  if (begin == b.from && end == b.t1) return {b.covered, b.integral};
  const double part = (end - begin) / length;
  if (b.count > 1 || reading == Reading::mean_since) {
    return {b.covered * part, b.integral * part};
  }
  // One straight line: the mean over a piece of it is its value in the middle.
  const auto right = static_cast<double>(b.last);
  const double left = 2.0 * b.integral / b.covered - right;
  const double middle = (0.5 * (begin + end) - b.from) / length;
  return {end - begin, (end - begin) * (left + (right - left) * middle)};
}

}  // namespace

std::optional<RangeStatistics> SampleHistory::statistics(double t0, double t1) const {
  if (!(t0 <= t1)) return std::nullopt;
  RangeStatistics result;
  result.t0 = t0;
  result.t1 = t1;
  std::vector<Weighted> values;
  double sum = 0.0;
  double integral = 0.0;
  visit(
      -1.0, [&](const Bucket& b) { return b.t1 >= t0 && b.from <= t1; },
      [&](const Bucket& b) {
        const Share share = share_within(b, reading_, t0, t1);
        result.covered_s += share.seconds;
        integral += share.integral;
        // A merged bucket across the range's end counts on the side where its middle is.
        const double middle = 0.5 * (b.t0 + b.t1);
        if (b.count > 1) result.approximate = true;
        if (middle < t0 || middle > t1) return;
        result.samples += b.count;
        result.changes += b.changed;
        sum += b.sum;
        add_values(b, values);
      });
  if (result.samples == 0) return std::nullopt;

  result.mean = sum / static_cast<double>(result.samples);
  if (result.covered_s > 0.0) {
    result.integral = integral;
    result.time_mean = integral / result.covered_s;
  }
  result.without_data_s = std::max(0.0, (t1 - t0) - result.covered_s);
  Percentiles percentile(std::move(values));
  result.min = percentile(0.0);
  result.p5 = percentile(0.05);
  result.p25 = percentile(0.25);
  result.median = percentile(0.5);
  result.p75 = percentile(0.75);
  result.p95 = percentile(0.95);
  result.p99 = percentile(0.99);
  result.max = percentile(1.0);
  return result;
}

}  // namespace encore::ui
