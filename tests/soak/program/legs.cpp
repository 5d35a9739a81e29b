#include "tests/soak/program/legs.h"

#include "scene/sample_scenes.h"

#include <fmt/format.h>

#include <random>
#include <utility>

namespace encore::test {

namespace {

void add_traced(std::vector<Leg>& legs, const std::string& scene, SoakDevice device) {
  for (const accel::StructureKind structure : accel::all_structure_kinds()) {
    if (structure == accel::StructureKind::brute) continue;
    for (const accel::Policy policy : accel::all_policies()) {
      for (const accel::IntersectionMode mode : accel::all_intersection_modes()) {
        for (std::size_t rays = 0; rays < soak_rays().size(); ++rays) {
          const auto memory =
              legs.size() % 2 == 0 ? accel::MemoryMode::pool : accel::MemoryMode::fresh;
          legs.push_back({scene, structure, policy, device, mode, rays, memory});
        }
      }
    }
  }
}

}  // namespace

std::string_view to_string(SoakDevice device) {
  switch (device) {
    case SoakDevice::cpu:
      return "cpu";
    case SoakDevice::gpu:
      return "gpu";
    case SoakDevice::raster:
      return "raster";
  }
  return "";
}

std::string describe(const Leg& leg) {
  const scene::RaySettings& rays = soak_rays()[leg.rays];
  return fmt::format("{}, {}, {}, {}, {}, rays {}, {} samples, {}", leg.scene,
                     accel::to_string(leg.structure), accel::to_string(leg.policy),
                     to_string(leg.device), accel::to_string(leg.mode), scene::ray_list(rays),
                     rays.samples, accel::to_string(leg.memory));
}

const std::vector<scene::RaySettings>& soak_rays() {
  static const std::vector<scene::RaySettings> all = [] {
    std::vector<scene::RaySettings> rays(3);
    rays[1].shadows = rays[1].reflections = rays[1].refractions = true;
    rays[1].depth = 3;
    rays[2].samples = 4;
    return rays;
  }();
  return all;
}

std::vector<std::string> soak_scenes() {
  std::vector<std::string> names;
  for (const scene::SampleScene& sample : scene::sample_scenes()) {
    if (sample.animation != "static" || sample.name == "mirrors") names.push_back(sample.name);
  }
  return names;
}

std::vector<Leg> all_legs(bool with_opengl, std::uint64_t seed) {
  std::vector<Leg> legs;
  for (const std::string& scene : soak_scenes()) {
    add_traced(legs, scene, SoakDevice::cpu);
    if (!with_opengl) continue;
    add_traced(legs, scene, SoakDevice::gpu);
    for (std::size_t rays = 0; rays < soak_rays().size(); ++rays) {
      legs.push_back({.scene = scene, .device = SoakDevice::raster, .rays = rays});
    }
  }
  // std::shuffle's order is the library's own.
  std::mt19937_64 random(seed);
  for (std::size_t i = legs.size(); i > 1; --i) std::swap(legs[i - 1], legs[random() % i]);
  return legs;
}

}  // namespace encore::test
