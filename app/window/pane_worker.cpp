#include "app/window/pane_worker.h"

#include "app/window/pane_rows.h"
#include "app/window/pane_work.h"
#include "app/window/steady_time.h"
#include "app/window/thread_priority.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace encore::app {

namespace {

/// A picture that takes no longer is drawn whole while the camera moves.
constexpr double kQuickFrame_s = 0.045;
constexpr int kCoarsest = 12;

}  // namespace

PaneWorker::PaneWorker(Setup setup)
    : setup_(std::move(setup)), work_(std::make_unique<Work>(setup_)) {
  watch_.cancel = &cancel_build_;
  thread_ = std::thread([this] { run(); });
}

PaneWorker::~PaneWorker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    cancel_trace_ = true;
    cancel_build_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void PaneWorker::ask(PaneRequest request) {
  {
    const std::lock_guard lock(mutex_);
    if (request == latest_) return;
    // A frame of an animation is finished even if time has gone on; a view that nobody looks at
    // any more is not.
    if (!request.same_frame(latest_)) cancel_trace_ = true;
    const bool builds_same = request.scene == latest_.scene && request.device == latest_.device &&
                             request.structure == latest_.structure && !request.cancelled;
    if (!builds_same) cancel_build_ = true;
    latest_ = request;
    wanted_ = std::move(request);
  }
  wake_.notify_all();
}

std::shared_ptr<const PaneOutput> PaneWorker::output() const {
  const std::lock_guard lock(mutex_);
  return output_;
}

PaneStatus PaneWorker::status() const {
  const std::lock_guard lock(mutex_);
  PaneStatus status = status_;
  if (status.state == ui::PaneState::working && status.doing.starts_with("building")) {
    status.progress = static_cast<double>(watch_.progress.load(std::memory_order_relaxed));
  }
  return status;
}

void PaneWorker::hold(bool held) {
  {
    const std::lock_guard lock(mutex_);
    held_ = held;
    if (held) cancel_trace_ = true;
    if (!held) wanted_ = latest_;  // what it looks like after its slots
  }
  wake_.notify_all();
}

bool PaneWorker::at_rest() const {
  const std::lock_guard lock(mutex_);
  return held_ && !busy_ && job_ == nullptr;
}

bool PaneWorker::can_run() const {
  const std::lock_guard lock(mutex_);
  return latest_.scene && latest_.device && !latest_.cancelled && latest_.width > 0 &&
         status_.state != ui::PaneState::failed;
}

bool PaneWorker::run_slot(energy::Seconds length, bool forced, const std::atomic<bool>& stop) {
  SlotJob job;
  job.length = length;
  job.forced = forced;
  job.stop = &stop;
  std::unique_lock lock(mutex_);
  if (stop_) return false;
  job_ = &job;
  wake_.notify_all();
  slot_done_.wait(lock, [&job] { return job.done; });
  return job.ran;
}

void PaneWorker::set_status(ui::PaneState state, std::string doing, std::string problem) {
  {
    const std::lock_guard lock(mutex_);
    const bool goes_on = state == status_.state && doing == status_.doing;
    const double since = goes_on ? status_.since_s : steady_now();
    status_ = {state, std::move(doing), std::nullopt, since, std::move(problem)};
  }
  if (setup_.on_change) setup_.on_change();
}

bool PaneWorker::newer_wanted() const {
  const std::lock_guard lock(mutex_);
  return stop_ || job_ != nullptr || wanted_ || held_;
}

bool PaneWorker::superseded(const PaneRequest& request) const {
  const std::lock_guard lock(mutex_);
  return stop_ || job_ != nullptr || (wanted_ && !wanted_->same_frame(request));
}

void PaneWorker::run() {
  yield_to_window();
  for (;;) {
    PaneRequest request;
    SlotJob* job = nullptr;
    {
      std::unique_lock lock(mutex_);
      busy_ = false;
      wake_.wait(lock, [this] { return stop_ || job_ != nullptr || (wanted_ && !held_); });
      busy_ = true;
      if (stop_) {
        if (job_ != nullptr) job_->done = true;
        break;
      }
      job = job_;
      request = latest_;
      wanted_.reset();
      cancel_trace_ = false;
      cancel_build_ = false;
    }
    try {
      if (job != nullptr) {
        measure(request, *job);
      } else {
        explore(request);
      }
    } catch (const accel::BuildCancelled&) {
      // Either something newer is wanted, or the user has had enough.
      if (request.cancelled || !superseded(request)) set_status(ui::PaneState::cancelled);
    } catch (const std::bad_alloc&) {
      work_->tracer.clear();
      set_status(ui::PaneState::failed, {},
                 "out of memory; choose a structure with less memory or a smaller scene");
    } catch (const std::exception& error) {
      set_status(ui::PaneState::failed, {}, error.what());
    }
    if (job != nullptr) {
      in_slot_ = false;
      const std::lock_guard lock(mutex_);
      job->done = true;
      job_ = nullptr;
      slot_done_.notify_all();
    }
  }
  slot_done_.notify_all();
  work_.reset();  // OpenGL objects go on the thread that made them
}

void PaneWorker::explore(const PaneRequest& request) {
  Work& work = *work_;
  if (!request.device || !request.scene) {
    work.tracer.clear();
    work.picture.clear();
    work.inspection.clear();
    work.frame.reset();
    {
      const std::lock_guard lock(mutex_);
      output_.reset();
    }
    set_status(request.device ? ui::PaneState::waiting : ui::PaneState::off);
    return;
  }
  if (request.cancelled) {
    set_status(ui::PaneState::cancelled);
    return;
  }
  if (request.width <= 0 || request.height <= 0) return;
  if (work.listener_device != request.device) {
    work.log.tell(nullptr);
    work.listener = setup_.monitor->listener(*request.device);
    work.listener_device = request.device;
  }
  const bool goes_on = work.refining && work.refining->same_frame(request) &&
                       work.refining->time_s == request.time_s && work.log.spans().size() > 0;
  if (!goes_on) work.log.clear();
  work.refining.reset();
  work.log.tell(work.listener.get());
  watch_.progress = 0.0F;
  if (work.tracer.must_build(request)) {
    set_status(ui::PaneState::working,
               fmt::format("building {}", accel::to_string(request.structure.kind)));
  } else if (!goes_on && !work.picture.whole(work.tracer, request)) {
    set_status(ui::PaneState::working, "tracing");
  }
  // What other rays cost is not known yet.
  if (work.tracer.rays() != request.rays) work.seconds_a_pixel = 0.0;
  work.tracer.prepare(request, work.log, &watch_);
  if (!goes_on && !work.picture.whole(work.tracer, request)) {
    set_status(ui::PaneState::working, "tracing");
  }
  if (!trace(request)) return;
  work.picture.color(request);
  if (!work.inspection.look(work.tracer, request, &cancel_trace_)) {
    publish();
    return;
  }
  set_status(ui::PaneState::ready);
  publish();
}

bool PaneWorker::trace(const PaneRequest& request) {
  Work& work = *work_;
  const double pixels = double(request.width) * request.height;
  const double whole_s = work.seconds_a_pixel * pixels;
  if (request.moving && whole_s > kQuickFrame_s && !work.picture.whole(work.tracer, request)) {
    const int divisor =
        std::clamp(static_cast<int>(std::ceil(std::sqrt(whole_s / kQuickFrame_s))), 2, kCoarsest);
    // A coarse picture is short: it is always finished, so that there is something to see.
    work.picture.trace(work.tracer, request, divisor, work.log, nullptr);
    work.picture.color(request);
    publish();
    work.log.clear();
    if (superseded(request)) return false;
  }
  // While the camera moves each request is soon replaced; a picture that is quick is finished.
  const bool finish = request.moving && whole_s > 0.0 && whole_s <= kQuickFrame_s;
  if (!draw_parts(request, finish ? nullptr : &cancel_trace_)) return false;
  if (work.picture.drew()) take_frame(request);
  return true;
}

bool PaneWorker::draw_parts(const PaneRequest& request, const std::atomic<bool>* cancel) {
  Work& work = *work_;
  for (;;) {
    if (!work.picture.trace(work.tracer, request, 1, work.log, cancel)) return false;
    if (work.picture.complete()) return true;
    const Refinement& refinement = *work.picture.refinement();
    work.seconds_a_pixel =
        refinement.seconds() / refinement.view().samples / (double(request.width) * request.height);
    cancel = &cancel_trace_;
    work.picture.color(request);
    work.inspection.look(work.tracer, request, &cancel_trace_);
    publish();
    work.refining = request;
    const ui::RefinementView& view = refinement.view();
    const double left_s = refinement.seconds() / view.samples * (view.wanted - view.samples);
    // Frames of an animation are finished where that is soon.
    if (left_s <= kQuickFrame_s ? superseded(request) : newer_wanted()) return false;
    set_status(ui::PaneState::working,
               fmt::format("refining, {} of {} samples", view.samples, view.wanted));
  }
}

void PaneWorker::take_frame(const PaneRequest& request) {
  Work& work = *work_;
  const double pixels = double(request.width) * request.height;
  const Refinement* refinement = work.picture.refinement();
  ui::FrameFigures figures = figures_of(work.log);
  add_rays(
      figures, refinement != nullptr ? refinement->rays() : work.tracer.renderer()->last_rays(),
      traces_rays(*request.device) ? std::uint64_t(pixels) * std::uint64_t(work.tracer.samples())
                                   : 0);
  figures.uploaded_bytes = work.tracer.uploaded_bytes();
  if (figures.render_s) {
    work.tracer.learn_frame(*figures.render_s);
    work.seconds_a_pixel = *figures.render_s / pixels / work.tracer.samples();
  }
  work.frame = figures;
  if (setup_.on_frame && !work.log.spans().empty()) {
    const auto built_on =
        work.tracer.built_on_device() ? accel::BuildPlace::device : accel::BuildPlace::cpu;
    setup_.on_frame(row_of(request, built_on, work.log, work.tracer.triangles().triangles.size()));
  }
}

void PaneWorker::publish() {
  Work& work = *work_;
  auto output = std::make_shared<PaneOutput>();
  output->serial = ++work.serial;
  work.picture.fill(*output);
  work.inspection.fill(*output);
  output->frame = work.frame;
  output->device = work.tracer.device_text();
  output->software = work.tracer.device_is_software();
  output->break_even_frames = work.tracer.break_even_frames();
  output->refits_on_device = work.tracer.fitted_on_device();
  if (work.tracer.scene()) {
    output->left_out =
        scene::left_out(*work.tracer.scene(), work.tracer.triangles(), work.tracer.rays());
  }
  output->triangles = work.tracer.triangles().triangles.size();
  output->memory_bytes += work.tracer.memory_bytes();
  {
    const std::lock_guard lock(mutex_);
    output_ = std::move(output);
  }
  if (setup_.on_change) setup_.on_change();
}

}  // namespace encore::app
