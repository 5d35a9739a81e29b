#include "app/workload_frames.h"

#include "renderer/camera_rays.h"

#include <algorithm>
#include <stdexcept>

namespace encore::app {

namespace {

using accel::Policy;
using energy::Phase;
using scene::FrameSequence;
using scene::TriangleChange;

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

}  // namespace

double frame_step_s(const scene::Scene& scene) {
  constexpr double kStep = 1.0 / 30.0;
  double rate = 0.0;
  for (const scene::Instance& instance : scene.instances) {
    if (std::holds_alternative<std::monostate>(instance.motion)) continue;
    const auto* sequence = std::get_if<FrameSequence>(&instance.motion);
    if (sequence == nullptr) return kStep;
    rate = std::max(rate, static_cast<double>(sequence->frames_per_second));
  }
  return rate > 0 ? 1.0 / rate : kStep;
}

bool changes_triangle_count(const scene::Scene& scene) {
  for (const scene::Instance& instance : scene.instances) {
    const auto* sequence = std::get_if<FrameSequence>(&instance.motion);
    if (sequence == nullptr || sequence->frames.empty()) continue;
    const std::size_t first = sequence->frames.front()->mesh.triangles.size();
    for (const auto& frame : sequence->frames) {
      if (frame->mesh.triangles.size() != first) return true;
    }
  }
  return false;
}

FrameWorkload::FrameWorkload(WorkloadSpec spec, const WorkloadTools& tools)
    : SceneWorkload(std::move(spec), tools), renderer_(tools.make_renderer(spec_.threads)) {}

SceneWorkload::RayFigures FrameWorkload::ray_figures() const {
  return {static_cast<double>(spec_.size.width) * spec_.size.height,
          static_cast<double>(count_hits(*structure_, spec_.scene->camera, spec_.size))};
}

void FrameWorkload::init_renderer() {
  renderer_->init({spec_.scene.get(), &triangles_, structure_.get()});
}

void FrameWorkload::render(energy::PhaseLog& log) {
  const auto mark = log.mark(Phase::render);
  renderer_->draw(spec_.scene->camera, spec_.size.width, spec_.size.height);
}

void StaticWorkload::prepare() {
  go_to(0.0);
  build();
  check("build");
  init_renderer();
}

DynamicWorkload::DynamicWorkload(WorkloadSpec spec, const WorkloadTools& tools)
    : FrameWorkload(std::move(spec), tools), step_s_(frame_step_s(*spec_.scene)) {}

double DynamicWorkload::time_of(std::uint64_t frame) const {
  // The middle of the step: rounding cannot move it over the border of a sequence's frame.
  return (static_cast<double>(frame) + 0.5) * step_s_;
}

DynamicWorkload::Reaction DynamicWorkload::reaction(TriangleChange change) const {
  if (change == TriangleChange::none || spec_.policy == Policy::fixed) return Reaction::nothing;
  const bool refits = spec_.policy == Policy::refit && structure_->can_refit();
  return refits && change == TriangleChange::moved ? Reaction::update : Reaction::build;
}

void DynamicWorkload::start() {
  frame_ = 0;
  go_to(time_of(0));
  build();
  built_over_ = triangles_.triangles.size();
}

void DynamicWorkload::prepare() {
  start();
  check("build");

  // A structure that follows the motion must still be right after a good part of the loop.
  if (spec_.policy != Policy::fixed) {
    const TriangleChange change = go_to(time_of(0) + 0.37 * spec_.scene->duration_s());
    switch (reaction(change)) {
      case Reaction::nothing:
        break;
      case Reaction::build:
        build();
        check("rebuild");
        break;
      case Reaction::update:
        update();
        check("update");
        break;
    }
    start();
  }
  init_renderer();
}

void DynamicWorkload::build_marked(energy::PhaseLog& log) {
  const auto mark = log.mark(Phase::build);
  build();
}

void DynamicWorkload::update_marked(energy::PhaseLog& log) {
  const auto mark = log.mark(Phase::update);
  update();
}

void DynamicWorkload::advance(energy::PhaseLog& log) {
  ++frame_;
  TriangleChange change = TriangleChange::none;
  {
    const auto mark = log.mark(Phase::animate);
    change = go_to(time_of(frame_));
  }
  const Reaction what = reaction(change);
  if (what == Reaction::build) build_marked(log);
  if (what == Reaction::update) update_marked(log);
  // A structure left alone refers to triangles by place, so there must still be as many.
  if (what == Reaction::build) built_over_ = triangles_.triangles.size();
  if (triangles_.triangles.size() != built_over_) {
    throw std::runtime_error("the triangle count of scene " + spec_.scene->name +
                             " changed, which policy static cannot follow; use rebuild");
  }
  if (change != TriangleChange::none) renderer_->refresh();
}

void DynamicWorkload::operation(energy::PhaseLog& log) {
  advance(log);
  render(log);
}

std::vector<Phase> DynamicWorkload::separable() const {
  std::vector<Phase> phases{Phase::animate, Phase::render};
  if (spec_.policy != Policy::fixed) {
    const bool refits = spec_.policy == Policy::refit && structure_->can_refit();
    phases.insert(phases.begin() + 1, refits ? Phase::update : Phase::build);
  }
  return phases;
}

void DynamicWorkload::run_alone(Phase phase, energy::PhaseLog& log) {
  switch (phase) {
    case Phase::animate:
      advance(log);
      return;
    case Phase::build:
      build_marked(log);
      renderer_->refresh();
      return;
    case Phase::update:
      update_marked(log);
      renderer_->refresh();
      return;
    case Phase::render:
      render(log);
      return;
    case Phase::transfer:
      return;
  }
}

bool ForcedWorkload::updates() const {
  return spec_.policy == Policy::refit && structure_->can_refit();
}

void ForcedWorkload::prepare() {
  go_to(0.0);
  build();
  check("build");
  if (updates()) {
    update();
    check("update");
  }
  init_renderer();
}

void ForcedWorkload::follow(energy::PhaseLog& log) {
  if (updates()) {
    const auto mark = log.mark(Phase::update);
    update();
  } else {
    const auto mark = log.mark(Phase::build);
    build();
  }
  renderer_->refresh();
}

void ForcedWorkload::operation(energy::PhaseLog& log) {
  follow(log);
  render(log);
}

std::vector<Phase> ForcedWorkload::separable() const {
  return {updates() ? Phase::update : Phase::build, Phase::render};
}

void ForcedWorkload::run_alone(Phase phase, energy::PhaseLog& log) {
  if (phase == Phase::render) {
    render(log);
  } else {
    follow(log);
  }
}

}  // namespace encore::app
