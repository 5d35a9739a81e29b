#include "app/workloads.h"

#include "accel/brute_force.h"
#include "accel/make_structure.h"
#include "accel/test_rays.h"
#include "accel/verify.h"
#include "app/make_renderer.h"
#include "app/ray_options.h"
#include "app/workload_frames.h"
#include "renderer/camera_rays.h"
#include "renderer/trace_defines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::app {

namespace {

using accel::Policy;
using accel::StructureKind;
using energy::Counter;
using energy::Phase;

/// Ray-triangle tests that one check may cost: about a tenth of a second.
constexpr double kCheckTests = 2e7;

/// A square picture's worth of camera rays, and random ones from outside and inside the scene.
std::vector<scene::Ray> sample_rays(const scene::Camera& camera,
                                    std::span<const scene::Triangle> triangles,
                                    const accel::AccelerationStructure& structure) {
  const double affordable =
      kCheckTests / static_cast<double>(std::max<std::size_t>(triangles.size(), 1));
  const int side = std::clamp(static_cast<int>(std::sqrt(affordable / 2)), 6, 48);
  const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  std::vector<scene::Ray> rays(count);
  renderer::camera_rays(renderer::make_camera_frame(camera, side, side), {0, 0, side, side}, rays);
  for (const accel::RayKind kind : {accel::RayKind::outside, accel::RayKind::inside}) {
    const auto more = accel::test_rays(kind, count / 2, 1, triangles, structure);
    rays.insert(rays.end(), more.begin(), more.end());
  }
  return rays;
}

std::string describe(const scene::Hit& hit) {
  if (!hit.found()) return "a miss";
  return fmt::format("triangle {} at t = {}", hit.triangle, hit.t);
}

std::string describe(const scene::Ray& ray) {
  return fmt::format("origin ({}, {}, {}), direction ({}, {}, {}), t in ({}, {}]", ray.origin.x,
                     ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
                     ray.t_min, ray.t_max);
}

bool is_grid(StructureKind kind) {
  return kind == StructureKind::grid_exact || kind == StructureKind::grid_box;
}

/// Whether a build of this kind tests triangles against boxes exactly.
bool tests_triangles(StructureKind kind) {
  return kind == StructureKind::grid_exact || kind == StructureKind::kd_median ||
         kind == StructureKind::kd_sah;
}

/// A loop of builds or updates.
class BuildWorkload final : public SceneWorkload {
 public:
  using SceneWorkload::SceneWorkload;

  void prepare() override {
    go_to(0.0);
    build();
    check("build");
    if (!updates()) return;
    update();
    check("update");
  }

  void operation(energy::PhaseLog& log) override {
    if (updates()) {
      const auto mark = log.mark(Phase::update);
      update();
    } else {
      const auto mark = log.mark(Phase::build);
      build();
    }
  }

 private:
  [[nodiscard]] bool updates() const { return accel::updates(spec_.policy, *structure_); }
};

}  // namespace

std::string_view to_string(TestKind test) {
  switch (test) {
    case TestKind::build:
      return "build";
    case TestKind::fixed:
      return "static";
    case TestKind::animated:
      return "dynamic";
    case TestKind::forced:
      return "forced";
  }
  return "";
}

WorkloadTools standard_tools(const std::shared_ptr<GpuContext>& gpu) {
  return {accel::make_structure,
          [gpu](Device device, int threads) { return make_renderer(device, threads, *gpu); },
          [gpu] { return gpu->info(); }};
}

WorkloadTools standard_tools() {
  return standard_tools(std::make_shared<GpuContext>(std::nullopt));
}

SceneWorkload::SceneWorkload(WorkloadSpec spec, const WorkloadTools& tools)
    : spec_(std::move(spec)) {
  if (!traces_rays(spec_.device)) return;
  structure_ = tools.make_structure(spec_.structure);
  structure_->set_build_threads(spec_.threads);
}

std::string SceneWorkload::name() const {
  return fmt::format("{}, {}, {}", spec_.scene->name,
                     structure_ ? structure_->name() : to_string(spec_.device),
                     to_string(spec_.test));
}

std::vector<energy::KeyValue> SceneWorkload::configuration() const {
  return configuration_of(spec_, triangles_.triangles.size());
}

void SceneWorkload::append_structure_counters(std::vector<Counter>& counters) const {
  const StructureKind kind = spec_.structure.kind;
  const bool structured = structure_ != nullptr && kind != StructureKind::brute;
  const accel::BuildStats stats = structured ? structure_->stats() : accel::BuildStats{};
  // The figures of a tree that the device built are not at hand.
  const bool unknown = structured && built_on_device();
  const auto add = [&](const char* name, auto value, bool applies) {
    const bool known = structured && applies && !unknown;
    counters.push_back({name,
                        known ? std::optional<double>(static_cast<double>(value)) : std::nullopt,
                        unknown && applies});
  };
  add("nodes", stats.nodes, true);
  add("leaves", stats.leaves, true);
  add("references", stats.references, true);
  add("structure_bytes", stats.bytes, true);
  add("allocations", stats.allocations, true);
  add("allocated_bytes", stats.allocated_bytes, true);
  add("triangle_box_tests", stats.triangle_box_tests, tests_triangles(kind));
  add("max_depth", stats.max_depth, !is_grid(kind));
  add("grid_x", stats.grid_size[0], is_grid(kind));
  add("grid_y", stats.grid_size[1], is_grid(kind));
  add("grid_z", stats.grid_size[2], is_grid(kind));
  // Boxes that the device fitted by itself are not at hand.
  add("sah_cost", stats.sah_cost, !host_structure_is_stale());
  counters.back().unavailable = unknown || (structured && host_structure_is_stale());
  add("references_per_leaf", stats.references_per_leaf(), true);
  add("duplication", stats.duplication(), true);
}

void SceneWorkload::append_ray_counters(const RayFigures& rays, energy::Seconds render,
                                        std::vector<Counter>& counters) {
  const auto name = [](std::size_t kind, const char* unit) {
    return fmt::format("{}_{}", scene::to_string(static_cast<scene::RayKind>(kind)), unit);
  };
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    counters.push_back({name(i, "rays"), rays.kinds[i].rays});
  }
  // Kinds of which there were no rays took no time, and nothing is said of them.
  const auto traced = [&](std::size_t i) { return rays.kinds[i].rays.value_or(0.0) > 0.0; };
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    Counter ms{name(i, "ms"), {}, traced(i) && !rays.kinds[i].share};
    if (traced(i) && rays.kinds[i].share) {
      ms.value = *rays.kinds[i].share * energy::milliseconds(render);
    }
    counters.push_back(std::move(ms));
  }
  // Filled in when the render phase's energy is known (add_ray_energy).
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    counters.push_back({name(i, "joules"), {}, traced(i)});
  }
}

std::vector<Counter> SceneWorkload::counters(const energy::PerPhase<energy::Seconds>& mean) const {
  std::vector<Counter> counters;
  append_structure_counters(counters);
  const RayFigures rays = ray_figures();
  std::optional<double> mrays;
  if (rays.rays && mean[Phase::render].value > 0) {
    mrays = *rays.rays / mean[Phase::render].value / 1e6;
  }
  const DeviceFigures device = device_figures();
  counters.insert(counters.end(),
                  {{"mrays_per_s", mrays},
                   {"hits", rays.hits},
                   {"rays_per_operation", rays.rays},
                   {"transfer_bytes", device.uploaded_bytes},
                   {"converted_bytes", device.converted_bytes},
                   {"device_transfer_s", device.transfer_s, device.transfer_unknown},
                   {"device_render_s", device.render_s, device.render_unknown},
                   // Filled in when the energy is known (add_energy_figures).
                   {"joules_per_mray", {}, rays.rays.has_value()},
                   {"joules_per_pixel", {}, rays.pixels},
                   {"energy_delay_js", {}, true}});
  append_ray_counters(rays, mean[Phase::render], counters);
  counters.push_back({"break_even_frames", break_even_frames()});
  return counters;
}

accel::HitComparison SceneWorkload::compare(const accel::AccelerationStructure& truth,
                                            std::span<const scene::Ray> rays) const {
  return accel::compare_hits(*structure_, truth, rays);
}

std::string SceneWorkload::traced_name() const {
  return std::string(structure_->name());
}

void SceneWorkload::check(std::string_view when) const {
  if (structure_ == nullptr) return;
  accel::BruteForce brute;
  brute.set_intersection(structure_->intersection());
  brute.build(triangles_.triangles);
  const auto rays = sample_rays(spec_.scene->camera, triangles_.triangles, *structure_);
  const accel::HitComparison result = compare(brute, rays);
  // In single precision the nearer of two triangles may be told differently where they all but
  // touch; a structure that is wrong differs in far more rays.
  const bool loose = structure_->intersection() == accel::IntersectionMode::moller_trumbore;
  if (result.mismatches() <= (loose ? result.rays / 500 : 0)) return;
  throw MismatchError(fmt::format(
      "{}: {} is wrong after the {}, so it was not measured: {} of {} rays differ from brute "
      "force; the first: {}: expected {}, found {}",
      spec_.scene->name, traced_name(), when, result.mismatches(), result.rays,
      describe(result.first_ray), describe(result.first_expected), describe(result.first_found)));
}

std::unique_ptr<SceneWorkload> make_workload(const WorkloadSpec& spec, const WorkloadTools& tools) {
  switch (spec.test) {
    case TestKind::build:
      if (spec.device != Device::cpu) return std::make_unique<DeviceUpdateWorkload>(spec, tools);
      return std::make_unique<BuildWorkload>(spec, tools);
    case TestKind::fixed:
      return std::make_unique<StaticWorkload>(spec, tools);
    case TestKind::animated:
      return std::make_unique<DynamicWorkload>(spec, tools);
    case TestKind::forced:
      return std::make_unique<ForcedWorkload>(spec, tools);
  }
  return nullptr;
}

std::string reason_to_skip(const WorkloadSpec& spec) {
  const bool builds = spec.test == TestKind::build || spec.test == TestKind::forced;
  if (!traces_rays(spec.device) && builds) {
    return fmt::format("device {} has no structure, so test {} has nothing to measure",
                       to_string(spec.device), to_string(spec.test));
  }
  if (spec.device == Device::gpu && !renderer::has_gpu_traversal(spec.structure.kind)) {
    return "brute force is the truth that others are held to; device gpu has no traversal for it";
  }
  if (builds && spec.policy == Policy::fixed) {
    return fmt::format("policy static builds nothing, so test {} has nothing to measure",
                       to_string(spec.test));
  }
  if (builds && spec.policy == Policy::automatic) {
    return fmt::format(
        "nothing decays where nothing moves, so test {} under policy auto would be that of refit "
        "again",
        to_string(spec.test));
  }
  if (spec.device == Device::gpu && spec.test == TestKind::build && spec.policy != Policy::refit &&
      spec.build_on != accel::BuildPlace::device) {
    return "structures are built on the CPU, so test build on device gpu would be that of cpu "
           "again; only a refit happens on the device itself";
  }
  if (spec.test != TestKind::animated) return {};
  if (!spec.scene->animated()) {
    return fmt::format("scene {} does not move, so test dynamic has nothing to measure",
                       spec.scene->name);
  }
  if (traces_rays(spec.device) && spec.policy == Policy::fixed &&
      changes_triangle_count(*spec.scene)) {
    return fmt::format("the triangle count of scene {} changes, which policy static cannot follow",
                       spec.scene->name);
  }
  return {};
}

}  // namespace encore::app
