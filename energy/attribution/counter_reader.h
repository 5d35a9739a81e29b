#pragma once

#include "energy/attribution/attribution.h"
#include "energy/attribution/chance.h"

#include <cstddef>
#include <vector>

namespace encore::energy {

/// Updates of a counter that lie in one window without a gap between them: indices of points.
struct CounterRun {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Reads a counter's trace at its updates. What a poll finds was true at some time before it: up to
/// one update period earlier, or one poll, if that is shorter. All ages up to that are as likely.
/// Source and trace must outlive the reader.
class CounterReader {
 public:
  CounterReader(const SourceInfo& source, const TraceView& trace);

  /// The updates found in [from, to], in runs of at least two.
  [[nodiscard]] std::vector<CounterRun> runs(const Window& window) const;
  /// How old an update can be when its poll finds it, seconds.
  struct Age {
    double least = 0.0;
    double most = 0.0;
    [[nodiscard]] double mean() const { return 0.5 * (least + most); }
    [[nodiscard]] double range() const { return most - least; }
  };
  [[nodiscard]] Age age(std::size_t point) const;
  /// The most of it in the whole trace, on average.
  [[nodiscard]] double typical_age() const;

  [[nodiscard]] double joules(const CounterRun& run) const;
  /// From update to update, at their mean ages.
  [[nodiscard]] double seconds(const CounterRun& run) const;
  /// Joules that a run owes to its window, because its first update may be from before the
  /// window's start, where the power was another: the difference in power times the mean overlap.
  [[nodiscard]] double start_correction(const CounterRun& run, Seconds start) const;
  /// What a run's joules are off by: the ages of two updates and two roundings. `spread`: how far
  /// power at the edges is from the run's, a relative standard deviation.
  [[nodiscard]] ErrorSum errors(const CounterRun& run, Seconds start, double spread = 0.0) const;
  [[nodiscard]] const std::vector<TracePoint>& points() const { return points_; }

 private:
  /// The age that the poll before allows.
  [[nodiscard]] double oldest(std::size_t point) const;
  /// The nearest update before and after one in its stretch; the point itself if there is none.
  [[nodiscard]] std::size_t update_before(std::size_t point) const;
  [[nodiscard]] std::size_t update_after(std::size_t point) const;
  /// 0 for a run whose updates may have been made at one time.
  [[nodiscard]] double power(const CounterRun& run) const {
    return seconds(run) > 0 ? joules(run) / seconds(run) : 0.0;
  }
  /// Between a run's first update and the one before it; the run's own if there is none.
  [[nodiscard]] double power_before(const CounterRun& run) const;

  const TraceView& trace_;
  const std::vector<TracePoint>& points_;
  double period_;
  double step_;
};

}  // namespace encore::energy
