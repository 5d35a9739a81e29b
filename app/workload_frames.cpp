#include "app/workload_frames.h"

#include "energy/clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace encore::app {

using accel::Policy;
using accel::UpdateAction;
using energy::Phase;
using scene::FrameSequence;
using scene::TriangleChange;

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

void StaticWorkload::prepare() {
  go_to(0.0);
  if (structure_) build();
  init_renderer();
  check("build");
}

void DeviceUpdateWorkload::prepare() {
  go_to(0.0);
  build();
  init_renderer();
  if (built_on_device()) {
    resend_unmarked();
    check("build");
    return;
  }
  check("build");
  if (fitting() != Fitting::device) {
    throw std::runtime_error(
        fmt::format("{} cannot be updated on device {}; measure test build on device cpu",
                    structure_->name(), to_string(spec_.device)));
  }
  fit_unmarked();
  check("update");
}

void DeviceUpdateWorkload::frame(energy::PhaseLog& log) {
  if (built_on_device()) {
    build_marked(log);
  } else {
    update_marked(log);
  }
}

DynamicWorkload::DynamicWorkload(WorkloadSpec spec, const WorkloadTools& tools)
    : FrameWorkload(std::move(spec), tools),
      step_s_(frame_step_s(*spec_.scene)),
      auto_(accel::auto_rule(spec_.structure.settings)) {
  weights_.fill(1.0);
}

double DynamicWorkload::time_of(std::uint64_t frame) const {
  // The middle of the step: rounding cannot move it over the border of a sequence's frame.
  return (static_cast<double>(frame) + 0.5) * step_s_;
}

UpdateAction DynamicWorkload::reaction(TriangleChange change) const {
  return structure_ ? accel::decide(spec_.policy, *structure_, change, auto_) : UpdateAction::none;
}

double DynamicWorkload::start() {
  frame_ = 0;
  pending_ = TriangleChange::none;
  go_to(time_of(0));
  const energy::SteadyClock clock;
  const energy::Seconds begin = clock.now();
  if (structure_) build();
  built_over_ = triangles_.triangles.size();
  return (clock.now() - begin).value;
}

void DynamicWorkload::prepare() {
  start();
  init_renderer();
  check("build");
  if (!structure_ || spec_.policy == Policy::fixed) return;
  check_later_frame();
  start_timed();
}

void DynamicWorkload::start_timed() {
  const double building = start();
  const energy::SteadyClock clock;
  const energy::Seconds begin = clock.now();
  resend_unmarked();
  if (spec_.policy != Policy::automatic) return;
  const double sending = transfers() ? (clock.now() - begin).value : 0.0;
  auto_ = accel::AutoPolicy(accel::auto_rule(spec_.structure.settings));
  auto_.observe_build(weights_[Phase::build] * building + weights_[Phase::transfer] * sending);
}

void DynamicWorkload::begin_measuring() {
  FrameWorkload::begin_measuring();
  auto_.clear_figures();
}

void DynamicWorkload::set_phase_weights(const energy::PerPhase<double>& weights) {
  weights_ = weights;
  auto_ = accel::AutoPolicy(accel::auto_rule(spec_.structure.settings));
}

std::optional<accel::AutoFigures> DynamicWorkload::auto_figures() const {
  if (!structure_ || spec_.policy != Policy::automatic) return std::nullopt;
  return auto_.figures();
}

std::optional<double> DynamicWorkload::break_even_frames() const {
  const auto figures = auto_figures();
  if (!figures) return std::nullopt;
  return figures->break_even_at_rebuild ? figures->break_even_at_rebuild
                                        : figures->break_even_frames;
}

void DynamicWorkload::learn(const energy::PhaseLog& log, std::size_t before) {
  if (!structure_ || spec_.policy != Policy::automatic) return;
  energy::PerPhase<double> cost{};
  energy::PerPhase<bool> done{};
  for (const energy::PhaseSpan& span : log.spans().subspan(before)) {
    cost[span.phase] += weights_[span.phase] * (span.end - span.start).value;
    done[span.phase] = true;
  }
  if (done[Phase::build]) auto_.observe_build(cost[Phase::build] + cost[Phase::transfer]);
  if (done[Phase::update]) auto_.observe_update(cost[Phase::update] + cost[Phase::transfer]);
  if (done[Phase::render]) auto_.observe_frame(cost[Phase::render], structure_->assessed_cost());
}

void DynamicWorkload::check_later_frame() {
  // A structure that follows the motion must still be right after a good part of the loop.
  switch (reaction(go_to(time_of(0) + 0.37 * spec_.scene->duration_s()))) {
    case UpdateAction::none:
      break;
    case UpdateAction::build:
      if (!built_on_device()) build();
      resend_unmarked();
      check("rebuild");
      break;
    case UpdateAction::update:
      fit_unmarked();
      check("update");
      break;
  }
}

void DynamicWorkload::animate(energy::PhaseLog& log) {
  ++frame_;
  const auto mark = log.mark(Phase::animate);
  pending_ = std::max(pending_, go_to(time_of(frame_)));
}

void DynamicWorkload::build_noted(energy::PhaseLog& log) {
  build_marked(log);
  built_over_ = triangles_.triangles.size();
}

void DynamicWorkload::follow(energy::PhaseLog& log) {
  const TriangleChange change = std::exchange(pending_, TriangleChange::none);
  const UpdateAction what = reaction(change);
  const bool own_build = what == UpdateAction::build && built_on_device();
  if (what == UpdateAction::build && !own_build) build_noted(log);
  if (own_build) built_over_ = triangles_.triangles.size();
  // A structure left alone refers to triangles by place, so there must still be as many.
  if (structure_ && triangles_.triangles.size() != built_over_) {
    throw std::runtime_error("the triangle count of scene " + spec_.scene->name +
                             " changed, which policy static cannot follow; use rebuild");
  }
  const bool on_device = fitting() == Fitting::device;
  if (what == UpdateAction::update && !on_device) update_marked(log);
  if (change != TriangleChange::none) send(log);
  if (own_build) build_noted(log);
  if (what == UpdateAction::update && on_device) update_marked(log);
}

void DynamicWorkload::frame(energy::PhaseLog& log) {
  const std::size_t before = log.spans().size();
  animate(log);
  follow(log);
  render(log);
  learn(log, before);
}

std::vector<Phase> DynamicWorkload::separable() const {
  std::vector<Phase> phases{Phase::animate};
  if (structure_ && spec_.policy != Policy::fixed) {
    if (fitting() != Fitting::none) phases.push_back(Phase::update);
    // Of those that did not happen none is repeated.
    if (fitting() == Fitting::none || spec_.policy == Policy::automatic) {
      phases.push_back(Phase::build);
    }
  }
  if (transfers()) phases.push_back(Phase::transfer);
  phases.push_back(Phase::render);
  return phases;
}

void DynamicWorkload::run_alone(Phase phase, energy::PhaseLog& log) {
  const std::size_t before = log.spans().size();
  switch (phase) {
    case Phase::animate:
      animate(log);
      if (!transfers()) follow(log);
      return learn(log, before);
    case Phase::build:
      build_noted(log);
      if (!transfers()) send(log);
      return learn(log, before);
    case Phase::update:
      // Nothing moved: what this costs says nothing of an update that is needed.
      update_marked(log);
      if (!transfers()) send(log);
      return;
    case Phase::transfer:
      animate(log);
      follow(log);
      return learn(log, before);
    case Phase::render:
      render(log);
      return;
  }
}

void ForcedWorkload::prepare() {
  go_to(0.0);
  build();
  init_renderer();
  if (built_on_device()) resend_unmarked();
  check("build");
  if (fitting() == Fitting::none) return;
  fit_unmarked();
  check("update");
}

void ForcedWorkload::follow(energy::PhaseLog& log) {
  const Fitting who = fitting();
  const bool own_build = who == Fitting::none && built_on_device();
  if (who == Fitting::none && !own_build) build_marked(log);
  if (who == Fitting::host) update_marked(log);
  send(log);
  if (own_build) build_marked(log);
  if (who == Fitting::device) update_marked(log);
}

void ForcedWorkload::frame(energy::PhaseLog& log) {
  follow(log);
  render(log);
}

std::vector<Phase> ForcedWorkload::separable() const {
  const Fitting who = fitting();
  std::vector<Phase> phases{who == Fitting::none ? Phase::build : Phase::update};
  // Nothing is sent to a device that builds or updates its own, so there is nothing to repeat.
  const bool own = who == Fitting::device || built_on_device();
  if (transfers() && !own) phases.push_back(Phase::transfer);
  phases.push_back(Phase::render);
  return phases;
}

void ForcedWorkload::run_alone(Phase phase, energy::PhaseLog& log) {
  if (phase == Phase::render) {
    render(log);
  } else if (phase == Phase::transfer) {
    // Only what was just built or updated can be sent.
    follow(log);
  } else if (phase == Phase::build) {
    build_marked(log);
    if (!transfers()) send(log);
  } else {
    update_marked(log);
    if (!transfers()) send(log);
  }
}

}  // namespace encore::app
