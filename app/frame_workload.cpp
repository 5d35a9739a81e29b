#include "app/hit_difference.h"
#include "app/workload_frames.h"
#include "renderer/camera_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace encore::app {

namespace {

using energy::Phase;

/// Hits of the camera rays of a picture, row by row.
std::uint64_t count_hits(const accel::AccelerationStructure& structure, const scene::Camera& camera,
                         ImageSize size) {
  const auto frame = renderer::make_camera_frame(camera, size.width, size.height);
  std::vector<scene::Ray> rays(static_cast<std::size_t>(size.width));
  std::vector<scene::Hit> hits(rays.size());
  std::uint64_t found = 0;
  for (int y = 0; y < size.height; ++y) {
    renderer::camera_rays(frame, {0, y, size.width, y + 1}, rays);
    structure.intersect(rays, hits);
    found += static_cast<std::uint64_t>(
        std::count_if(hits.begin(), hits.end(), [](const scene::Hit& hit) { return hit.found(); }));
  }
  return found;
}

std::uint64_t count_hits(renderer::Tracer& tracer, const scene::Camera& camera, ImageSize size) {
  std::vector<scene::Hit> hits;
  tracer.trace_hits(camera, size.width, size.height, hits);
  return static_cast<std::uint64_t>(
      std::count_if(hits.begin(), hits.end(), [](const scene::Hit& hit) { return hit.found(); }));
}

}  // namespace

FrameWorkload::FrameWorkload(WorkloadSpec spec, const WorkloadTools& tools)
    : SceneWorkload(std::move(spec), tools),
      renderer_(tools.make_renderer(spec_.device, spec_.threads)) {
  if (spec_.device == Device::cpu || !traces_rays(spec_.device)) return;
  tracer_ = dynamic_cast<renderer::Tracer*>(renderer_.get());
  if (tracer_ == nullptr) {
    throw std::logic_error(
        fmt::format("the renderer of device {} traces no rays", to_string(spec_.device)));
  }
}

void FrameWorkload::operation(energy::PhaseLog& log) {
  counting_ = true;
  frame(log);
  counting_ = false;
  totals_.operations += 1.0;
}

void FrameWorkload::init_renderer() {
  renderer_->set_rays(spec_.rays);
  renderer_->init({spec_.scene.get(), &triangles_, structure_.get()});
}

void FrameWorkload::render(energy::PhaseLog& log) {
  {
    const auto mark = log.mark(Phase::render);
    renderer_->draw(spec_.scene->camera, spec_.size.width, spec_.size.height);
  }
  if (!counting_) return;
  ++totals_.draws;
  count_rays();
  if (!transfers()) return;
  const std::optional<double> seconds = renderer_->last_draw_s();
  totals_.draws_timed = totals_.draws_timed && seconds.has_value();
  totals_.render_s += seconds.value_or(0.0);
}

void FrameWorkload::count_rays() {
  const auto rays = renderer_->last_rays();
  totals_.rays_known = totals_.rays_known && rays.has_value();
  if (!rays) return;
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    const renderer::RayFigures::Kind& kind = rays->kinds[i];
    totals_.rays[i] += static_cast<double>(kind.rays);
    totals_.ray_s[i] += kind.seconds.value_or(0.0);
    totals_.rays_timed = totals_.rays_timed && (kind.rays == 0 || kind.seconds.has_value());
  }
}

void FrameWorkload::send(energy::PhaseLog& log) {
  if (!transfers()) {
    renderer_->refresh();
    return;
  }
  {
    const auto mark = log.mark(Phase::transfer);
    renderer_->refresh();
  }
  if (!counting_) return;
  const renderer::Transfer sent = renderer_->last_transfer();
  totals_.uploaded_bytes += static_cast<double>(sent.uploaded_bytes);
  totals_.converted_bytes += static_cast<double>(sent.converted_bytes);
  ++totals_.transfers;
  totals_.transfers_timed = totals_.transfers_timed && sent.device_s.has_value();
  totals_.transfer_s += sent.device_s.value_or(0.0);
}

void FrameWorkload::build_marked(energy::PhaseLog& log) {
  const auto mark = log.mark(Phase::build);
  if (built_on_device()) {
    tracer_->build();
  } else {
    build();
  }
}

void FrameWorkload::update_marked(energy::PhaseLog& log) {
  const auto mark = log.mark(Phase::update);
  if (fitting() == Fitting::device) {
    tracer_->refit();
  } else {
    update();
  }
}

FrameWorkload::Fitting FrameWorkload::fitting() const {
  if (!structure_ || !accel::updates(spec_.policy, *structure_)) return Fitting::none;
  const bool own = tracer_ != nullptr && tracer_->can_refit();
  return own && spec_.policy == accel::Policy::refit ? Fitting::device : Fitting::host;
}

bool FrameWorkload::built_on_device() const {
  return spec_.build_on == accel::BuildPlace::device && tracer_ != nullptr &&
         spec_.test != TestKind::fixed && tracer_->can_build();
}

void FrameWorkload::resend_unmarked() {
  renderer_->refresh();
  if (built_on_device()) tracer_->build();
}

void FrameWorkload::fit_unmarked() {
  if (fitting() == Fitting::device) {
    renderer_->refresh();
    tracer_->refit();
  } else {
    update();
    renderer_->refresh();
  }
}

accel::HitComparison FrameWorkload::compare(const accel::AccelerationStructure& truth,
                                            std::span<const scene::Ray> rays) const {
  if (tracer_ == nullptr) return SceneWorkload::compare(truth, rays);
  std::vector<scene::Hit> expected(rays.size());
  std::vector<scene::Hit> found(rays.size());
  truth.intersect(rays, expected);
  tracer_->trace_rays(rays, found);
  accel::HitComparison comparison;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool same = std::memcmp(&expected[i], &found[i], sizeof(scene::Hit)) == 0;
    // One that rounds otherwise is not wrong; 'encore verify' tells how often that is.
    if (!same && comparison.mismatches() == 0 &&
        explain_difference(triangles_.triangles, rays[i], expected[i], found[i]).explanation !=
            Explanation::none) {
      comparison.add(rays[i], expected[i], expected[i], true);
    } else {
      comparison.add(rays[i], expected[i], found[i], same);
    }
  }
  return comparison;
}

std::string FrameWorkload::traced_name() const {
  std::string name = SceneWorkload::traced_name();
  if (tracer_ != nullptr) {
    name += fmt::format(" on device {} ({})", to_string(spec_.device), renderer_->device_name());
  }
  return name;
}

SceneWorkload::RayFigures FrameWorkload::ray_figures() const {
  if (!structure_) return {{}, {}, true, {}};
  const scene::Camera& camera = spec_.scene->camera;
  // A device's hits are its own: the host's structure may be of an earlier time.
  const std::uint64_t hits = tracer_ != nullptr ? count_hits(*tracer_, camera, spec_.size)
                                                : count_hits(*structure_, camera, spec_.size);
  RayFigures figures{static_cast<double>(spec_.size.width) * spec_.size.height,
                     static_cast<double>(hits), true};
  if (!totals_.rays_known || totals_.draws == 0) return figures;
  double all = 0.0;
  double all_s = 0.0;
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    all += totals_.rays[i];
    all_s += totals_.ray_s[i];
  }
  const auto draws = static_cast<double>(totals_.draws);
  figures.rays = all / draws;
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    figures.kinds[i].rays = totals_.rays[i] / draws;
    const bool timed = totals_.rays_timed && all_s > 0.0;
    if (timed) figures.kinds[i].share = totals_.ray_s[i] / all_s;
    // One kind alone took all of the time, whoever measured it.
    if (!timed && totals_.rays[i] == all) figures.kinds[i].share = 1.0;
  }
  return figures;
}

SceneWorkload::DeviceFigures FrameWorkload::device_figures() const {
  if (!transfers() || !(totals_.operations > 0.0)) return {};
  DeviceFigures figures;
  figures.uploaded_bytes = totals_.uploaded_bytes / totals_.operations;
  figures.converted_bytes = totals_.converted_bytes / totals_.operations;
  if (totals_.transfers > 0) {
    figures.transfer_unknown = !totals_.transfers_timed;
    if (totals_.transfers_timed) figures.transfer_s = totals_.transfer_s / totals_.operations;
  }
  if (totals_.draws > 0 && transfers()) {
    figures.render_unknown = !totals_.draws_timed;
    if (totals_.draws_timed) figures.render_s = totals_.render_s / totals_.operations;
  }
  return figures;
}

}  // namespace encore::app
