#include "energy/runner.h"

#include "energy/attribution/excitation.h"
#include "energy/phase_probe.h"
#include "energy/row_builder.h"

#include <algorithm>

namespace encore::energy {

namespace {

/// How far a stretch of the plan is that wants both a time and a number of operations.
double share_done(Seconds elapsed, Seconds wanted, std::uint64_t operations, std::uint64_t least) {
  const double by_time = wanted.value > 0 ? elapsed / wanted : 1.0;
  const double by_count =
      least > 0 ? static_cast<double>(operations) / static_cast<double>(least) : 1.0;
  return std::clamp(std::min(by_time, by_count), 0.0, 1.0);
}

/// Rows that are kept in memory: eleven minutes of the shortest ones. A longer run merges
/// neighbours, which changes no mean; the file has all of them.
constexpr std::size_t kMostRows = 1U << 16U;

void halve(std::vector<FrameRow>& rows) {
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2) rows[i / 2] = merge(rows[i], rows[i + 1]);
  rows.resize(rows.size() / 2);
}

class Run {
 public:
  Run(Workload& workload, const Plan& plan, const RunContext& context)
      : workload_(workload),
        plan_(plan),
        context_(context),
        clock_(context.clock),
        probe_(context.sampler, context.live),
        log_(clock_),
        row_(context) {
    log_.tell(&probe_);
    whole_ = (plan.idle_before + plan.warm_up + plan.run + plan.mix + plan.idle_after).value;
  }

  /// Sleeps for a while with all sources read at its edges.
  void idle(Seconds length) {
    if (length.value <= 0 || context_.stop) return;
    read_sources();
    const Seconds start = clock_.now();
    constexpr Seconds kStep(0.1);
    for (Seconds now = start; now - start < length && !context_.stop; now = clock_.now()) {
      report(now, (now - start).value, "idle");
      clock_.sleep_until(std::min(now + kStep, start + length), context_.stop);
    }
    read_sources();
    result_.idle.push_back({start, clock_.now()});
    before_ += length.value;
  }

  void warm_up() {
    const Seconds start = clock_.now();
    std::uint64_t operations = 0;
    while (!context_.stop) {
      const Seconds now = clock_.now();
      const double done =
          share_done(now - start, plan_.warm_up, operations, plan_.warm_up_operations);
      report(now, done * plan_.warm_up.value, "warm-up");
      if (done >= 1.0) break;
      operate();
      ++operations;
    }
    before_ += plan_.warm_up.value;
  }

  void measure() {
    workload_.begin_measuring();
    read_sources();
    const Seconds start = clock_.now();
    std::uint64_t operations = 0;
    while (!context_.stop) {
      const Seconds now = clock_.now();
      const double done = share_done(now - start, plan_.run, operations, plan_.min_operations);
      const bool row_done = !row_.empty() && now - row_.started() >= plan_.row;
      if (row_done) finish_row();
      report(now, done * plan_.run.value, "measuring");
      if (plan_.max_operations > 0 && operations >= plan_.max_operations) break;
      if (done >= 1.0 && (!plan_.until || good_enough(now - start, row_done))) break;

      if (row_.empty()) row_.start(std::max(plan_.row, operation_time_));
      const Seconds began = clock_.now();
      operate();
      operation_time_ = clock_.now() - began;
      row_.add(log_.spans(), probe_, result_.phase_counts);
      result_.busy.add_operations(1.0, began, clock_.now());
      ++operations;
    }
    if (!row_.empty()) finish_row();
    read_sources();
    result_.measured = {start, clock_.now()};
    before_ += plan_.run.value;
  }

  /// Repeats single phases in varied proportions, if there is more than one to tell apart and the
  /// sources cannot see them one by one.
  void mix() {
    const std::vector<Phase> phases = phases_to_mix();
    if (phases.empty()) return;
    // What a block costs is found out by running each once: what must follow a phase (a build after
    // moving triangles) takes its time, too.
    PerPhase<Seconds> costs{};
    read_sources();
    const Seconds start = clock_.now();
    for (const Phase phase : phases) {
      const Seconds began = clock_.now();
      log_.clear();
      workload_.run_alone(phase, log_);
      note_spans();
      costs[phase] = clock_.now() - began;
    }
    Seconds period;
    for (const std::size_t source : context_.total) {
      const SourceInfo& info = context_.sampler->info(source);
      period = std::max({period, info.update_period, info.smoothing});
    }
    const Seconds limit = plan_.mix * 1.5;
    for (const MixBlock& block :
         make_mix_blocks(phases, costs, period, plan_.mix, plan_.mix_seed)) {
      if (context_.stop || clock_.now() - start > limit) break;
      report(clock_.now(), std::min((clock_.now() - start).value, plan_.mix.value), "mixing");
      run_block(block, phases);
    }
    read_sources();
    result_.mixed.push_back({start, clock_.now()});
    before_ += plan_.mix.value;
  }

  Measurement take() {
    result_.stopped = context_.stop;
    return std::move(result_);
  }

 private:
  void operate() {
    log_.clear();
    workload_.operation(log_);
    note_spans();
  }
  void note_spans() {
    for (const PhaseSpan& span : log_.spans()) {
      probe_.learn(span);
      result_.busy.add(static_cast<std::size_t>(span.phase), span.start, span.end);
    }
  }
  void run_block(const MixBlock& block, const std::vector<Phase>& phases) {
    read_sources();
    for (const Phase phase : phases) {
      for (std::size_t n = 0; n < block.repeats[phase] && !context_.stop; ++n) {
        log_.clear();
        workload_.run_alone(phase, log_);
        note_spans();
      }
    }
    if (block.sleep.value > 0) clock_.sleep_until(clock_.now() + block.sleep, context_.stop);
  }
  [[nodiscard]] std::vector<Phase> phases_to_mix() const {
    if (plan_.mix.value <= 0 || context_.sampler == nullptr || context_.stop) return {};
    std::size_t happened = 0;
    bool all_seen = true;
    for (const Phase phase : kPhases) {
      if (result_.phase_counts[phase] == 0) continue;
      ++happened;
      all_seen = all_seen && probe_.reads_edges(phase, context_.total);
    }
    if (happened < 2 || all_seen) return {};
    std::vector<Phase> phases;
    for (const Phase phase : workload_.separable()) {
      if (result_.phase_counts[phase] > 0) phases.push_back(phase);
    }
    return phases;
  }
  [[nodiscard]] bool good_enough(Seconds elapsed, bool row_done) const {
    if (elapsed >= plan_.until_limit) return true;
    return row_done && context_.observer.enough && context_.observer.enough();
  }
  void read_sources() {
    if (context_.sampler != nullptr) context_.sampler->read_now();
  }
  void finish_row() {
    result_.rows.push_back(row_.take(workload_));
    if (context_.observer.on_row) context_.observer.on_row(result_.rows.back());
    if (result_.rows.size() >= kMostRows) halve(result_.rows);
  }
  /// Not more often than rows are made, so that short operations follow each other undisturbed.
  void report(Seconds now, double done, std::string_view doing) {
    if (!context_.observer.on_progress || (reported_ && now - *reported_ < plan_.row)) return;
    reported_ = now;
    context_.observer.on_progress(whole_ > 0 ? (before_ + done) / whole_ : 0.0, doing);
  }

  Workload& workload_;
  const Plan& plan_;
  const RunContext& context_;
  const Clock& clock_;
  PhaseProbe probe_;
  PhaseLog log_;
  RowBuilder row_;
  Measurement result_;
  Seconds operation_time_;
  std::optional<Seconds> reported_;
  double whole_ = 0.0;   ///< seconds of the whole plan
  double before_ = 0.0;  ///< of its parts that are done
};

}  // namespace

Measurement run(Workload& workload, const Plan& plan, const RunContext& context) {
  workload.prepare();
  Run one(workload, plan, context);
  one.idle(plan.idle_before);
  one.warm_up();
  one.measure();
  one.mix();
  one.idle(plan.idle_after);
  return one.take();
}

}  // namespace encore::energy
