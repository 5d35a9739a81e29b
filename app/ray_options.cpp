#include "app/ray_options.h"

#include "app/exit_code.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace encore::app {

namespace {

std::string unknown_mode(std::string_view name) {
  std::vector<std::string_view> names;
  for (const auto mode : accel::all_intersection_modes()) names.push_back(accel::to_string(mode));
  return fmt::format("unknown intersection mode '{}'; there are {}{}", name, fmt::join(names, ", "),
                     scene::did_you_mean(name, names));
}

/// Applies what the command line says of one setting, if anything.
void apply(scene::RaySettings& rays, std::string_view key, const std::string& value) {
  if (value.empty()) return;
  const std::string problem = scene::apply_ray_setting(rays, key, value);
  if (!problem.empty()) throw UsageError(fmt::format("--{}: {}", key, problem));
}

}  // namespace

void add_ray_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--rays", options.rays,
                     "Rays beyond the first: shadows, reflections, refractions, textures, "
                     "separated by commas; all, or none (default: the scene's own, else textures)");
  command.add_option("--samples", options.samples,
                     "Camera rays a pixel, stratified (default: the scene's own, else 1)");
  command.add_option("--depth", options.depth,
                     "Reflections and refractions one after the other, 0 to 16 (default: the "
                     "scene's own, else 4)");
}

scene::RaySettings chosen_rays(const CommonOptions& options, const scene::Scene& scene) {
  scene::RaySettings rays;
  const auto keys = scene::ray_setting_keys();
  for (const scene::Preference& stated : scene.preferences) {
    if (std::find(keys.begin(), keys.end(), stated.key) == keys.end()) continue;
    const std::string problem = scene::apply_ray_setting(rays, stated.key, stated.value);
    if (!problem.empty()) throw scene::InputError(stated.place + ": " + problem);
  }
  apply(rays, "rays", options.rays);
  apply(rays, "samples", options.samples);
  apply(rays, "depth", options.depth);
  return rays;
}

scene::RaySettings useful_rays(const scene::Scene& scene, const scene::RaySettings& rays) {
  const scene::Needs needs = scene::needs_of(scene, {}, rays);
  const auto textured = [](const scene::Material& m) { return m.diffuse_texture != nullptr; };
  scene::RaySettings useful = rays;
  useful.shadows = needs.shadows;
  useful.reflections = needs.reflections;
  useful.refractions = needs.refractions;
  useful.textures = rays.textures && needs.lights &&
                    std::any_of(scene.materials.begin(), scene.materials.end(), textured);
  const scene::RaySettings usual;
  if (!useful.reflections && !useful.refractions) useful.depth = usual.depth;
  if (!needs.samples) useful.seed = usual.seed;
  return useful;
}

std::vector<accel::IntersectionMode> chosen_intersections(const CommonOptions& options,
                                                          const scene::Scene& scene) {
  std::vector<accel::IntersectionMode> modes;
  for (const std::string& name : options.intersections) {
    const auto mode = accel::parse_intersection_mode(name);
    if (!mode) throw UsageError(unknown_mode(name));
    if (std::find(modes.begin(), modes.end(), *mode) == modes.end()) modes.push_back(*mode);
  }
  if (!modes.empty()) return modes;
  if (const scene::Preference* stated = preference(scene, "intersection")) {
    const auto mode = accel::parse_intersection_mode(stated->value);
    if (!mode) throw scene::InputError(stated->place + ": " + unknown_mode(stated->value));
    return {*mode};
  }
  return {accel::IntersectionMode::precise};
}

}  // namespace encore::app
