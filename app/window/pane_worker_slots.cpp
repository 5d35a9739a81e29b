#include "app/window/pane_rows.h"
#include "app/window/pane_work.h"
#include "app/window/pane_worker.h"
#include "app/workload_frames.h"
#include "app/workloads.h"

#include <utility>

namespace encore::app {

namespace {

/// The same without anybody who looks at the host's nodes: what is measured.
PaneRequest unobserved(PaneRequest request) {
  request.nodes = false;
  request.free.reset();
  request.pick.reset();
  return request;
}

}  // namespace

void PaneWorker::tell_rays(const PaneRequest& request, Slot& slot) {
  Work& work = *work_;
  const auto pixels = std::uint64_t(request.width) * std::uint64_t(request.height);
  ui::FrameFigures figures;
  if (work.tracer.plain()) {
    add_rays(figures, std::nullopt, pixels);
  } else {
    const std::uint64_t content = work.tracer.content_serial();
    const auto& known = work.known_rays;
    if (!known || known->content != content || known->camera != request.camera ||
        known->width != request.width || known->height != request.height) {
      // How many rays there are only a frame can tell; this one is not measured.
      work.tracer.draw(request.camera, request.width, request.height, work.log, nullptr);
      work.log.clear();
      add_rays(figures, work.tracer.renderer()->last_rays(),
               pixels * std::uint64_t(work.tracer.samples()));
      work.known_rays = {content, request.camera, request.width, request.height, figures};
    }
    figures = work.known_rays->figures;
  }
  slot.rays = static_cast<double>(figures.rays);
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    slot.kinds[i] = {static_cast<double>(figures.kinds[i].rays), figures.kinds[i].share};
  }
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
  add_rays(figures, work.tracer.renderer()->last_rays(),
           traces_rays(*request.device)
               ? std::uint64_t(request.width) * std::uint64_t(request.height) *
                     std::uint64_t(work.tracer.samples())
               : 0);
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
  const WorkloadSpec spec = workload_of(request, forced, work.tracer.device_is_software());
  const energy::Clock& clock = setup_.monitor->clock();
  const double step_s = frame_step_s(*request.scene);
  PaneRequest frame = unobserved(request);

  Slot slot;
  slot.idle = false;
  slot.configuration = configuration_of(spec, work.tracer.triangles().triangles.size());
  if (traces_rays(*request.device)) tell_rays(frame, slot);
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
      if (const auto render_s = figures_of(work.log).render_s) work.tracer.learn_frame(*render_s);
      setup_.attribution->operation(work.log.spans(), began, clock.now());
    } while (clock.now() < end && !job.stop->load(std::memory_order_relaxed));
  } catch (...) {
    setup_.attribution->slot_ended();
    throw;
  }
  setup_.attribution->slot_ended();
}

}  // namespace encore::app
