// What a workload is called, and the columns of sessions that say what was measured.
#include "app/ray_options.h"
#include "app/workloads.h"

#include <fmt/format.h>

namespace encore::app {

namespace {

using accel::Policy;
using accel::StructureKind;

/// Nothing for structures that have none.
std::optional<accel::BuildPreset> preset_of(const WorkloadSpec& spec) {
  if (!traces_rays(spec.device) || spec.structure.kind != StructureKind::bvh_sah) {
    return std::nullopt;
  }
  return std::get<accel::BvhSettings>(spec.structure.settings).preset;
}

bool builds_on_device(const WorkloadSpec& spec) {
  return spec.device == Device::gpu && spec.test != TestKind::fixed &&
         spec.build_on == accel::BuildPlace::device;
}

}  // namespace

std::string workload_name(const WorkloadSpec& spec) {
  std::string name = spec.scene->name;
  const bool traces = traces_rays(spec.device);
  if (traces) name += fmt::format(", {}", accel::to_string(spec.structure.kind));
  if (spec.device != Device::cpu) name += fmt::format(", {}", to_string(spec.device));
  name += fmt::format(", {}", to_string(spec.test));
  if (traces && spec.test != TestKind::fixed) {
    name += fmt::format(" ({})", accel::to_string(spec.policy));
  }
  if (spec.test != TestKind::build) {
    name += fmt::format(", {}x{}", spec.size.width, spec.size.height);
    const scene::RaySettings rays = useful_rays(*spec.scene, spec.rays);
    if (traces && ray_list(rays) != "none") name += ", " + ray_list(rays);
    if (traces && rays.samples > 1) name += fmt::format(", {} samples", rays.samples);
  }
  if (traces && spec.structure.intersection != accel::IntersectionMode::precise) {
    name += fmt::format(", {}", accel::to_string(spec.structure.intersection));
  }
  if (builds_on_device(spec)) name += ", built on the device";
  if (const auto preset = preset_of(spec)) name += fmt::format(", {}", accel::to_string(*preset));
  if (spec.device == Device::cpu && spec.structure.grouping == accel::RayGrouping::single) {
    name += ", single rays";
  }
  if (spec.repeat > 1) name += fmt::format(", repeat {}", spec.repeat);
  return name;
}

std::vector<energy::KeyValue> configuration_of(const WorkloadSpec& spec, std::size_t triangles) {
  const bool renders = spec.test != TestKind::build;
  const bool traces = traces_rays(spec.device);
  // No policy is at work where nothing moves, or there is no structure.
  const Policy policy = spec.test == TestKind::fixed || !traces ? Policy::fixed : spec.policy;
  const auto* bvh = std::get_if<accel::BvhSettings>(&spec.structure.settings);
  const bool drawn = renders && traces;
  const scene::RaySettings rays = useful_rays(*spec.scene, spec.rays);
  const bool bounces = rays.reflections || rays.refractions;
  const bool updates = (policy == Policy::refit || policy == Policy::automatic) && bvh != nullptr &&
                       spec.structure.kind == StructureKind::bvh_median;
  const auto preset = preset_of(spec);
  return {
      {"group", spec.group},
      {"scene", spec.scene->name},
      {"device", std::string(to_string(spec.device))},
      {"structure", traces ? std::string(accel::to_string(spec.structure.kind)) : "none"},
      {"policy", std::string(accel::to_string(policy))},
      {"test", std::string(to_string(spec.test))},
      {"width", renders ? std::to_string(spec.size.width) : std::string()},
      {"height", renders ? std::to_string(spec.size.height) : std::string()},
      {"memory", traces ? std::string(accel::to_string(spec.structure.memory)) : ""},
      {"preset", preset ? std::string(accel::to_string(*preset)) : ""},
      {"build_on",
       spec.device == Device::gpu ? (builds_on_device(spec) ? "device" : "cpu") : std::string()},
      {"update_case", updates ? std::string(accel::to_string(bvh->update_case)) : ""},
      {"intersection", traces ? std::string(accel::to_string(spec.structure.intersection)) : ""},
      {"grouping", drawn && spec.device == Device::cpu
                       ? std::string(accel::to_string(spec.structure.grouping))
                       : ""},
      {"rays", drawn ? ray_list(rays) : ""},
      {"samples", drawn ? std::to_string(rays.samples) : ""},
      {"depth", drawn && bounces ? std::to_string(rays.depth) : ""},
      {"repeat", std::to_string(spec.repeat)},
      {"triangles", std::to_string(triangles)}};
}

std::vector<std::string> configuration_columns() {
  return {"group",  "scene",   "device", "structure", "policy",      "test",         "width",
          "height", "memory",  "preset", "build_on",  "update_case", "intersection", "grouping",
          "rays",   "samples", "depth",  "repeat",    "triangles"};
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
          "transfer_bytes",
          "converted_bytes",
          "device_transfer_s",
          "device_render_s",
          "joules_per_mray",
          "joules_per_pixel",
          "energy_delay_js",
          "camera_rays",
          "shadow_rays",
          "reflection_rays",
          "refraction_rays",
          "camera_ms",
          "shadow_ms",
          "reflection_ms",
          "refraction_ms",
          "camera_joules",
          "shadow_joules",
          "reflection_joules",
          "refraction_joules",
          "break_even_frames"};
}

}  // namespace encore::app
