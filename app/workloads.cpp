#include "app/workloads.h"

#include "accel/brute_force.h"
#include "accel/make_structure.h"
#include "accel/test_rays.h"
#include "accel/verify.h"
#include "app/workload_frames.h"
#include "renderer/camera_rays.h"
#include "renderer/cpu_tracer.h"

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
  [[nodiscard]] bool updates() const {
    return spec_.policy == Policy::refit && structure_->can_refit();
  }
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

WorkloadTools standard_tools() {
  return {accel::make_structure,
          [](int threads) { return std::make_unique<renderer::CpuTracer>(threads); }};
}

std::string workload_name(const WorkloadSpec& spec) {
  std::string name = fmt::format("{}, {}, {}", spec.scene->name,
                                 accel::to_string(spec.structure.kind), to_string(spec.test));
  if (spec.test != TestKind::fixed) name += fmt::format(" ({})", accel::to_string(spec.policy));
  if (spec.test != TestKind::build) {
    name += fmt::format(", {}x{}", spec.size.width, spec.size.height);
  }
  if (spec.repeat > 1) name += fmt::format(", repeat {}", spec.repeat);
  return name;
}

std::vector<energy::KeyValue> configuration_of(const WorkloadSpec& spec, std::size_t triangles) {
  const bool renders = spec.test != TestKind::build;
  // Nothing moves in the static test, so no policy is at work there.
  const Policy policy = spec.test == TestKind::fixed ? Policy::fixed : spec.policy;
  const auto* bvh = std::get_if<accel::BvhSettings>(&spec.structure.settings);
  const bool updates = policy == Policy::refit && bvh != nullptr;
  return {{"group", spec.group},
          {"scene", spec.scene->name},
          {"device", "cpu"},
          {"structure", std::string(accel::to_string(spec.structure.kind))},
          {"policy", std::string(accel::to_string(policy))},
          {"test", std::string(to_string(spec.test))},
          {"width", renders ? std::to_string(spec.size.width) : std::string()},
          {"height", renders ? std::to_string(spec.size.height) : std::string()},
          {"memory", std::string(accel::to_string(spec.structure.memory))},
          {"update_case", updates ? std::string(accel::to_string(bvh->update_case)) : ""},
          {"repeat", std::to_string(spec.repeat)},
          {"triangles", std::to_string(triangles)}};
}

std::vector<std::string> configuration_columns() {
  return {"group", "scene",  "device", "structure",   "policy", "test",
          "width", "height", "memory", "update_case", "repeat", "triangles"};
}

std::vector<std::string> counter_columns() {
  return {"nodes",
          "leaves",
          "references",
          "structure_bytes",
          "allocations",
          "allocated_bytes",
          "triangle_box_tests",
          "max_depth",
          "grid_x",
          "grid_y",
          "grid_z",
          "sah_cost",
          "references_per_leaf",
          "duplication",
          "mrays_per_s",
          "hits",
          "rays_per_operation",
          "joules_per_mray",
          "joules_per_pixel",
          "energy_delay_js"};
}

SceneWorkload::SceneWorkload(WorkloadSpec spec, const WorkloadTools& tools)
    : spec_(std::move(spec)), structure_(tools.make_structure(spec_.structure)) {}

std::string SceneWorkload::name() const {
  return fmt::format("{}, {}, {}", spec_.scene->name, structure_->name(), to_string(spec_.test));
}

std::vector<energy::KeyValue> SceneWorkload::configuration() const {
  return configuration_of(spec_, triangles_.triangles.size());
}

std::vector<Counter> SceneWorkload::counters(const energy::PerPhase<energy::Seconds>& mean) const {
  const accel::BuildStats stats = structure_->stats();
  const StructureKind kind = spec_.structure.kind;
  const bool structured = kind != StructureKind::brute;
  const auto figure = [](auto value, bool applies) {
    return applies ? std::optional<double>(static_cast<double>(value)) : std::nullopt;
  };
  const RayFigures rays = ray_figures();
  std::optional<double> mrays;
  if (rays.rays && mean[Phase::render].value > 0) {
    mrays = *rays.rays / mean[Phase::render].value / 1e6;
  }
  return {{"nodes", figure(stats.nodes, structured)},
          {"leaves", figure(stats.leaves, structured)},
          {"references", figure(stats.references, structured)},
          {"structure_bytes", figure(stats.bytes, structured)},
          {"allocations", figure(stats.allocations, structured)},
          {"allocated_bytes", figure(stats.allocated_bytes, structured)},
          {"triangle_box_tests", figure(stats.triangle_box_tests, tests_triangles(kind))},
          {"max_depth", figure(stats.max_depth, structured && !is_grid(kind))},
          {"grid_x", figure(stats.grid_size[0], is_grid(kind))},
          {"grid_y", figure(stats.grid_size[1], is_grid(kind))},
          {"grid_z", figure(stats.grid_size[2], is_grid(kind))},
          {"sah_cost", figure(stats.sah_cost, structured)},
          {"references_per_leaf", figure(stats.references_per_leaf(), structured)},
          {"duplication", figure(stats.duplication(), structured)},
          {"mrays_per_s", mrays},
          {"hits", rays.hits},
          {"rays_per_operation", rays.rays},
          // Filled in when the energy is known (add_energy_figures).
          {"joules_per_mray", {}, rays.rays.has_value()},
          {"joules_per_pixel", {}, rays.rays.has_value()},
          {"energy_delay_js", {}, true}};
}

void SceneWorkload::check(std::string_view when) const {
  accel::BruteForce brute;
  brute.build(triangles_.triangles);
  const auto rays = sample_rays(spec_.scene->camera, triangles_.triangles, *structure_);
  const accel::HitComparison result = accel::compare_hits(*structure_, brute, rays);
  if (result.mismatches() == 0) return;
  throw MismatchError(fmt::format(
      "{}: {} is wrong after the {}, so it was not measured: {} of {} rays differ from brute "
      "force; the first: {}: expected {}, found {}",
      spec_.scene->name, structure_->name(), when, result.mismatches(), result.rays,
      describe(result.first_ray), describe(result.first_expected), describe(result.first_found)));
}

std::unique_ptr<SceneWorkload> make_workload(const WorkloadSpec& spec, const WorkloadTools& tools) {
  switch (spec.test) {
    case TestKind::build:
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

std::string reason_to_skip(TestKind test, Policy policy, const scene::Scene& scene) {
  if (test == TestKind::build && policy == Policy::fixed) {
    return "policy static builds nothing, so test build has nothing to measure";
  }
  if (test == TestKind::forced && policy == Policy::fixed) {
    return "policy static builds nothing, so test forced has nothing to measure";
  }
  if (test != TestKind::animated) return {};
  if (!scene.animated()) {
    return fmt::format("scene {} does not move, so test dynamic has nothing to measure",
                       scene.name);
  }
  if (policy == Policy::fixed && changes_triangle_count(scene)) {
    return fmt::format("the triangle count of scene {} changes, which policy static cannot follow",
                       scene.name);
  }
  return {};
}

}  // namespace encore::app
