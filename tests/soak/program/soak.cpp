#include "tests/soak/program/soak.h"

#include "accel/auto_policy.h"
#include "accel/make_structure.h"
#include "accel/test_rays.h"
#include "accel/update_policy.h"
#include "renderer/camera_rays.h"
#include "scene/sample_scenes.h"
#include "scene/triangles.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>

namespace encore::test {

namespace {

using accel::IntersectionMode;
using accel::Policy;
using accel::UpdateAction;
using scene::TriangleChange;

// Where in the loop a leg's frames are.
constexpr std::array kFrames{0.11, 0.43, 0.79};
// More than one, so that tiles are drawn side by side.
constexpr int kThreads = 2;

// A share of the pixels may be another colour than the reference's where the last bit of a hit may
// differ: on edges, and behind glass.
constexpr double kMostOtherPixels = 0.02;
constexpr float kOtherColor = 0.02F;

}  // namespace

struct Soak::LiveScene {
  scene::Scene scene;
  scene::TriangleList list;
  std::unique_ptr<accel::AccelerationStructure> structure;  ///< of a renderer between rounds

  explicit LiveScene(const std::string& name) {
    auto made = scene::make_sample_scene(name);
    if (!made) throw std::invalid_argument("there is no sample scene " + name);
    scene = std::move(*made);
  }
  TriangleChange go_to(double share_of_loop) {
    return scene::update_triangles(scene, share_of_loop * scene.duration_s(), list);
  }
};

/// A leg at work.
struct Soak::Frame {
  LiveScene& live;
  renderer::Renderer& renderer;
  renderer::Tracer* tracer = nullptr;  ///< the renderer, if it traces rays
  std::unique_ptr<accel::AccelerationStructure> structure{};
  accel::AutoPolicy costs{};
  int number = 0;
  bool outdated = false;  ///< the structure is of an earlier time
  renderer::Image picture{};
};

Soak::Soak(const SoakPlan& plan, const std::shared_ptr<renderer::gl::Context>& context)
    : plan_(plan),
      legs_(all_legs(context != nullptr, plan.seed)),
      cpu_(kThreads),
      reference_tracer_(1),
      tiny_(std::make_unique<LiveScene>("triangle")) {
  if (context) {
    gpu_ = std::make_unique<renderer::GpuTracer>(context);
    raster_ = std::make_unique<renderer::RasterRenderer>(context);
  }
  tiny_->go_to(0.0);
  tiny_->structure = accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
  tiny_->structure->build(tiny_->list.triangles);
}

Soak::~Soak() = default;

void Soak::round(const std::function<bool()>& go_on) {
  // The same in each round of a slice, so that rounds can be compared.
  const std::size_t slice = tally_.rounds % plan_.slices_used;
  check_seed_ = plan_.seed * 1'000 + slice;
  for (std::size_t i = slice; i < legs_.size(); i += plan_.slices) {
    if (!go_on()) return settle();
    run(legs_[i]);
  }
  settle();
  ++tally_.rounds;
  tally_.memory.push_back(memory_use());
}

void Soak::run(const Leg& leg) {
  renderer::Renderer& renderer = renderer_of(leg.device);
  Frame frame{.live = scene_of(leg.scene),
              .renderer = renderer,
              .tracer = dynamic_cast<renderer::Tracer*>(&renderer)};
  for (; frame.number < static_cast<int>(kFrames.size()); ++frame.number) {
    if (frame.number == 0) {
      begin(leg, frame);
    } else {
      go_on(leg, frame);
    }
    renderer.draw(frame.live.scene.camera, plan_.size, plan_.size);
    renderer.read(frame.picture);
    ++tally_.frames;
    if (frame.structure) frame.costs.observe_frame(20.0, frame.structure->decay());
    check_picture(leg, frame);
    if (frame.tracer != nullptr) check_hits(leg, frame);
  }
  ++tally_.legs;
}

void Soak::begin(const Leg& leg, Frame& frame) {
  frame.live.go_to(kFrames[0]);
  if (frame.tracer != nullptr) {
    accel::StructureSpec spec = accel::default_spec(leg.structure);
    spec.intersection = leg.mode;
    spec.memory = leg.memory;
    frame.structure = accel::make_structure(spec);
    accel::carry_out(UpdateAction::build, leg.policy, *frame.structure, frame.live.list.triangles);
    // Not the clock's: the same choices on every machine.
    frame.costs.observe_build(30.0);
    ++tally_.builds;
  }
  frame.renderer.set_rays(soak_rays()[leg.rays]);
  frame.renderer.init({&frame.live.scene, &frame.live.list, frame.structure.get()});
}

void Soak::go_on(const Leg& leg, Frame& frame) {
  TriangleChange change = frame.live.go_to(kFrames[static_cast<std::size_t>(frame.number)]);
  if (frame.structure == nullptr) return frame.renderer.refresh();
  // What does not move is built or updated all the same.
  if (change == TriangleChange::none) change = TriangleChange::moved;
  UpdateAction action = accel::decide(leg.policy, *frame.structure, change, frame.costs);
  // A structure that is left alone cannot follow this.
  if (change == TriangleChange::topology) action = UpdateAction::build;
  frame.outdated = action == UpdateAction::none;
  const bool on_device =
      action == UpdateAction::update && leg.policy == Policy::refit && frame.tracer->can_refit();
  if (!on_device) {
    accel::carry_out(action, leg.policy, *frame.structure, frame.live.list.triangles);
  }
  frame.renderer.refresh();
  if (on_device) frame.tracer->refit();
  if (action == UpdateAction::build) frame.costs.observe_build(30.0);
  if (action == UpdateAction::update) frame.costs.observe_update(1.0);
  tally_.builds += action == UpdateAction::build ? 1 : 0;
  tally_.updates += action == UpdateAction::update && !on_device ? 1 : 0;
  tally_.device_refits += on_device ? 1 : 0;
}

void Soak::check_hits(const Leg& leg, Frame& frame) {
  const auto& triangles = frame.live.list.triangles;
  const std::uint64_t seed = check_seed_++;
  // It holds corners of its own: while it is outdated it sees triangles where they were.
  if (frame.outdated && leg.structure == accel::StructureKind::bvh_sah) return;
  const auto most = static_cast<std::size_t>(plan_.size);
  const std::size_t count = std::min(plan_.checked_rays / 2, most);
  std::vector<scene::Ray> rays(count);
  const int y = static_cast<int>(seed * 7 % most);
  const int x = static_cast<int>(seed * 13 % (most - count + 1));
  renderer::camera_rays(
      renderer::make_camera_frame(frame.live.scene.camera, plan_.size, plan_.size),
      {x, y, x + static_cast<int>(count), y + 1}, rays);
  // Möller and Trumbore's arithmetic loses hits on the edges that other rays are aimed at.
  if (leg.mode != IntersectionMode::moller_trumbore) {
    const auto kinds = accel::all_ray_kinds();
    const auto more = accel::test_rays(kinds[seed % kinds.size()], plan_.checked_rays - count, seed,
                                       triangles, *frame.structure);
    rays.insert(rays.end(), more.begin(), more.end());
  }
  std::vector<scene::Hit> found(rays.size());
  frame.tracer->trace_rays(rays, found);
  SpotCheck(triangles).check(rays, found,
                             {.mode = leg.mode,
                              .on_device = leg.device == SoakDevice::gpu,
                              .outdated = frame.outdated,
                              .name = fmt::format("{}, frame {}", describe(leg), frame.number)},
                             tally_.checks);
}

const renderer::Image& Soak::reference(const Leg& leg, const Frame& frame) {
  const auto [place, missing] =
      references_.try_emplace({leg.scene, leg.rays, frame.number}, renderer::Image{});
  if (missing) {
    const auto structure =
        accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
    structure->build(frame.live.list.triangles);
    reference_tracer_.set_rays(soak_rays()[leg.rays]);
    reference_tracer_.init({&frame.live.scene, &frame.live.list, structure.get()});
    reference_tracer_.draw(frame.live.scene.camera, plan_.size, plan_.size);
    reference_tracer_.read(place->second);
  }
  return place->second;
}

void Soak::check_picture(const Leg& leg, const Frame& frame) {
  // An outdated structure's is another, by rights; so is the rasteriser's, which has no shadows.
  if (frame.outdated || leg.device == SoakDevice::raster ||
      leg.mode == IntersectionMode::moller_trumbore) {
    return;
  }
  const std::vector<glm::vec3>& expected = reference(leg, frame).pixels;
  const std::vector<glm::vec3>& drawn = frame.picture.pixels;
  std::size_t other = 0;
  for (std::size_t i = 0; i < expected.size() && i < drawn.size(); ++i) {
    const glm::vec3 apart = glm::abs(expected[i] - drawn[i]);
    // So that a NaN counts.
    other += std::max({apart.x, apart.y, apart.z}) <= kOtherColor ? 0 : 1;
  }
  const bool exact = leg.device == SoakDevice::cpu && leg.mode == IntersectionMode::precise;
  const bool right = expected.size() == drawn.size() &&
                     (exact ? expected == drawn
                            : static_cast<double>(other) <=
                                  kMostOtherPixels * static_cast<double>(expected.size()));
  ++tally_.pictures;
  if (right || tally_.wrong_pictures++ > 0) return;
  tally_.first_wrong_picture = fmt::format("{}, frame {}: {} of {} pixels are another colour",
                                           describe(leg), frame.number, other, expected.size());
}

void Soak::settle() {
  for (renderer::Renderer* one : std::initializer_list<renderer::Renderer*>{
           &cpu_, &reference_tracer_, gpu_.get(), raster_.get()}) {
    if (one == nullptr) continue;
    one->set_rays({});
    one->init({&tiny_->scene, &tiny_->list, tiny_->structure.get()});
    one->draw(tiny_->scene.camera, plan_.size, plan_.size);
  }
  references_.clear();
  scenes_.clear();
}

renderer::Renderer& Soak::renderer_of(SoakDevice device) {
  if (device == SoakDevice::cpu) return cpu_;
  if (device == SoakDevice::gpu) return *gpu_;
  return *raster_;
}

Soak::LiveScene& Soak::scene_of(const std::string& name) {
  auto& live = scenes_[name];
  if (!live) live = std::make_unique<LiveScene>(name);
  return *live;
}

}  // namespace encore::test
