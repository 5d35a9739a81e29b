#include "energy/runner.h"

#include <algorithm>

namespace encore::energy {

namespace {

/// Gathers operations until they fill a row.
class RowBuilder {
 public:
  [[nodiscard]] bool empty() const { return operations_ == 0; }

  void start(Seconds time) { start_ = time; }
  void add(std::span<const PhaseSpan> spans, PerPhase<std::uint64_t>& counts) {
    ++operations_;
    for (const PhaseSpan& span : spans) {
      ++counts[span.phase];
      sums_[span.phase] = sums_[span.phase].value_or(Seconds(0)) + (span.end - span.start);
    }
  }

  /// The row of everything since the last one; `zero` is the time that rows count from.
  FrameRow take(const Workload& workload, Seconds zero) {
    FrameRow row;
    row.time = start_ - zero;
    row.configuration = workload.configuration();
    row.operations = operations_;
    for (const Phase phase : kPhases) {
      if (sums_[phase]) row.phases[phase] = *sums_[phase] / static_cast<double>(operations_);
    }
    *this = {};
    return row;
  }

  [[nodiscard]] Seconds started() const { return start_; }

 private:
  Seconds start_;
  std::uint64_t operations_ = 0;
  PerPhase<std::optional<Seconds>> sums_;
};

/// How far a stretch of the plan is that wants both a time and a number of operations.
double share_done(Seconds elapsed, Seconds wanted, std::uint64_t operations, std::uint64_t least) {
  const double by_time = wanted.value > 0 ? elapsed / wanted : 1.0;
  const double by_count =
      least > 0 ? static_cast<double>(operations) / static_cast<double>(least) : 1.0;
  return std::clamp(std::min(by_time, by_count), 0.0, 1.0);
}

/// The part of the whole plan that warming up is taken to be, for progress.
double warm_up_share(const Plan& plan) {
  const double whole = plan.warm_up.value + plan.run.value;
  return whole > 0 ? plan.warm_up.value / whole : 0.0;
}

class Run {
 public:
  Run(Workload& workload, const Plan& plan, const Clock& clock, Seconds zero,
      const std::atomic<bool>& stop, const RunObserver& observer)
      : workload_(workload),
        plan_(plan),
        clock_(clock),
        zero_(zero),
        stop_(stop),
        observer_(observer),
        log_(clock) {}

  void warm_up() {
    const Seconds start = clock_.now();
    std::uint64_t operations = 0;
    while (!stop_) {
      const double done =
          share_done(clock_.now() - start, plan_.warm_up, operations, plan_.warm_up_operations);
      report(clock_.now(), done * warm_up_share(plan_));
      if (done >= 1.0) return;
      log_.clear();
      workload_.operation(log_);
      ++operations;
    }
  }

  Measurement measure() {
    const double before = warm_up_share(plan_);
    const Seconds start = clock_.now();
    std::uint64_t operations = 0;
    while (!stop_) {
      const Seconds now = clock_.now();
      const double done = share_done(now - start, plan_.run, operations, plan_.min_operations);
      const bool enough = plan_.max_operations > 0 && operations >= plan_.max_operations;
      if (!row_.empty() && now - row_.started() >= plan_.row) finish_row();
      report(now, before + (1.0 - before) * done);
      if (done >= 1.0 || enough) break;

      if (row_.empty()) row_.start(clock_.now());
      log_.clear();
      workload_.operation(log_);
      row_.add(log_.spans(), measurement_.phase_counts);
      ++operations;
    }
    if (!row_.empty()) finish_row();
    measurement_.stopped = stop_;
    return std::move(measurement_);
  }

 private:
  void finish_row() {
    measurement_.rows.push_back(row_.take(workload_, zero_));
    if (observer_.on_row) observer_.on_row(measurement_.rows.back());
  }
  /// Not more often than rows are made, so that short operations follow each other undisturbed.
  void report(Seconds now, double share) {
    if (!observer_.on_progress || (reported_ && now - *reported_ < plan_.row)) return;
    reported_ = now;
    observer_.on_progress(share);
  }

  Workload& workload_;
  const Plan& plan_;
  const Clock& clock_;
  Seconds zero_;
  const std::atomic<bool>& stop_;
  const RunObserver& observer_;
  PhaseLog log_;
  RowBuilder row_;
  std::optional<Seconds> reported_;
  Measurement measurement_;
};

}  // namespace

Measurement run(Workload& workload, const Plan& plan, const Clock& clock, Seconds session_start,
                const std::atomic<bool>& stop, const RunObserver& observer) {
  workload.prepare();
  Run one(workload, plan, clock, session_start, stop, observer);
  one.warm_up();
  return one.measure();
}

}  // namespace encore::energy
