#include "app/experiment.h"

#include "app/convergence_log.h"
#include "app/energy_rows.h"
#include "app/machine_log.h"
#include "app/number_text.h"
#include "app/ray_report.h"
#include "app/workload_frames.h"
#include "energy/machine.h"
#include "energy/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

using energy::Attribution;
using energy::ReadState;

/// What a simulated sensor may look back upon: seconds of the shortest phases.
constexpr std::size_t kHistory = 1U << 18U;

bool wants_history(const MeasuringOptions& options) {
  const auto simulated = [](const std::string& word) { return word.starts_with("simulated"); };
  return std::any_of(options.sources.begin(), options.sources.end(), simulated);
}

/// A source that is read more or less often than it asks for itself.
class AtPollPeriod final : public energy::PowerSource {
 public:
  AtPollPeriod(std::unique_ptr<PowerSource> source, energy::Seconds period)
      : source_(std::move(source)), info_(source_->info()) {
    info_.poll_period = period;
  }
  [[nodiscard]] const energy::SourceInfo& info() const override { return info_; }
  energy::ReadResult read(energy::Seconds now) override { return source_->read(now); }

 private:
  std::unique_ptr<PowerSource> source_;
  energy::SourceInfo info_;
};

std::vector<energy::SourceInfo> infos_of(const PowerSources& sources) {
  std::vector<energy::SourceInfo> infos;
  for (const std::size_t i : sources.total) infos.push_back(sources.sources[i]->info());
  return infos;
}

/// Readings as rows of samples.csv: a counter's power is the mean since the reading before.
class SampleRows {
 public:
  energy::SampleRow make(const energy::SourceInfo& info, const energy::ReadResult& result,
                         energy::Seconds start) {
    energy::SampleRow row;
    row.time = result.reading.time - start;
    row.source = info.name;
    row.joules = result.reading.energy;
    row.watts = result.reading.power;
    row.changed = result.reading.changed;
    row.restarted = result.state == ReadState::restarted;
    row.origin = info.provenance.origin;
    Last& last = last_of(info.name);
    const energy::Seconds step = result.reading.time - last.time;
    // Between two updates a counter stands still: that is no power of 0.
    const bool tells = last.known && !row.restarted && step >= info.update_period * 2.0;
    if (!row.watts && tells) row.watts = (result.reading.energy - last.energy) / step;
    last = {info.name, result.reading.time, result.reading.energy, true};
    return row;
  }

 private:
  struct Last {
    std::string source;
    energy::Seconds time;
    energy::Joules energy;
    bool known = false;
  };
  Last& last_of(const std::string& source) {
    for (Last& last : last_) {
      if (last.source == source) return last;
    }
    last_.push_back({source, {}, {}, false});
    return last_.back();
  }
  std::vector<Last> last_;
};

}  // namespace

Experiment::Experiment(Setup setup, const std::atomic<bool>& stop, Terminal& terminal)
    : info_(std::move(setup.info)),
      tools_(std::move(setup.tools)),
      stop_(stop),
      terminal_(terminal),
      sensor_root_(setup.measuring.sensor_root),
      start_(clock_.now()),
      live_(wants_history(setup.measuring) ? kHistory : 1),
      sources_(open_power_sources(setup.measuring, live_)),
      phase_watts_(phase_watts(setup.measuring)) {
  info_.plan = make_plan(setup.measuring, infos_of(sources_));
  info_.sensor = sources_.provenance;
  for (std::size_t i = 0; i < sources_.sources.size(); ++i) {
    if (info_.plan.poll) {
      sources_.sources[i] =
          std::make_unique<AtPollPeriod>(std::move(sources_.sources[i]), *info_.plan.poll);
    }
    const bool in_total =
        std::find(sources_.total.begin(), sources_.total.end(), i) != sources_.total.end();
    info_.sources.push_back({sources_.sources[i]->info(), in_total});
  }
  source_name_ = total_name(sources_);
}

Experiment::~Experiment() = default;

void Experiment::open(const std::filesystem::path& folder, energy::CsvWriter::Open how) {
  writer_ = std::make_unique<energy::SessionWriter>(
      folder, info_, energy::SessionColumns{configuration_columns(), counter_columns()}, how);
  machine_log_ =
      std::make_unique<MachineLog>(folder, how, energy::SensorRoot(sensor_root_), start_);
  if (sources_.sources.empty()) return;
  sampler_ = std::make_unique<energy::Sampler>(std::move(sources_.sources), clock_, sink());
  thread_ = std::make_unique<energy::SamplerThread>(*sampler_, clock_);
}

void Experiment::resume(const std::filesystem::path& folder, const energy::SessionInfo& before,
                        energy::Seconds reached) {
  constexpr energy::Seconds kPause(1.0);  // so that no two rows share a time
  start_ = clock_.now() - reached - kPause;
  info_.started_utc = before.started_utc;
  info_.machine = before.machine;
  open(folder, energy::CsvWriter::Open::append);
  note("the study was resumed; what was cut off before is measured anew");
}

energy::SamplerSink Experiment::sink() {
  // Called on the sampler's thread: what goes wrong there is told by the main one.
  const auto guarded = [this](const auto& write) {
    try {
      write();
    } catch (const std::exception& error) {
      const std::lock_guard lock(failure_mutex_);
      if (failure_.empty()) failure_ = error.what();
    }
  };
  energy::SamplerSink sink;
  sink.on_reading = [this, guarded, rows = SampleRows()](const energy::SourceInfo& info,
                                                         const energy::ReadResult& result) mutable {
    if (result.state == ReadState::failed || result.state == ReadState::lost) return;
    guarded([&] { writer_->add(rows.make(info, result, start_)); });
  };
  sink.on_event = [this, guarded](const energy::SamplerEvent& event) {
    guarded([&] {
      const std::lock_guard lock(failure_mutex_);
      news_.push_back(event.message);
      writer_->add(energy::EventRow{event.time - start_, event.source, event.message});
    });
  };
  return sink;
}

void Experiment::note(const std::string& sentence) {
  const std::lock_guard lock(failure_mutex_);
  writer_->add(energy::EventRow{clock_.now() - start_, "", sentence});
}

void Experiment::check_writing() {
  std::vector<std::string> news;
  {
    const std::lock_guard lock(failure_mutex_);
    if (!failure_.empty()) throw energy::SessionError(failure_);
    news.swap(news_);
  }
  for (const std::string& line : news) terminal_.warning(line);
}

std::optional<Experiment::Result> Experiment::measure(
    const WorkloadSpec& spec, const std::function<void(double, std::string_view)>& progress) {
  const auto workload = make_workload(spec, tools_);
  if (auto* moving = dynamic_cast<DynamicWorkload*>(workload.get()); moving && phase_watts_) {
    moving->set_phase_weights(*phase_watts_);
  }
  if (info_.plan.cool_down.value > 0) {
    progress(0.0, "cooling down");
    clock_.sleep_until(clock_.now() + info_.plan.cool_down, stop_);
  }
  std::optional<ConvergenceLog> convergence;
  energy::RunContext context{clock_, start_, stop_, {}, sampler_.get(), sources_.total, &live_};
  context.observer.on_row = [&](const energy::FrameRow& row) {
    writer_->add(row);
    if (!convergence) {
      convergence.emplace(info_.plan, sampler_.get(), sources_.total, row.time + start_);
    }
    convergence->add(row, clock_.now());
    if (const auto predicted = convergence->new_prediction()) {
      terminal_.progress_done();
      terminal_.info(fmt::format("{}: ±{:g} % will take about {}", workload_name(spec),
                                 100.0 * *info_.plan.until, duration_text(predicted->value)));
    }
    machine_log_->poll(clock_.now());
    check_writing();
  };
  context.observer.enough = [&] { return convergence && convergence->enough(clock_.now()); };
  context.observer.on_progress = [&](double share, std::string_view doing) {
    const bool predicted = convergence && !convergence->words().empty() && doing == "measuring";
    progress(share, predicted ? std::string_view(convergence->words()) : doing);
  };
  progress(0.0, "preparing");
  machine_log_->begin(clock_.now());
  const energy::Measurement measured = energy::run(*workload, info_.plan, context);
  check_writing();
  if (measured.rows.empty()) return std::nullopt;

  Result result;
  energy::SummaryRow& summary = result.summary;
  summary = energy::summarise(measured.rows, measured.phase_counts);
  machine_log_->end(clock_.now(), summary);
  energy::PerPhase<energy::Seconds> mean{};
  for (const energy::Phase phase : energy::kPhases) {
    mean[phase] = summary.mean * summary.shares[phase].value_or(0.0);
  }
  summary.counters = workload->counters(mean);
  write_windows(measured, summary.configuration);
  for (const energy::ConvergenceRow& row : convergence->rows(summary.configuration)) {
    writer_->add(row);
  }
  const std::string verdict = convergence->verdict(measured.measured.to);
  attribute_energy(measured, result);
  if (!verdict.empty()) result.notes.push_back(verdict);
  if (!verdict.empty()) note(verdict);
  writer_->add(summary);
  return result;
}

void Experiment::write_windows(const energy::Measurement& measured,
                               const std::vector<energy::KeyValue>& configuration) {
  const auto write = [&](const char* kind, const energy::Window& window) {
    writer_->add(energy::WindowRow{configuration, kind, window.from - start_, window.to - start_});
  };
  for (const energy::Window& window : measured.idle) write("idle", window);
  write("measured", measured.measured);
  for (const energy::Window& window : measured.mixed) write("mixed", window);
}

void Experiment::attribute_energy(const energy::Measurement& measured, Result& result) {
  if (sampler_ == nullptr) return;
  const energy::Seconds from =
      measured.idle.empty() ? measured.measured.from : measured.idle.front().from;
  std::vector<Attribution> parts;
  for (std::size_t i = 0; i < sampler_->source_count(); ++i) {
    energy::AttributionInput input;
    input.source = &sampler_->info(i);
    input.trace = sampler_->trace(i).view(from, clock_.now());
    input.busy = &measured.busy;
    input.measured = {measured.measured};
    input.mixed = measured.mixed;
    input.idle = measured.idle;
    input.cut_below = info_.plan.cut_below;
    Attribution attribution = energy::attribute(input);
    const bool in_total =
        std::find(sources_.total.begin(), sources_.total.end(), i) != sources_.total.end();
    for (energy::PhaseRow& row :
         phase_rows(attribution, input.source->name, input.source->provenance.origin,
                    result.summary.configuration)) {
      writer_->add(row);
    }
    if (in_total) parts.push_back(std::move(attribution));
  }
  if (parts.empty()) return;

  const Attribution total = energy::add(parts);
  add_energy(total, result.summary);
  result.summary.source = source_name_;
  if (result.summary.watts) result.summary.origin = sources_.provenance.origin;
  result.notes = total.notes;
  result.phases =
      phase_rows(total, "total", sources_.provenance.origin, result.summary.configuration);
  add_ray_energy(result.phases, result.summary);
  for (const energy::PhaseRow& row : result.phases) writer_->add(row);
  for (const std::string& sentence : total.notes) note(sentence);
}

energy::SessionState Experiment::run(const std::function<energy::SessionState()>& measure_all) {
  try {
    const energy::SessionState state = measure_all();
    terminal_.progress_done();
    finish(state);
    return state;
  } catch (...) {
    // Say so in the session if that is still possible; what went wrong is told by the caller.
    terminal_.progress_done();
    try {
      finish(energy::SessionState::failed);
    } catch (const energy::SessionError&) {
    }
    throw;
  }
}

void Experiment::finish(energy::SessionState state) {
  thread_.reset();
  check_writing();
  writer_->finish(state);
}

std::optional<energy::SamplerCost> Experiment::sampling_cost() const {
  if (sampler_ == nullptr) return std::nullopt;
  return sampler_->cost();
}

}  // namespace encore::app
