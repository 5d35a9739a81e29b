#include "renderer/gpu_paths.h"

#include "shaders/shared/bindings.h"
#include "shaders/shared/path_types.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace encore::renderer {

namespace {

using scene::RayKind;

// What a band's buffers take together: enough rays to keep any device busy.
constexpr std::uint64_t kBandBytes = std::uint64_t{64} << 20;

// Two lists, of reflections and refractions, are read while two are written.
constexpr std::uint64_t kListsPerPath = 4;

GLuint groups(int count, int group) {
  return static_cast<GLuint>((count + group - 1) / group);
}

/// What follows sees what was written before.
void barrier() {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void set_band(const gl::Program& program, int y, int width, int rows) {
  program.set("width", width);
  program.set("first_row", y);
  program.set("row_count", rows);
}

void dispatch_pixels(const gl::Program& program, int width, int rows) {
  program.use();
  glDispatchCompute(groups(width, kTraceGroupWidth), groups(rows, kTraceGroupHeight), 1);
  barrier();
}

}  // namespace

GpuPaths::GpuPaths(std::shared_ptr<gl::Context> context, const GpuScene& scene, TraceLaunch& launch)
    : context_(std::move(context)),
      scene_(scene),
      launch_(launch),
      clock_(context_->capabilities().timestamp_bits) {}

void GpuPaths::prepare() {
  const scene::Needs& needs = scene_.needs();
  // What another scene needed is given back.
  if (needs != prepared_) buffers_.reset();
  prepared_ = needs;
  for (auto* program : {&start_, &light_, &scatter_, &finish_, &trace_, &trace_shadows_}) {
    program->reset();
  }
  if (!needs.paths()) return;
  const auto pass = [&](PathPass which) {
    return context_->programs().compute(path_pass_file(which), path_pass_defines(which, needs));
  };
  start_ = pass(PathPass::start);
  scatter_ = pass(PathPass::scatter);
  finish_ = pass(PathPass::finish);
  trace_ = launch_.program(TraceOutput::path_hits);
  if (!needs.shadows) return;
  light_ = pass(PathPass::light);
  trace_shadows_ = launch_.program(TraceOutput::shadows);
}

bool GpuPaths::bounces() const {
  return scene_.needs().reflections || scene_.needs().refractions;
}

void GpuPaths::set_cancel_flag(const std::atomic<bool>* flag) {
  cancel_ = flag;
  for (PacedDispatch& pace : paces_) pace.set_cancel_flag(flag);
}

bool GpuPaths::cancelled() const {
  return cancel_ != nullptr && cancel_->load(std::memory_order_relaxed);
}

int GpuPaths::rows_of_band(int width, int height) const {
  const std::uint64_t stack =
      bounces() ? static_cast<std::uint64_t>(scene_.rays().depth) * sizeof(gpu::WaitingRay) : 0;
  const std::uint64_t shadow = scene_.needs().shadows ? sizeof(gpu::ShadowRay) : 0;
  const std::uint64_t largest = std::max<std::uint64_t>(sizeof(gpu::Path), stack);
  const std::uint64_t all =
      sizeof(gpu::Path) + kListsPerPath * sizeof(std::uint32_t) + stack + shadow;
  const std::uint64_t pixels =
      std::min(kBandBytes / all, context_->capabilities().storage_block_bytes / largest);
  const std::uint64_t rows = pixels / static_cast<std::uint64_t>(width);
  return static_cast<int>(std::clamp<std::uint64_t>(rows, 1, static_cast<std::uint64_t>(height)));
}

void GpuPaths::reserve(std::uint64_t pixels) {
  const std::uint64_t most = context_->capabilities().storage_block_bytes;
  if (!buffers_) buffers_ = std::make_unique<Buffers>();
  buffers_->paths.reserve(pixels * sizeof(gpu::Path), most);
  buffers_->queues.reserve((ENCORE_QUEUE_WORDS + kListsPerPath * pixels) * sizeof(std::uint32_t),
                           most);
  if (scene_.needs().shadows) buffers_->shadow_rays.reserve(pixels * sizeof(gpu::ShadowRay), most);
  if (bounces()) {
    const auto depth = static_cast<std::uint64_t>(scene_.rays().depth);
    buffers_->waiting.reserve(pixels * depth * sizeof(gpu::WaitingRay), most);
  }
  buffers_->queues.fill(0, ENCORE_QUEUE_WORDS * sizeof(std::uint32_t));
}

/// What shares its place with buffers of PausedRays is bound each time.
void GpuPaths::bind() const {
  buffers_->paths.bind_storage(ENCORE_BINDING_PATHS);
  buffers_->queues.bind_storage(ENCORE_BINDING_PATH_QUEUES);
  if (scene_.needs().shadows) buffers_->shadow_rays.bind_storage(ENCORE_BINDING_SHADOW_RAYS);
  if (!bounces()) return;
  buffers_->waiting.bind_storage(ENCORE_BINDING_WAITING_RAYS);
  scene_.bind_bounces();
}

/// Where the list of a kind begins; the camera's rays take the place of reflections.
int GpuPaths::list_place(int half, RayKind kind) const {
  const int list = 2 * half + (kind == RayKind::refraction ? 1 : 0);
  return ENCORE_QUEUE_WORDS + list * most_pixels_;
}

bool GpuPaths::draw(const Frame& frame, std::uint32_t scene_number, const std::string& doing) {
  figures_ = {};
  doing_ = doing;
  pace_salt_ = std::uint64_t{scene_number} << 32U;
  band_rows_ = rows_of_band(frame.width, frame.height);
  most_pixels_ = frame.width * band_rows_;
  reserve(static_cast<std::uint64_t>(most_pixels_));
  bool complete = true;
  for (int y = 0; y < frame.height && complete; y += band_rows_) {
    complete = draw_band(frame, {y, frame.width, std::min(band_rows_, frame.height - y)});
  }
  clock_.collect(figures_);
  return complete;
}

bool GpuPaths::draw_band(const Frame& frame, const Band& band) {
  for (std::uint32_t i = 0; i < frame.samples; ++i) {
    if (cancelled()) return false;
    clock_.begin(RayKind::camera);
    start(band, frame.first_sample + i, i == 0);
    clock_.end();
    if (!trace_sample(band)) return false;
  }
  finish_band(band, frame.samples);
  return true;
}

void GpuPaths::start(const Band& band, std::uint32_t sample, bool first) {
  bind();
  set_band(*start_, band.y, band.width, band.rows);
  start_->set("sample_number", sample);
  start_->set("seed", scene_.rays().seed);
  start_->set("first_sample", first ? 1 : 0);
  start_->set("queue_first", list_place(0, RayKind::camera));
  dispatch_pixels(*start_, band.width, band.rows);
}

bool GpuPaths::trace_sample(const Band& band) {
  List camera{RayKind::camera, list_place(0, RayKind::camera), band.pixels(), band.width};
  int half = 1;
  if (!follow(camera, half)) return false;
  while (bounces()) {
    std::array<std::uint32_t, 2> counts{};
    constexpr std::size_t kCounts = ENCORE_QUEUE_REFLECTIONS * sizeof(std::uint32_t);
    buffers_->queues.read(std::as_writable_bytes(std::span(counts)), kCounts);
    if (counts == std::array<std::uint32_t, 2>{}) break;
    constexpr std::array<std::uint32_t, 2> kNone{};
    buffers_->queues.write(std::as_bytes(std::span(kNone)), kCounts);
    for (const RayKind kind : {RayKind::reflection, RayKind::refraction}) {
      const std::uint32_t count = counts[kind == RayKind::refraction ? 1 : 0];
      const List list{kind, list_place(half, kind), static_cast<int>(count), kTraceGroupWidth};
      if (count > 0 && !follow(list, 1 - half)) return false;
    }
    half = 1 - half;
  }
  return true;
}

/// Traces the rays of a list, and makes those that follow.
bool GpuPaths::follow(const List& list, int next_half) {
  figures_[list.kind].rays += static_cast<std::uint64_t>(list.count);
  clock_.begin(list.kind);
  const bool traced =
      trace(TraceOutput::path_hits, list, paces_[static_cast<std::size_t>(list.kind)]);
  clock_.end();
  if (!traced) return false;
  if (scene_.needs().shadows && !add_lights(list)) return false;
  clock_.begin(list.kind);
  bind();
  if (bounces()) {
    scatter_->set("most_depth", static_cast<unsigned>(scene_.rays().depth));
    scatter_->set("next_reflections",
                  static_cast<unsigned>(list_place(next_half, RayKind::reflection)));
    scatter_->set("next_refractions",
                  static_cast<unsigned>(list_place(next_half, RayKind::refraction)));
  }
  run_pass(*scatter_, list);
  clock_.end();
  return true;
}

bool GpuPaths::trace(TraceOutput output, const List& list, PacedDispatch& pace) {
  launch_.begin(
      {.output = output, .width = list.width, .ray_count = list.count, .queue_first = list.first},
      output == TraceOutput::shadows ? trace_shadows_ : trace_);
  const int rows = (list.count + list.width - 1) / list.width;
  pace.run(
      launch_.pace_key(pace_salt_), list.width, rows,
      [&](const PixelRect& piece) { launch_.send(piece); }, doing_);
  barrier();
  return pace.complete();
}

/// Asks of each light whether it is in sight from where the rays of a list have hit.
bool GpuPaths::add_lights(const List& list) {
  constexpr std::size_t kPlace = ENCORE_QUEUE_SHADOWS * sizeof(std::uint32_t);
  for (std::uint32_t light = 0; light < scene_.light_count(); ++light) {
    if (cancelled()) return false;
    clock_.begin(RayKind::shadow);
    bind();
    std::uint32_t count = 0;
    buffers_->queues.write(std::as_bytes(std::span(&count, 1)), kPlace);
    light_->set("light_in_hand", light);
    run_pass(*light_, list);
    buffers_->queues.read(std::as_writable_bytes(std::span(&count, 1)), kPlace);
    const bool traced =
        count == 0 ||
        trace(TraceOutput::shadows, {RayKind::shadow, 0, static_cast<int>(count), kTraceGroupWidth},
              paces_[static_cast<std::size_t>(RayKind::shadow)]);
    clock_.end();
    if (!traced) return false;
    figures_[RayKind::shadow].rays += count;
  }
  return true;
}

void GpuPaths::run_pass(const gl::Program& program, const List& list) {
  program.set("queue_first", list.first);
  program.set("ray_count", list.count);
  program.use();
  glDispatchCompute(groups(list.count, kPathGroup), 1, 1);
  barrier();
}

void GpuPaths::finish_band(const Band& band, std::uint32_t samples) {
  clock_.begin(RayKind::camera);
  set_band(*finish_, band.y, band.width, band.rows);
  finish_->set("sample_count", static_cast<int>(samples));
  dispatch_pixels(*finish_, band.width, band.rows);
  clock_.end();
}

}  // namespace encore::renderer
