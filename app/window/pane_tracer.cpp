#include "app/window/pane_tracer.h"

#include "accel/build_watch.h"
#include "accel/make_structure.h"
#include "accel/update_policy.h"
#include "app/make_renderer.h"
#include "renderer/cpu_tracer.h"
#include "scene/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace encore::app {

using energy::Phase;
using scene::TriangleChange;

namespace {

/// Tells a structure of its watch for the time of a build.
class Watched {
 public:
  Watched(accel::AccelerationStructure& structure, accel::BuildWatch* watch)
      : structure_(structure) {
    structure_.set_build_watch(watch);
  }
  ~Watched() { structure_.set_build_watch(nullptr); }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

 private:
  accel::AccelerationStructure& structure_;
};

/// Whether a structure that was built for one spec serves the other.
bool same_build(accel::StructureSpec a, const accel::StructureSpec& b) {
  a.intersection = b.intersection;
  a.grouping = b.grouping;
  return a == b;
}

}  // namespace

void PaneTracer::clear() {
  renderer_.reset();
  tracer_ = nullptr;
  ready_ = false;
  structure_.reset();
  built_ = false;
  spec_.reset();
  scene_.reset();
  device_.reset();
  triangles_ = std::make_unique<scene::TriangleList>();
}

const accel::AccelerationStructure* PaneTracer::structure() const {
  return built_ ? structure_.get() : nullptr;
}

void PaneTracer::use_scene(const PaneRequest& request) {
  if (scene_ == request.scene) return;
  // The renderer holds pointers into all of these.
  renderer_.reset();
  tracer_ = nullptr;
  device_.reset();
  ready_ = false;
  structure_.reset();
  spec_.reset();
  built_ = false;
  triangles_ = std::make_unique<scene::TriangleList>();
  scene_ = request.scene;
  ++structure_serial_;
  ++content_serial_;
}

void PaneTracer::use_structure(const PaneRequest& request) {
  if (!traces_rays(*request.device)) {
    if (structure_) {
      renderer_.reset();
      tracer_ = nullptr;
      ready_ = false;
    }
    structure_.reset();
    spec_.reset();
    built_ = false;
    return;
  }
  if (structure_) structure_->set_build_threads(request.threads);
  if (structure_ && spec_ && *spec_ == request.structure) return;
  ready_ = false;
  if (structure_ && spec_ && same_build(*spec_, request.structure)) {
    structure_->set_intersection(request.structure.intersection);
    structure_->set_grouping(request.structure.grouping);
    spec_ = request.structure;
    ++content_serial_;
    return;
  }
  built_ = false;
  structure_ = accel::make_structure(request.structure);
  structure_->set_build_threads(request.threads);
  costs_ = accel::AutoPolicy(accel::auto_rule(request.structure.settings));
  spec_ = request.structure;
}

void PaneTracer::use_renderer(const PaneRequest& request) {
  const int threads = *request.device == Device::cpu ? request.threads : 0;
  if (renderer_ && device_ == request.device && threads_ == threads) {
    if (rays_ == request.rays) return;
    rays_ = request.rays;
    renderer_->set_rays(rays_);
    stale_ = true;
    ++content_serial_;
    return;
  }
  renderer_.reset();
  tracer_ = nullptr;
  ready_ = false;
  renderer_ = make_renderer(*request.device, threads, gpu_);
  rays_ = request.rays;
  renderer_->set_rays(rays_);
  tracer_ =
      traces_rays(*request.device) ? dynamic_cast<renderer::Tracer*>(renderer_.get()) : nullptr;
  device_ = request.device;
  threads_ = threads;
  software_ = uses_opengl(*request.device) && gpu_.get()->capabilities().software;
  ++content_serial_;
}

bool PaneTracer::must_build(const PaneRequest& request) const {
  if (!request.device || !traces_rays(*request.device)) return false;
  return scene_ != request.scene || !built_ || !spec_ || !same_build(*spec_, request.structure) ||
         rebuild_ != request.rebuild;
}

bool PaneTracer::fits_on_device(const PaneRequest& request) const {
  // Whoever looks at the nodes needs the host's.
  return request.policy == accel::Policy::refit && *request.device == Device::gpu && ready_ &&
         tracer_ != nullptr && structure_ && structure_->can_refit() && tracer_->can_refit() &&
         !request.nodes && !request.free && !request.pick;
}

bool PaneTracer::builds_on_device(const PaneRequest& request) const {
  // Whoever looks at the nodes needs the host's, and so does the device's renderer to begin with.
  return *request.device == Device::gpu && ready_ && built_ && tracer_ != nullptr &&
         tracer_->can_build() && !request.nodes && !request.free && !request.pick &&
         accel::place_of_build(request.build_on, request.structure, request.policy, software_) ==
             accel::BuildPlace::device;
}

void PaneTracer::build(const PaneRequest& request, energy::PhaseLog& log,
                       accel::BuildWatch* watch) {
  if (!builds_on_device(request)) return build_on_host(request, log, watch);
  build_on_device_ = true;
  built_over_ = triangles_->triangles.size();
  stale_ = true;
  ++build_serial_;
  ++content_serial_;
}

void PaneTracer::build_on_host(const PaneRequest& request, energy::PhaseLog& log,
                               accel::BuildWatch* watch) {
  built_ = false;
  fitted_on_device_ = false;
  built_on_device_ = false;
  build_on_device_ = false;
  {
    const Watched watched(*structure_, watch);
    const auto mark = log.mark(Phase::build);
    accel::carry_out(accel::UpdateAction::build, request.policy, *structure_,
                     triangles_->triangles);
  }
  built_ = true;
  built_over_ = triangles_->triangles.size();
  stale_ = true;
  ++build_serial_;
  ++structure_serial_;
  ++content_serial_;
}

void PaneTracer::update(const PaneRequest& request, energy::PhaseLog& log) {
  stale_ = true;
  ++content_serial_;
  if (fits_on_device(request)) {
    update_on_device_ = true;
    return;
  }
  // The host's may be of other triangles.
  if (built_on_device_) return build_on_host(request, log, nullptr);
  const auto mark = log.mark(Phase::update);
  accel::carry_out(accel::UpdateAction::update, request.policy, *structure_, triangles_->triangles);
  fitted_on_device_ = false;
  ++structure_serial_;
}

void PaneTracer::follow(TriangleChange change, const PaneRequest& request, energy::PhaseLog& log,
                        accel::BuildWatch* watch) {
  if (change != TriangleChange::none) {
    stale_ = true;
    ++content_serial_;
  }
  if (!structure_) return;
  const bool asked = rebuild_ != request.rebuild;
  rebuild_ = request.rebuild;
  if (!built_ || asked) {
    build(request, log, watch);
    return;
  }
  switch (accel::decide(request.policy, *structure_, change, costs_)) {
    case accel::UpdateAction::none:
      if (triangles_->triangles.size() != built_over_) {
        throw std::runtime_error(
            "the number of triangles changed, which policy static cannot "
            "follow; choose rebuild");
      }
      // The device is ahead of the host's structure, which now is looked at or sent anew.
      if (fitted_on_device_ && (!ready_ || request.nodes || request.free || request.pick)) {
        update(request, log);
      }
      break;
    case accel::UpdateAction::build:
      build(request, log, watch);
      break;
    case accel::UpdateAction::update:
      update(request, log);
      break;
  }
}

void PaneTracer::send(energy::PhaseLog& log) {
  uploaded_bytes_ = 0;
  if (ready_ && !stale_) return;
  const auto pass_on = [this] {
    if (ready_) {
      renderer_->refresh();
    } else {
      renderer_->init({scene_.get(), triangles_.get(), structure_.get()});
    }
  };
  if (renderer_->transfers()) {
    const auto mark = log.mark(Phase::transfer);
    pass_on();
  } else {
    pass_on();
  }
  ready_ = true;
  stale_ = false;
  uploaded_bytes_ = renderer_->last_transfer().uploaded_bytes;
  if (std::exchange(build_on_device_, false) && tracer_ != nullptr) {
    const auto mark = log.mark(Phase::build);
    fitted_on_device_ = true;
    built_on_device_ = true;
    ready_ = false;  // unless it fits
    tracer_->build();
    ready_ = true;
  }
  if (std::exchange(update_on_device_, false)) {
    const auto mark = log.mark(Phase::update);
    tracer_->refit();
    fitted_on_device_ = true;
  }
}

void PaneTracer::prepare(const PaneRequest& request, energy::PhaseLog& log,
                         accel::BuildWatch* watch) {
  const std::size_t marks = log.spans().size();
  policy_ = request.policy;
  use_scene(request);
  use_structure(request);
  weigh(request);
  use_renderer(request);
  TriangleChange change = TriangleChange::none;
  if (triangles_->version == 0 || time_s_ != request.time_s) {
    if (scene_->animated() && triangles_->version != 0) {
      const auto mark = log.mark(Phase::animate);
      change = scene::update_triangles(*scene_, request.time_s, *triangles_);
    } else {
      change = scene::update_triangles(*scene_, request.time_s, *triangles_);
    }
    time_s_ = request.time_s;
  }
  follow(change, request, log, watch);
  send(log);
  learn(log, marks);
}

void PaneTracer::follow_forced(const PaneRequest& request, energy::PhaseLog& log) {
  if (!structure_) return;
  const std::size_t marks = log.spans().size();
  policy_ = request.policy;
  if (accel::decide(request.policy, *structure_, TriangleChange::moved, costs_) ==
      accel::UpdateAction::update) {
    update(request, log);
  } else if (request.policy != accel::Policy::fixed) {
    build(request, log, nullptr);
  }
  send(log);
  learn(log, marks);
}

void PaneTracer::weigh(const PaneRequest& request) {
  energy::PerPhase<double> weights;
  weights.fill(1.0);
  if (request.phase_watts) weights = *request.phase_watts;
  if (weights == weights_) return;
  weights_ = weights;
  // Costs in another unit say nothing any more.
  if (spec_) costs_ = accel::AutoPolicy(accel::auto_rule(spec_->settings));
}

void PaneTracer::learn(const energy::PhaseLog& log, std::size_t before) {
  if (!structure_ || policy_ != accel::Policy::automatic) return;
  energy::PerPhase<double> cost{};
  energy::PerPhase<bool> done{};
  for (const energy::PhaseSpan& span : log.spans().subspan(before)) {
    cost[span.phase] += weights_[span.phase] * (span.end - span.start).value;
    done[span.phase] = true;
  }
  if (done[Phase::build]) costs_.observe_build(cost[Phase::build] + cost[Phase::transfer]);
  if (done[Phase::update]) costs_.observe_update(cost[Phase::update] + cost[Phase::transfer]);
}

void PaneTracer::learn_frame(double render_s) {
  if (!structure_ || policy_ != accel::Policy::automatic) return;
  costs_.observe_frame(weights_[Phase::render] * render_s, structure_->assessed_cost());
}

std::optional<double> PaneTracer::break_even_frames() const {
  if (!built_ || policy_ != accel::Policy::automatic) return std::nullopt;
  return costs_.break_even_frames();
}

bool PaneTracer::draw(const scene::Camera& camera, int width, int height, energy::PhaseLog& log,
                      const std::atomic<bool>* cancel, std::optional<SampleRange> samples) {
  renderer_->set_cancel_flag(cancel);
  {
    const auto mark = log.mark(Phase::render);
    if (samples) {
      renderer_->draw_samples(camera, width, height, samples->first, samples->count);
    } else {
      renderer_->draw(camera, width, height);
    }
  }
  renderer_->set_cancel_flag(nullptr);
  return renderer_->complete();
}

bool PaneTracer::plain() const {
  return !tracer_ || !scene_ || !scene::needs_of(*scene_, *triangles_, rays_).paths();
}

int PaneTracer::samples() const {
  return tracer_ != nullptr ? std::max(rays_.samples, 1) : 1;
}

std::string PaneTracer::device_text() const {
  if (!renderer_) return {};
  const std::string name = renderer_->device_name();
  if (!name.empty()) return name;
  const auto* cpu = dynamic_cast<const renderer::CpuTracer*>(renderer_.get());
  const int threads = cpu != nullptr ? cpu->threads() : 1;
  return fmt::format("CPU, {} thread{}", threads, threads == 1 ? "" : "s");
}

std::uint64_t PaneTracer::memory_bytes() const {
  std::uint64_t bytes = triangles_->triangles.capacity() * sizeof(scene::Triangle) +
                        (triangles_->normals.capacity() + triangles_->colors.capacity()) *
                            sizeof(triangles_->normals[0]) +
                        triangles_->texcoords.capacity() * sizeof(triangles_->texcoords[0]);
  if (built_) bytes += structure_->stats().bytes;
  return bytes;
}

}  // namespace encore::app
