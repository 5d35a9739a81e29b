#include "app/window/pane_worker.h"

#include "app/window/pane_inspection.h"
#include "app/window/pane_picture.h"
#include "app/window/pane_rows.h"
#include "app/window/steady_time.h"
#include "app/window/thread_priority.h"
#include "app/workload_frames.h"
#include "app/workloads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace encore::app {

namespace {

/// Marks of one round; explore mode makes at most a dozen.
constexpr std::size_t kMostMarks = 64;
/// A picture that takes no longer is drawn whole while the camera moves.
constexpr double kQuickFrame_s = 0.045;
constexpr int kCoarsest = 12;

/// The same without anybody who looks at the host's nodes: what is measured.
PaneRequest unobserved(PaneRequest request) {
  request.nodes = false;
  request.free.reset();
  request.pick.reset();
  return request;
}

}  // namespace

/// What only the worker's thread touches.
struct PaneWorker::Work {
  explicit Work(const Setup& setup)
      : tracer(setup.gl_device), log(setup.monitor->clock(), kMostMarks) {}

  PaneTracer tracer;
  PanePicture picture;
  PaneInspection inspection;
  energy::PhaseLog log;
  std::unique_ptr<energy::PhaseListener> listener;
  std::optional<Device> listener_device;
  std::optional<ui::FrameFigures> frame;  ///< of the last whole frame
  std::uint64_t serial = 0;
  double seconds_a_pixel = 0.0;  ///< of the last picture
  std::uint64_t slot_frame = 0;  ///< of the animation, over all slots
  std::uint64_t cancelled_at = 0;
};

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
      wake_.wait(lock, [this] { return stop_ || job_ != nullptr || (wanted_ && !held_); });
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
  work.log.clear();
  work.log.tell(work.listener.get());
  watch_.progress = 0.0F;
  if (work.tracer.must_build(request)) {
    set_status(ui::PaneState::working,
               fmt::format("building {}", accel::to_string(request.structure.kind)));
  } else if (!work.picture.whole(work.tracer, request)) {
    set_status(ui::PaneState::working, "tracing");
  }
  work.tracer.prepare(request, work.log, &watch_);
  if (!work.picture.whole(work.tracer, request)) set_status(ui::PaneState::working, "tracing");
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
  if (!work.picture.trace(work.tracer, request, 1, work.log, &cancel_trace_)) return false;
  if (!work.picture.drew()) return true;
  ui::FrameFigures figures = figures_of(work.log);
  figures.rays = traces_rays(*request.device) ? std::uint64_t(pixels) : 0;
  figures.uploaded_bytes = work.tracer.uploaded_bytes();
  if (figures.render_s) work.seconds_a_pixel = *figures.render_s / pixels;
  work.frame = figures;
  if (setup_.on_frame && !work.log.spans().empty()) {
    setup_.on_frame(row_of(request, work.log, work.tracer.triangles().triangles.size()));
  }
  return true;
}

void PaneWorker::measure(const PaneRequest& request, SlotJob& job) {
  Work& work = *work_;
  if (!request.device || !request.scene || request.width <= 0 || request.cancelled) return;
  work.log.tell(nullptr);
  work.log.clear();
  set_status(ui::PaneState::working, "preparing a slot");
  work.tracer.prepare(unobserved(request), work.log, &watch_);
  if (work.listener_device != request.device) {
    work.listener = setup_.monitor->listener(*request.device);
    work.listener_device = request.device;
  }
  work.log.tell(work.listener.get());
  measure_operations(request, job);
  job.ran = true;
  work.picture.take_drawn(work.tracer, request);
  work.picture.color(request);
  ui::FrameFigures figures = figures_of(work.log);
  figures.rays = traces_rays(*request.device)
                     ? std::uint64_t(request.width) * std::uint64_t(request.height)
                     : 0;
  figures.uploaded_bytes = work.tracer.uploaded_bytes();
  work.frame = figures;
  work.inspection.look(work.tracer, request, &cancel_trace_);
  set_status(ui::PaneState::ready);
  publish();
}

void PaneWorker::measure_operations(const PaneRequest& request, const SlotJob& job) {
  Work& work = *work_;
  const bool animated = request.scene->animated();
  const bool forced = job.forced && !animated;
  const WorkloadSpec spec = workload_of(request, forced);
  const energy::Clock& clock = setup_.monitor->clock();
  const double step_s = frame_step_s(*request.scene);
  PaneRequest frame = unobserved(request);

  Slot slot;
  slot.idle = false;
  slot.configuration = configuration_of(spec, work.tracer.triangles().triangles.size());
  if (traces_rays(*request.device)) slot.rays = double(request.width) * request.height;
  set_status(ui::PaneState::working, "measuring");
  in_slot_ = true;
  setup_.attribution->slot_began(slot);
  const energy::Seconds end = clock.now() + job.length;
  try {
    do {
      work.log.clear();
      const energy::Seconds began = clock.now();
      setup_.attribution->begin_operation();
      if (animated) {
        // The middle of a step: rounding cannot move it over the border of a sequence's frame.
        frame.time_s = (static_cast<double>(work.slot_frame++) + 0.5) * step_s;
        work.tracer.prepare(frame, work.log, nullptr);
      } else if (forced) {
        work.tracer.follow_forced(frame, work.log);
      }
      work.tracer.draw(frame.camera, frame.width, frame.height, work.log, nullptr);
      setup_.attribution->operation(work.log.spans(), began, clock.now());
    } while (clock.now() < end && !job.stop->load(std::memory_order_relaxed));
  } catch (...) {
    setup_.attribution->slot_ended();
    throw;
  }
  setup_.attribution->slot_ended();
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
  output->refits_on_device = work.tracer.fitted_on_device();
  output->triangles = work.tracer.triangles().triangles.size();
  output->memory_bytes += work.tracer.memory_bytes();
  {
    const std::lock_guard lock(mutex_);
    output_ = std::move(output);
  }
  if (setup_.on_change) setup_.on_change();
}

}  // namespace encore::app
