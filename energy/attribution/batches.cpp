#include "energy/attribution/batches.h"

#include "energy/attribution/counter_reader.h"
#include "energy/attribution/windows.h"
#include "energy/statistics.h"
#include "energy/student_t.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::energy {

namespace {

constexpr double kBatches = 48;
constexpr double kAges = 10;
constexpr std::size_t kLeastBatches = 4;

struct Batch {
  double joules = 0.0;  ///< or seconds, where time an operation is asked for
  double amount = 0.0;  ///< operations or seconds
  double seconds = 0.0;
};

class Cutter {
 public:
  Cutter(const CounterReader& reader, const BusyTimeline* busy, double least)
      : reader_(reader), busy_(busy), least_(least) {}

  void cut(const Window& window) {
    const std::vector<TracePoint>& points = reader_.points();
    for (const CounterRun& run : reader_.runs(window)) {
      const std::size_t of_run = batches.size();  // where the batches of this run begin
      std::size_t start = run.first;
      for (std::size_t i = run.first + 1; i <= run.last; ++i) {
        if (!points[i].changed || (points[i].time - points[start].time).value < least_) continue;
        batches.push_back(between(start, i));
        start = i;
      }
      if (start < run.last) add_rest(start, run.last, of_run);
    }
  }

  std::vector<Batch> batches;

 private:
  [[nodiscard]] Batch between(std::size_t from, std::size_t to) const {
    const TracePoint& a = reader_.points()[from];
    const TracePoint& b = reader_.points()[to];
    const double seconds = (b.time - a.time).value;
    return {(b.energy - a.energy).value, busy_ ? busy_->operations(a.time, b.time) : seconds,
            seconds};
  }

  /// What is left at the end of a run joins its last batch unless it is half a one.
  void add_rest(std::size_t from, std::size_t to, std::size_t of_run) {
    const Batch rest = between(from, to);
    if (rest.seconds >= 0.5 * least_ || batches.size() == of_run) {
      batches.push_back(rest);
      return;
    }
    batches.back().joules += rest.joules;
    batches.back().amount += rest.amount;
    batches.back().seconds += rest.seconds;
  }

  const CounterReader& reader_;
  const BusyTimeline* busy_;
  double least_;
};

/// What batches tell about the mean of joules over amount.
std::optional<Batches> scatter_of(std::vector<Batch> batches) {
  std::erase_if(batches, [](const Batch& b) { return b.amount <= 0 || b.joules < 0; });
  if (batches.size() < kLeastBatches) return std::nullopt;
  std::vector<double> values;
  std::vector<double> weights;
  for (const Batch& batch : batches) {
    values.push_back(batch.joules / batch.amount);
    weights.push_back(batch.amount);
  }
  const Estimate estimate = estimate_mean(values, weights);
  if (!(estimate.mean > 0) || !estimate.ci95_half_width) return std::nullopt;
  const double degrees = *estimate.effective_samples - 1.0;
  const double relative = *estimate.ci95_half_width / estimate.mean;
  return Batches{{relative / student_t_quantile(0.975, degrees), degrees, relative},
                 *estimate.effective_samples,
                 values.size()};
}

}  // namespace

std::optional<Batches> batches_of(const SourceInfo& source, const TraceView& trace,
                                  const BusyTimeline* busy, const std::vector<Window>& windows) {
  const std::vector<Window> joined = join_windows(windows);
  const CounterReader reader(source, trace);
  const double least = std::max(length_of(joined).value / kBatches, kAges * reader.typical_age());
  Cutter cutter(reader, busy, least);
  for (const Window& window : joined) cutter.cut(window);
  return scatter_of(std::move(cutter.batches));
}

std::optional<Batches> time_batches_of(const BusyTimeline& busy,
                                       const std::vector<Window>& windows) {
  const std::vector<Window> joined = join_windows(windows);
  const double least = length_of(joined).value / kBatches;
  std::vector<Batch> batches;
  for (const Window& window : joined) {
    const double length = (window.to - window.from).value;
    const int count = std::max(1, static_cast<int>(std::floor(length / least + 0.5)));
    for (int i = 0; i < count; ++i) {
      const double each = length / count;
      const Seconds from = window.from + Seconds(each) * i;
      batches.push_back({each, busy.operations(from, from + Seconds(each)), each});
    }
  }
  return scatter_of(std::move(batches));
}

}  // namespace encore::energy
