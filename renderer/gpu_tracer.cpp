#include "renderer/gpu_tracer.h"

#include "renderer/camera_rays.h"
#include "renderer/gl/error.h"
#include "shaders/shared/bindings.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace encore::renderer {

namespace {

// What the shaders write is what the host's types hold.
static_assert(sizeof(scene::Hit) == sizeof(gpu::Hit) &&
              offsetof(scene::Hit, triangle) == offsetof(gpu::Hit, triangle) &&
              offsetof(scene::Hit, v) == offsetof(gpu::Hit, v));
static_assert(sizeof(scene::Ray) == sizeof(gpu::Ray) &&
              offsetof(scene::Ray, t_min) == offsetof(gpu::Ray, t_min) &&
              offsetof(scene::Ray, direction) == offsetof(gpu::Ray, direction) &&
              offsetof(scene::Ray, t_max) == offsetof(gpu::Ray, t_max));
static_assert(sizeof(accel::TraceCounters) == 3 * sizeof(std::uint32_t));

constexpr std::uint64_t kAnySize = std::numeric_limits<std::uint64_t>::max();

// Results are fetched in parts, so that big pictures need no big buffers.
constexpr std::size_t kMostResultBytes = std::size_t{16} << 20;

// Rays from a buffer are traced as a picture of rows this long.
constexpr int kRaysPerRow = 4096;
constexpr std::size_t kRaysPerBatch = std::size_t{256} << 10;

gpu::CameraParameters to_gpu(const CameraFrame& frame) {
  gpu::CameraParameters camera{};
  camera.forward = frame.forward;
  camera.center_x = frame.center_x;
  camera.right = frame.right;
  camera.center_y = frame.center_y;
  camera.up = frame.up;
  camera.origin = frame.origin;
  camera.orthographic = frame.orthographic ? 1 : 0;
  return camera;
}

std::uint32_t groups(int pixels, int group) {
  return static_cast<std::uint32_t>((pixels + group - 1) / group);
}

void check_size(const gl::Capabilities& device, int width, int height) {
  const auto rays = std::int64_t{width} * height;
  if (groups(width, kTraceGroupWidth) > device.workgroups[0] ||
      groups(height, kTraceGroupHeight) > device.workgroups[1] ||
      rays > std::numeric_limits<int>::max()) {
    throw gl::GlError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels has more than this device can be asked for at once (at most " +
                      std::to_string(std::int64_t{device.workgroups[0]} * kTraceGroupWidth) +
                      " x " +
                      std::to_string(std::int64_t{device.workgroups[1]} * kTraceGroupHeight) +
                      ", and 2147483647 in all); draw a smaller one or use --device cpu");
  }
}

void check_samples(std::uint32_t first, std::uint32_t count, std::uint32_t samples) {
  if (count > 0 && first < samples && count <= samples - first) return;
  throw std::invalid_argument(std::to_string(count) + " samples from number " +
                              std::to_string(first) + " on were asked for of a picture that has " +
                              std::to_string(samples) +
                              " a pixel; ask for at least one of those, counted from 0");
}

/// Storage buffers that the largest program sees at once where surfaces wear textures, and where
/// they are bound; without textures require_compute() has asked for enough.
void check_textures_fit(const gl::Capabilities& device) {
  const int blocks = device.software ? 13 : 11;
  constexpr int kBindings = ENCORE_BINDING_TEXTURES + 1;
  if (device.compute_storage_blocks >= blocks && device.storage_bindings >= kBindings) return;
  throw gl::GlError("textures take " + std::to_string(blocks) + " storage buffers at " +
                    std::to_string(kBindings) + " binding points; " + device.device_name() +
                    " offers " + std::to_string(device.compute_storage_blocks) + " at " +
                    std::to_string(device.storage_bindings) +
                    "; draw without textures or use --device cpu");
}

/// Rows of a part of the results: whole rows of work groups, where there is room for one.
int rows_of_band(int width, std::size_t bytes_per_ray) {
  const std::size_t row_bytes = static_cast<std::size_t>(width) * bytes_per_ray;
  const auto rows = static_cast<int>(
      std::clamp<std::size_t>(kMostResultBytes / row_bytes, 1, std::size_t{1} << 20));
  return rows < kTraceGroupHeight ? rows : rows / kTraceGroupHeight * kTraceGroupHeight;
}

}  // namespace

GpuTracer::GpuTracer(std::shared_ptr<gl::Context> context)
    : context_(gl::made_current(std::move(context))),
      scene_(context_, true),
      launch_(context_),
      paths_(context_, scene_, launch_),
      timer_(context_->capabilities().timestamp_bits) {}

GpuTracer::~GpuTracer() {
  try {
    context_->make_current();  // the members' memory is this context's
  } catch (const gl::GlError&) {
    // It went with the context.
  }
}

void GpuTracer::init(const RenderInput& input) {
  ready_ = false;
  kind_.reset();
  if (input.scene == nullptr || input.triangles == nullptr || input.structure == nullptr) {
    throw std::invalid_argument("the GPU tracer needs a scene, its triangles and a structure");
  }
  const std::string name(input.structure->name());
  const auto kind = accel::parse_structure_kind(name);
  if (!kind || !has_gpu_traversal(*kind)) {
    throw std::invalid_argument("structure " + name +
                                " has no GPU traversal; use --device cpu or another structure");
  }
  context_->make_current();
  gl::require_compute(context_->capabilities());
  refit_.reset();
  wide_refit_.reset();
  built_for_.reset();
  ++scenes_;
  doing_ = "tracing rays through " + name;
  transfer_ = scene_.upload_all(input);
  kind_ = kind;
  prepare_to_draw();
}

void GpuTracer::refresh() {
  if (!kind_) throw std::logic_error("the GPU tracer was not given a scene");
  ready_ = false;
  context_->make_current();
  transfer_ = scene_.upload_changes();
  if (built_for_ && built_for_ != sent()) built_for_.reset();
  prepare_to_draw();
}

void GpuTracer::prepare_to_draw() {
  if (scene_.needs().textures) check_textures_fit(context_->capabilities());
  // What the device has built are nodes like those of bvh-median.
  launch_.set_scene({.kind = built_for_ ? accel::StructureKind::bvh_median : *kind_,
                     .depth = built_for_ ? build_->most_depth() : scene_.structure().depth,
                     .needs = scene_.shading(),
                     .lights = scene_.light_count() > 0,
                     .intersection = scene_.input().structure->intersection()});
  picture_program_.reset();
  paths_.prepare();
  if (!scene_.needs().paths()) picture_program_ = launch_.program(TraceOutput::picture);
  context_->check("preparing to draw");
  ready_ = true;
}

void GpuTracer::bind_scene() const {
  scene_.bind();
  if (built_for_) build_->bind();
}

void GpuTracer::check_ready() const {
  if (!kind_) throw std::logic_error("the GPU tracer was not given a scene");
  if (!ready_) throw std::logic_error("the last refresh of the GPU tracer failed");
}

std::uint64_t GpuTracer::pace_key(int height) const {
  return launch_.pace_key((std::uint64_t{scenes_} << 32U) | static_cast<std::uint32_t>(height));
}

/// Everything that rays of the camera need; says what is wrong before anything else is done.
void GpuTracer::send_camera(const scene::Camera& camera, int width, int height) {
  check_ready();
  context_->make_current();
  gpu::CameraParameters parameters = to_gpu(make_camera_frame(camera, width, height));
  check_size(context_->capabilities(), width, height);
  parameters.background = scene_.input().scene->background;
  parameters.light_count = scene_.light_count();
  parameters.material_count = scene_.material_count();
  camera_.reserve(sizeof parameters, kAnySize);
  camera_.write(std::as_bytes(std::span(&parameters, 1)));
  camera_.bind_uniform(ENCORE_BINDING_CAMERA);
}

void GpuTracer::draw(const scene::Camera& camera, int width, int height) {
  draw_samples(camera, width, height, 0, static_cast<std::uint32_t>(scene_.rays().samples));
}

void GpuTracer::draw_samples(const scene::Camera& camera, int width, int height,
                             std::uint32_t first, std::uint32_t count) {
  send_camera(camera, width, height);
  check_samples(first, count, static_cast<std::uint32_t>(scene_.rays().samples));
  picture_.resize(width, height, context_->capabilities().texture_size);
  bind_scene();
  picture_.bind();
  rays_drawn_.reset();
  timer_.begin();
  if (scene_.needs().paths()) {
    complete_ = paths_.draw({width, height, first, count}, scenes_, doing_);
    timer_.end();
    gl::finish(doing_);
    rays_drawn_ = paths_.figures();
  } else {
    draw_plain(width, height);
  }
  draw_s_ = complete_ ? timer_.seconds() : std::nullopt;
  if (picture_program_ && complete_) {
    rays_drawn_.emplace();
    (*rays_drawn_)[scene::RayKind::camera] = {PixelRect{0, 0, width, height}.count(), draw_s_};
  }
  // Whoever shows or fetches the picture sees all of it.
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  context_->check(doing_);
}

void GpuTracer::draw_plain(int width, int height) {
  launch_.begin({.output = TraceOutput::picture, .width = width}, picture_program_);
  frames_.run(
      pace_key(height), width, height,
      [&](const PixelRect& piece) {
        launch_.send(piece);
        if (piece.y1 == height) timer_.end();
      },
      doing_);
  complete_ = frames_.complete();
}

void GpuTracer::read(Image& image) {
  context_->make_current();
  picture_.read(image);
  context_->check("fetching the picture");
}

std::string GpuTracer::device_name() const {
  return context_->capabilities().device_name();
}

const accel::Bvh* GpuTracer::hierarchy() const {
  return kind_ ? dynamic_cast<const accel::Bvh*>(scene_.input().structure) : nullptr;
}

const accel::WideBvh* GpuTracer::wide_hierarchy() const {
  return kind_ ? dynamic_cast<const accel::WideBvh*>(scene_.input().structure) : nullptr;
}

bool GpuTracer::can_refit() const {
  return hierarchy() != nullptr || wide_hierarchy() != nullptr;
}

void GpuTracer::refit() {
  if (!can_refit()) return Tracer::refit();
  check_ready();
  context_->make_current();
  if (built_for_) {
    build_->fit(scene_.triangles());
  } else {
    fit_host_nodes();
  }
  gl::finish("refitting the structure");
  context_->check("refitting the structure");
}

void GpuTracer::fit_host_nodes() {
  if (scene_.structure_version() != scene_.input().structure->version()) {
    throw std::logic_error("the structure has changed since it was sent: refresh() before refit()");
  }
  const std::size_t triangles = scene_.triangle_count();
  const accel::Bvh* bvh = hierarchy();
  const accel::WideBvh* wide = wide_hierarchy();
  if (bvh != nullptr ? bvh->nodes().size() != (triangles == 0 ? 0 : 2 * triangles - 1)
                     : wide->tree().triangles != triangles) {
    throw std::logic_error("the structure is of another number of triangles: build it anew");
  }
  if (bvh != nullptr) {
    if (!refit_) refit_ = std::make_unique<GpuRefit>(context_, *bvh);
    refit_->run(*scene_.nodes(), scene_.triangles());
  } else {
    if (!wide_refit_) wide_refit_ = std::make_unique<GpuWideRefit>(context_, *wide);
    wide_refit_->run(*scene_.nodes(), *scene_.references(), scene_.triangles());
  }
}

GpuTracer::BuiltFor GpuTracer::sent() const {
  return {scene_.structure_version(), scene_.input().triangles->topology_version};
}

bool GpuTracer::can_build() const {
  const accel::WideBvh* wide = wide_hierarchy();
  return wide != nullptr && wide->settings().preset == accel::BuildPreset::fast;
}

void GpuTracer::build() {
  if (!can_build()) return Tracer::build();
  check_ready();
  context_->make_current();
  if (!build_) build_ = std::make_unique<GpuBuild>(context_);
  built_for_.reset();
  ready_ = false;  // unless it fits
  build_->run(scene_.triangles(), scene_.triangle_count());
  gl::finish("building the structure");
  context_->check("building the structure");
  built_for_ = sent();
  prepare_to_draw();
}

void GpuTracer::trace_bands(TraceOutput output, int width, int height,
                            std::span<std::byte> results) {
  const int binding =
      output == TraceOutput::counters ? ENCORE_BINDING_COUNTERS : ENCORE_BINDING_HITS;
  const std::size_t rays = PixelRect{0, 0, width, height}.count();
  const std::size_t bytes_per_ray = results.size() / rays;
  const auto used = launch_.program(output);
  const int band_rows = std::min(rows_of_band(width, bytes_per_ray), height);
  const std::size_t band_bytes = PixelRect{0, 0, width, band_rows}.count() * bytes_per_ray;
  bind_scene();
  results_.reserve(band_bytes, context_->capabilities().storage_block_bytes);
  results_.bind_storage(binding);
  complete_ = true;
  for (int y = 0; y < height && complete_; y += band_rows) {
    launch_.begin({.output = output, .width = width, .first_index = y * width}, used);
    batches_.run(
        pace_key(height), width, std::min(band_rows, height - y),
        [&](const PixelRect& piece) {
          launch_.send({piece.x0, piece.y0 + y, piece.x1, piece.y1 + y});
        },
        doing_);
    complete_ = batches_.complete();
    const std::size_t first =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * bytes_per_ray;
    results_.read(results.subspan(first, std::min(band_bytes, results.size() - first)));
  }
  context_->check(doing_);
}

void GpuTracer::trace_hits(const scene::Camera& camera, int width, int height,
                           std::vector<scene::Hit>& hits) {
  send_camera(camera, width, height);
  hits.resize(PixelRect{0, 0, width, height}.count());
  trace_bands(TraceOutput::hits, width, height, std::as_writable_bytes(std::span(hits)));
}

void GpuTracer::trace_counters(const scene::Camera& camera, int width, int height,
                               std::vector<accel::TraceCounters>& counters) {
  send_camera(camera, width, height);
  counters.resize(PixelRect{0, 0, width, height}.count());
  trace_bands(TraceOutput::counters, width, height, std::as_writable_bytes(std::span(counters)));
}

void GpuTracer::trace_rays(std::span<const scene::Ray> rays, std::span<scene::Hit> hits) {
  check_ready();
  if (rays.size() != hits.size()) {
    throw std::invalid_argument("there must be as many hits as rays");
  }
  if (rays.empty()) return;
  context_->make_current();
  const auto used = launch_.program(TraceOutput::ray_hits);
  const std::uint64_t most = context_->capabilities().storage_block_bytes;
  const std::size_t most_rays = std::min(rays.size(), kRaysPerBatch);
  const int width = static_cast<int>(std::min<std::size_t>(rays.size(), kRaysPerRow));
  rays_.reserve(most_rays * sizeof(scene::Ray), most);
  results_.reserve(most_rays * sizeof(scene::Hit), most);
  bind_scene();
  rays_.bind_storage(ENCORE_BINDING_RAYS);
  results_.bind_storage(ENCORE_BINDING_HITS);
  complete_ = true;
  for (std::size_t first = 0; first < rays.size() && complete_; first += kRaysPerBatch) {
    const std::size_t count = std::min(kRaysPerBatch, rays.size() - first);
    rays_.write(std::as_bytes(rays.subspan(first, count)));
    launch_.begin(
        {.output = TraceOutput::ray_hits, .width = width, .ray_count = static_cast<int>(count)},
        used);
    const int rows = (static_cast<int>(count) + width - 1) / width;
    batches_.run(
        pace_key(0), width, rows, [&](const PixelRect& piece) { launch_.send(piece); }, doing_);
    complete_ = batches_.complete();
    results_.read(std::as_writable_bytes(hits.subspan(first, count)));
  }
  context_->check(doing_);
}

void GpuTracer::set_cancel_flag(const std::atomic<bool>* flag) {
  frames_.set_cancel_flag(flag);
  batches_.set_cancel_flag(flag);
  paths_.set_cancel_flag(flag);
}

bool GpuTracer::complete() const {
  return complete_;
}

}  // namespace encore::renderer
