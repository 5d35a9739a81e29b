#include "app/window/accuracy_task.h"

#include "app/accuracy/accuracy_scatter.h"
#include "app/window/steady_time.h"
#include "energy/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

/// Shares of the progress bar.
constexpr double kReferenceShare = 0.4;
constexpr double kErrorsShare = 0.6;
/// A configuration's turn takes at least so long, if that is more than one frame.
constexpr double kTurn_s = 0.05;

ui::PaneDevice pane_device(Device device) {
  return device == Device::gpu ? ui::PaneDevice::gpu : ui::PaneDevice::cpu;
}

ui::AccuracyResult result_of(const AccuracyRow& row) {
  const HitErrors& hits = row.errors.hits;
  ui::AccuracyResult result;
  result.device = pane_device(row.spec.device);
  result.structure = row.spec.structure.kind;
  result.intersection = row.spec.structure.intersection;
  result.samples = row.spec.rays.samples;
  result.rmse = row.errors.rmse;
  result.missed = hits.missed;
  result.invented = hits.invented;
  result.wrong_triangle = hits.wrong_triangle;
  result.largest_t = hits.largest_t;
  if (row.ms) result.seconds = *row.ms / 1e3;
  result.joules = row.joules;
  result.best_by_time = row.best_by_time;
  result.best_by_energy = row.best_by_energy;
  return result;
}

/// A frame that does nothing but render.
std::optional<double> joules_of(const energy::PowerModel& model, Device device, double seconds) {
  energy::BusyTimes busy;
  busy.phases[energy::Phase::render] = energy::Seconds(seconds);
  if (device == Device::gpu) busy.gpu = energy::Seconds(seconds);
  const auto joules = energy::modelled_energy(model, energy::Seconds(seconds), busy);
  if (!joules) return std::nullopt;
  return joules->value;
}

/// Adds the seconds of one frame or more; false if it was stopped.
bool time_turn(renderer::Tracer& tracer, const scene::Camera& camera, const ImageSize& size,
               std::vector<double>& seconds) {
  const double turn = steady_now();
  bool warm = false;
  bool any = false;
  while (!any || steady_now() - turn < kTurn_s) {
    const double began = steady_now();
    tracer.draw(camera, size.width, size.height);
    const double taken = steady_now() - began;
    if (!tracer.complete()) return false;
    // A quick first frame is dearer than the rest: another configuration's data are in the caches.
    if (warm || taken >= kTurn_s) {
      seconds.push_back(taken);
      any = true;
    }
    warm = true;
  }
  return true;
}

/// Holds the panes for as long as it lives.
class Rest {
 public:
  Rest(const std::function<void(bool, const std::atomic<bool>&)>& hold,
       const std::atomic<bool>& stop)
      : hold_(hold), stop_(stop) {
    if (hold_) hold_(true, stop_);
  }
  ~Rest() {
    if (hold_) hold_(false, stop_);
  }
  Rest(const Rest&) = delete;
  Rest& operator=(const Rest&) = delete;

 private:
  const std::function<void(bool, const std::atomic<bool>&)>& hold_;
  const std::atomic<bool>& stop_;
};

}  // namespace

AccuracyTask::AccuracyTask(Setup setup) : setup_(std::move(setup)) {}

void AccuracyTask::start(AccuracyRequest request) {
  if (task_.running()) return;
  problem_.clear();
  request_ = std::move(request);
  began_s_ = steady_now();
  {
    const std::lock_guard lock(mutex_);
    found_ = {};
  }
  task_.start([this, request = request_](TaskControl& control) {
    const bool done = run(request, control);
    if (setup_.wake) setup_.wake();
    return done;
  });
}

void AccuracyTask::take(TaskResult<bool> result) {
  problem_ = std::move(result.error);
}

void AccuracyTask::poll() {
  if (auto result = task_.take()) take(std::move(*result));
}

void AccuracyTask::say(std::string doing, TaskControl& control, double progress) {
  control.progress = progress;
  {
    const std::lock_guard lock(mutex_);
    found_.doing = std::move(doing);
  }
  if (setup_.wake) setup_.wake();
}

bool AccuracyTask::run(const AccuracyRequest& request, TaskControl& control) {
  say("waiting for the panes to rest", control, 0.0);
  const Rest rest(setup_.hold, control.stop);
  const WorkloadTools tools = setup_.tools();
  const AccuracyReference reference(request.plan, control.stop, [&](double share) {
    say(fmt::format("drawing the reference, {} samples a pixel", request.plan.samples), control,
        share * kReferenceShare);
  });
  if (!reference.complete()) return false;
  {
    const std::lock_guard lock(mutex_);
    found_.own_error = reference.own_error();
  }
  ConfigurationTracers tracers(*request.plan.scene, reference.triangles(), tools, control.stop);
  return compare(request, reference, tracers, control) &&
         time_all(request, reference, tracers, control);
}

bool AccuracyTask::compare(const AccuracyRequest& request, const AccuracyReference& reference,
                           ConfigurationTracers& tracers, TaskControl& control) {
  const auto count = static_cast<double>(request.specs.size());
  for (std::size_t i = 0; i < request.specs.size(); ++i) {
    AccuracyRow row;
    row.spec = request.specs[i];
    say("comparing " + accuracy_label(row), control,
        kReferenceShare + (kErrorsShare - kReferenceShare) * double(i) / count);
    if (control.stop) return false;
    const auto errors = reference.errors_of(tracers.ready(row.spec));
    if (!errors) return false;
    row.errors = *errors;
    const std::lock_guard lock(mutex_);
    found_.rows.push_back(std::move(row));
    found_.csv = accuracy_csv(found_.rows);
  }
  return true;
}

bool AccuracyTask::time_all(const AccuracyRequest& request, const AccuracyReference& reference,
                            ConfigurationTracers& tracers, TaskControl& control) {
  std::vector<std::vector<double>> seconds(request.specs.size());
  const auto turns = static_cast<double>(request.specs.size()) * request.rounds;
  for (int round = 0; round < request.rounds; ++round) {
    for (std::size_t i = 0; i < request.specs.size(); ++i) {
      const double done = double(round) * double(request.specs.size()) + double(i);
      say(fmt::format("timing, round {} of {}", round + 1, request.rounds), control,
          kErrorsShare + (1.0 - kErrorsShare) * done / turns);
      const ImageSize& size = request.plan.size;
      renderer::Tracer& tracer = tracers.ready(request.specs[i]);
      if (!time_turn(tracer, reference.camera(), size, seconds[i]) || control.stop) return false;
    }
    finish_round(request, seconds);
  }
  return true;
}

void AccuracyTask::finish_round(const AccuracyRequest& request,
                                const std::vector<std::vector<double>>& seconds) {
  const std::lock_guard lock(mutex_);
  ++found_.rounds;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    AccuracyRow& row = found_.rows[i];
    if (seconds[i].empty()) continue;
    const double typical = energy::median(seconds[i]).value_or(0.0);
    row.ms = 1e3 * typical;
    if (!request.model) continue;
    row.joules = joules_of(*request.model, row.spec.device, typical);
    if (row.joules) row.origin = energy::Origin::modelled;
  }
  mark_pareto_fronts(found_.rows);
  found_.csv = accuracy_csv(found_.rows);
}

bool AccuracyTask::any() const {
  const std::lock_guard lock(mutex_);
  return !found_.rows.empty();
}

ui::AccuracyView AccuracyTask::view() const {
  ui::AccuracyView view;
  view.work.active = task_.running();
  view.work.cancellable = true;
  if (view.work.active) {
    view.work.progress = task_.progress();
    view.work.elapsed_s = steady_now() - began_s_;
  }
  view.problem = problem_;
  view.of = request_.of;
  view.rounds_wanted = request_.rounds;
  if (request_.model) {
    view.energy = {energy::Origin::modelled, energy::describe(*request_.model)};
  } else {
    view.energy = {energy::Origin::unavailable, request_.no_joules};
  }
  const std::lock_guard lock(mutex_);
  view.work.doing = found_.doing;
  view.rounds = found_.rounds;
  view.reference_error = found_.own_error;
  for (const AccuracyRow& row : found_.rows) view.results.push_back(result_of(row));
  view.csv = found_.csv;
  return view;
}

void AccuracyTask::save(const std::filesystem::path& folder) const {
  std::vector<AccuracyRow> rows;
  std::optional<double> own_error;
  {
    const std::lock_guard lock(mutex_);
    rows = found_.rows;
    own_error = found_.own_error;
  }
  std::filesystem::create_directories(folder);
  write_accuracy_csv(folder, rows);
  write_accuracy_scatter(folder, rows, own_error);
}

}  // namespace encore::app
