#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace encore::ui {

/// Samples of a series that follow each other, merged; a single sample is a bucket of one.
struct Bucket {
  double from = 0.0;      ///< s, where the integral begins: the sample before, or t0 after a gap
  double t0 = 0.0;        ///< s, the first sample
  double t1 = 0.0;        ///< s, the last sample
  double covered = 0.0;   ///< s of [from, t1] without the gaps
  double integral = 0.0;  ///< value x s over what is covered
  double sum = 0.0;       ///< of the samples' values
  std::uint64_t count = 0;
  std::uint64_t changed = 0;  ///< samples that differ from the one before: a gauge repeats itself
  float min = 0.0F;
  float max = 0.0F;
  float first = 0.0F;
  float last = 0.0F;
  float low = 0.0F;   ///< least value - half-width
  float high = 0.0F;  ///< largest value + half-width
  bool gap_before = false;

  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  friend bool operator==(const Bucket&, const Bucket&) = default;
};

/// `b` follows `a`.
Bucket merge(const Bucket& a, const Bucket& b);

/// What a value says of the time since the sample before.
enum class Reading : std::uint8_t {
  point,       ///< the value at that time (a gauge): straight lines between samples, trapezoids
  mean_since,  ///< the mean since the sample before (a counter's difference): steps
};

/// Values of a stretch of time. Percentiles are linear between neighbours in order.
struct RangeStatistics {
  double t0 = 0.0;  ///< s, as asked for
  double t1 = 0.0;
  std::uint64_t samples = 0;
  std::uint64_t changes = 0;
  double mean = 0.0;                ///< of the samples
  std::optional<double> time_mean;  ///< integral / covered time
  std::optional<double> integral;   ///< value x s: joules of watts; gaps are left out
  double covered_s = 0.0;
  double without_data_s = 0.0;  ///< gaps, and what lies outside the samples
  double min = 0.0;
  double max = 0.0;
  double median = 0.0;
  double p5 = 0.0, p25 = 0.0, p75 = 0.0, p95 = 0.0, p99 = 0.0;
  bool approximate = false;  ///< part of the range is known from merged samples only
};

/// A series that only grows, in bounded memory: the newest samples as they are, older ones as
/// means and extremes of 4, 16, 64 ... samples, so that days at 1 kHz take some 50 MB. Every level
/// reaches to the newest sample, so that a question's cost depends on the answer's size alone.
class SampleHistory {
 public:
  static constexpr std::size_t kRawSamples = std::size_t{1} << 18U;
  static constexpr std::size_t kMergedBuckets = std::size_t{1} << 16U;

  /// The most entries of the lowest level and of each other one; at least 16, multiples of 4.
  explicit SampleHistory(Reading reading = Reading::point, std::size_t raw = kRawSamples,
                         std::size_t merged = kMergedBuckets);

  /// Adds a sample. `half_width`: value +- this, 0 for none. Returns false, and stores nothing, for
  /// a time before the last one or a value that is no number; the next sample then follows a gap.
  bool add(double time_s, double value, bool changed = true, bool gap_before = false,
           double half_width = 0.0);
  void clear();

  [[nodiscard]] Reading reading() const { return reading_; }
  [[nodiscard]] std::uint64_t samples() const { return added_; }
  [[nodiscard]] bool empty() const { return added_ == 0; }
  /// The newest sample; nothing where there is none.
  [[nodiscard]] std::optional<Bucket> latest() const;
  /// Time of the first sample ever added.
  [[nodiscard]] std::optional<double> first_time() const;
  [[nodiscard]] std::size_t bytes() const;

  /// At most `most` buckets in the order of time that hold the samples in [t0, t1]; single samples
  /// where they fit. Old buckets at the ends may reach beyond. Buckets of a moving range of equal
  /// length keep their borders, so that a picture of them does not flicker.
  [[nodiscard]] std::vector<Bucket> between(double t0, double t1, std::size_t most) const;
  /// The newest sample before and the oldest one after a time; where only merged samples are left,
  /// the last or first of them.
  [[nodiscard]] std::optional<Bucket> before(double time_s) const;
  [[nodiscard]] std::optional<Bucket> after(double time_s) const;

  /// Nothing where [t0, t1] holds no sample.
  [[nodiscard]] std::optional<RangeStatistics> statistics(double t0, double t1) const;
  /// Least and largest value in [t0, t1]; nothing where there is no sample.
  [[nodiscard]] std::optional<std::array<double, 2>> extremes(double t0, double t1) const;

 private:
  struct Raw {
    double time = 0.0;
    float value = 0.0F;
    float half_width = 0.0F;
    bool changed = false;
    bool gap_before = false;
  };
  /// The newest entries of a level; `dropped` older ones are gone.
  template <class T>
  struct Ring {
    std::vector<T> items;
    std::size_t capacity = 0;
    std::uint64_t dropped = 0;  // a multiple of 4, so that levels meet at whole buckets

    [[nodiscard]] std::uint64_t end() const { return end_; }
    [[nodiscard]] const T& operator[](std::uint64_t index) const {
      return items[static_cast<std::size_t>(index % capacity)];
    }
    void push(const T& item);
    void clear();

   private:
    std::uint64_t end_ = 0;
  };

  [[nodiscard]] std::uint64_t end_of(std::size_t level) const;
  [[nodiscard]] std::uint64_t dropped_of(std::size_t level) const;
  [[nodiscard]] Bucket entry(std::size_t level, std::uint64_t index) const;
  [[nodiscard]] Bucket raw_bucket(std::uint64_t index) const;
  void carry(std::size_t level);
  using Wanted = std::function<bool(const Bucket&)>;
  using Use = std::function<void(const Bucket&)>;
  /// Calls `use` with entries in the order of time, no wider than `width` seconds where there are
  /// such (below 0: as fine as there are). `wanted` says whether a bucket, and so a part of it, may
  /// matter.
  void visit(double width, const Wanted& wanted, const Use& use) const;
  void descend(std::size_t level, std::uint64_t index, double width, const Wanted& wanted,
               const Use& use) const;
  /// The first entry of a level whose first sample is at `time_s` or later (`at`), else later.
  [[nodiscard]] std::uint64_t first_entry(std::size_t level, double time_s, bool at) const;

  Reading reading_;
  std::size_t merged_capacity_;
  Ring<Raw> raw_;
  std::vector<Ring<Bucket>> levels_;  // levels_[k] holds buckets of 4^(k+1) samples
  std::optional<Raw> before_raw_;     // the sample before the oldest one in raw_
  std::optional<double> first_time_;
  std::uint64_t added_ = 0;
  bool gap_pending_ = false;
};

}  // namespace encore::ui
