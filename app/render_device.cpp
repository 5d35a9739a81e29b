#include "app/render_device.h"

#include "app/interrupt.h"
#include "app/make_renderer.h"
#include "renderer/cpu_tracer.h"

#include <chrono>

namespace encore::app {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::optional<double> milliseconds(const std::optional<double>& seconds) {
  return seconds ? std::optional(1000.0 * *seconds) : std::nullopt;
}

}  // namespace

RenderDevice::RenderDevice(Device device, const renderer::RenderInput& input, GpuContext& gpu,
                           int threads, const scene::RaySettings& rays)
    : input_(input),
      renderer_(make_renderer(device, threads, gpu)),
      tracer_(dynamic_cast<renderer::Tracer*>(renderer_.get())) {
  renderer_->set_cancel_flag(&interrupted);
  renderer_->set_rays(rays);
  if (const auto* cpu = dynamic_cast<const renderer::CpuTracer*>(renderer_.get())) {
    figures_.threads = cpu->threads();
  }
  figures_.device = device;
  figures_.device_name = renderer_->device_name();

  const auto start = Clock::now();
  renderer_->init(input_);
  if (!renderer_->transfers()) return;
  figures_.warm_up_ms = milliseconds_since(start);
  // Once more, for what sending takes alone.
  const auto transfer_start = Clock::now();
  renderer_->init(input_);
  figures_.transfer_ms = milliseconds_since(transfer_start);
  const renderer::Transfer transfer = renderer_->last_transfer();
  figures_.transfer_device_ms = milliseconds(transfer.device_s);
  figures_.transfer_bytes = transfer.uploaded_bytes;
  figures_.converted_bytes = transfer.converted_bytes;
}

bool RenderDevice::run(const std::function<void()>& draw_once) {
  if (figures_.warm_up_ms) {
    const auto start = Clock::now();
    draw_once();
    if (!renderer_->complete()) return false;
    *figures_.warm_up_ms += milliseconds_since(start);
  }
  const auto start = Clock::now();
  draw_once();
  figures_.draw_ms = milliseconds_since(start);
  figures_.hits = renderer_->last_hits();
  figures_.rays = renderer_->last_rays();
  return renderer_->complete();
}

bool RenderDevice::draw(ImageSize size, renderer::Image& image) {
  const bool whole = run([&] { renderer_->draw(input_.scene->camera, size.width, size.height); });
  if (!whole) return false;
  figures_.draw_device_ms = milliseconds(renderer_->last_draw_s());
  renderer_->read(image);
  return true;
}

bool RenderDevice::trace_counters(ImageSize size, std::vector<accel::TraceCounters>& counters) {
  return run(
      [&] { tracer_->trace_counters(input_.scene->camera, size.width, size.height, counters); });
}

bool RenderDevice::trace_hits(ImageSize size, std::vector<scene::Hit>& hits) {
  if (tracer_ == nullptr) return false;
  tracer_->trace_hits(input_.scene->camera, size.width, size.height, hits);
  return renderer_->complete();
}

}  // namespace encore::app
