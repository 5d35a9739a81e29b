#include "app/commands/commands.h"
#include "app/common_options.h"
#include "app/device.h"
#include "app/json_text.h"
#include "app/needs_report.h"
#include "app/number_text.h"
#include "app/ray_options.h"
#include "scene/sample_scenes.h"
#include "scene/scene_info.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

namespace encore::app {

namespace {

struct InfoOptions : CommonOptions {
  double time_s = 0.0;
};

void print_line(const std::string& name, const std::string& value) {
  fmt::print("  {:<22} {}\n", name, value);
}

std::string vec3_text(const glm::vec3& v) {
  return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z);
}

std::string distribution_text(const scene::Distribution& d) {
  return fmt::format(
      "min {:.3g}, 10 % {:.3g}, median {:.3g}, mean {:.3g}, 90 % {:.3g}, 99 % {:.3g}, max {:.3g}",
      d.min, d.percentile_10, d.median, d.mean, d.percentile_90, d.percentile_99, d.max);
}

std::string animation_text(const scene::AnimationInfo& a) {
  if (a.kind == "static") return "none";
  std::string text = fmt::format("{}, {} of the instances move, loop of {:g} s", a.kind,
                                 a.moving_instances, a.duration_s);
  if (a.frames > 0) text += fmt::format(", {} frames", a.frames);
  if (a.min_triangles != a.max_triangles) {
    text += fmt::format(", {} to {} triangles", with_separators(a.min_triangles),
                        with_separators(a.max_triangles));
  }
  return text;
}

std::string material_text(const scene::Material& m) {
  std::string text = fmt::format("Kd {}", vec3_text(m.diffuse));
  if (m.specular != glm::vec3(0.0F)) {
    text += fmt::format("  Ks {} Ns {:g}", vec3_text(m.specular), m.shininess);
  }
  if (m.emission != glm::vec3(0.0F)) text += fmt::format("  Ke {}", vec3_text(m.emission));
  if (m.opacity != 1.0F) text += fmt::format("  d {:g} Ni {:g}", m.opacity, m.index_of_refraction);
  if (m.reflectivity != 0.0F) text += fmt::format("  reflectivity {:g}", m.reflectivity);
  if (m.diffuse_texture != nullptr) {
    text += fmt::format("  texture {} ({}x{})", m.diffuse_texture->name, m.diffuse_texture->width,
                        m.diffuse_texture->height);
  }
  return text;
}

void print_text(const scene::Scene& scene, const scene::SceneInfo& info) {
  fmt::print("{} ({})\n", info.name, info.source);
  print_line("triangles", with_separators(info.triangles));
  print_line("vertices", with_separators(info.vertices));
  print_line("instances", fmt::format("{} of {} meshes", info.instances, info.models));
  if (info.triangles > 0) {
    print_line("bounds",
               fmt::format("{} to {}", vec3_text(info.bounds.min), vec3_text(info.bounds.max)));
    print_line("surface area", fmt::format("{:g}", info.surface_area));
    print_line("density",
               fmt::format("{:.4g} triangles a unit of volume", info.triangles_per_volume));
    print_line(
        "occupied",
        fmt::format("{:.1f} % of {}x{}x{} cells; the fullest holds {:.1f} % of the triangles",
                    100.0 * info.occupied_share, info.coarse_cells.x, info.coarse_cells.y,
                    info.coarse_cells.z, 100.0 * info.fullest_cell_share));
    print_line("extent / scene", distribution_text(info.extent));
    print_line("area / mean area", distribution_text(info.area));
    print_line("unevenness of areas",
               fmt::format("{:.3f} (Gini: 0 all equal, 1 one holds all)", info.area_unevenness));
  }
  if (info.degenerate_triangles > 0) {
    print_line("zero-area triangles", with_separators(info.degenerate_triangles));
  }
  if (info.dropped_non_finite > 0) {
    print_line("dropped (NaN or inf)", with_separators(info.dropped_non_finite));
  }
  print_line("animation", animation_text(info.animation));
  print_line("shading", fmt::format("{}{}{}", info.has_normals ? "smooth normals" : "flat",
                                    info.has_colors ? ", vertex colours" : "",
                                    info.has_texcoords ? ", textures" : ""));
  if (info.textures > 0) {
    print_line("textures", fmt::format("{}, {}{}", info.textures, bytes_text(info.texture_bytes),
                                       info.has_texcoords ? "" : " (no surface has coordinates)"));
  }
  print_line("memory", fmt::format("{} meshes, {} triangle list", bytes_text(info.mesh_bytes),
                                   bytes_text(info.triangle_list_bytes)));
  print_line("camera",
             fmt::format("eye {} target {} {} {:g}", vec3_text(scene.camera.eye),
                         vec3_text(scene.camera.target),
                         scene.camera.orthographic() ? "orthographic height" : "fov",
                         scene.camera.orthographic() ? scene.camera.orthographic_height
                                                     : scene.camera.vertical_fov_degrees));
  print_line("lights", fmt::format("{}", info.lights));
  print_line("materials", fmt::format("{}", info.materials));
  for (const scene::Material& material : scene.materials) {
    fmt::print("    {:<20} {}\n", material.name.empty() ? "(unnamed)" : material.name,
               material_text(material));
  }
  for (const scene::Preference& preference : scene.preferences) {
    print_line("setting", fmt::format("{} = {}", preference.key, preference.value));
  }
  for (const std::string& warning : info.warnings) print_line("warning", warning);
}

/// What drawing the scene by its own settings takes, and what it does without.
struct SceneUse {
  scene::RunNeeds needs;
  scene::RunParts parts;
  std::vector<scene::LeftOut> left_out;
};

/// Adds a warning where the scene states rays that there are not.
SceneUse use_of(const scene::Scene& scene, const scene::TriangleList& list,
                const CommonOptions& options, scene::SceneInfo& info) {
  SceneUse use;
  scene::RaySettings rays;
  try {
    rays = chosen_rays(options, scene);
  } catch (const scene::InputError& error) {
    info.warnings.emplace_back(error.what());
  }
  if (const scene::Preference* stated = preference(scene, "device"); stated != nullptr) {
    const std::optional<Device> device = parse_device(stated->value);
    use.parts.cpu = device.value_or(Device::cpu) == Device::cpu;
    use.parts.gpu = device == Device::gpu;
    use.parts.raster = device == Device::raster;
  }
  use.needs = scene::run_needs(scene, list, rays, use.parts);
  use.left_out = scene::left_out(scene, list, rays, use.parts);
  return use;
}

void print_use(const SceneUse& use) {
  print_line("needs", needs_text(use.needs, use.parts));
  fmt::print("{}", left_out_text({{.scene = {}, .features = use.left_out, .cost = {}}}));
}

std::string json_vec3(const glm::vec3& v) {
  return fmt::format("[{}, {}, {}]", json_number(v.x), json_number(v.y), json_number(v.z));
}

std::string json_distribution(const scene::Distribution& d) {
  return fmt::format(
      "{{\"min\": {}, \"p10\": {}, \"median\": {}, \"mean\": {}, \"p90\": {}, \"p99\": {}, "
      "\"max\": {}}}",
      json_number(d.min), json_number(d.percentile_10), json_number(d.median), json_number(d.mean),
      json_number(d.percentile_90), json_number(d.percentile_99), json_number(d.max));
}

void print_json(const scene::SceneInfo& info, const SceneUse& use) {
  std::string warnings;
  for (const std::string& warning : info.warnings) {
    warnings += (warnings.empty() ? "" : ", ") + json_text(warning);
  }
  fmt::print(
      "{{\"name\": {}, \"source\": {}, \"triangles\": {}, \"vertices\": {}, \"instances\": {}, "
      "\"models\": {}, \"materials\": {}, \"lights\": {},\n \"degenerate_triangles\": {}, "
      "\"dropped_non_finite\": {}, \"has_normals\": {}, \"has_colors\": {}, "
      "\"has_texcoords\": {}, \"textures\": {}, \"texture_bytes\": {},\n",
      json_text(info.name), json_text(info.source), info.triangles, info.vertices, info.instances,
      info.models, info.materials, info.lights, info.degenerate_triangles, info.dropped_non_finite,
      info.has_normals, info.has_colors, info.has_texcoords, info.textures, info.texture_bytes);
  fmt::print(
      " \"bounds\": {{\"min\": {}, \"max\": {}}}, \"surface_area\": {}, "
      "\"triangles_per_volume\": {},\n \"occupied_share\": {}, \"fullest_cell_share\": {}, "
      "\"extent\": {},\n \"area\": {}, \"area_unevenness\": {},\n",
      json_vec3(info.bounds.min), json_vec3(info.bounds.max), json_number(info.surface_area),
      json_number(info.triangles_per_volume), json_number(info.occupied_share),
      json_number(info.fullest_cell_share), json_distribution(info.extent),
      json_distribution(info.area), json_number(info.area_unevenness));
  fmt::print(
      " \"animation\": {{\"kind\": {}, \"moving_instances\": {}, \"frames\": {}, \"duration_s\": "
      "{}, \"min_triangles\": {}, \"max_triangles\": {}}},\n \"mesh_bytes\": {}, "
      "\"triangle_list_bytes\": {}, \"needs\": {},\n \"left_out\": {},\n \"warnings\": [{}]}}\n",
      json_text(info.animation.kind), info.animation.moving_instances, info.animation.frames,
      json_number(info.animation.duration_s), info.animation.min_triangles,
      info.animation.max_triangles, info.mesh_bytes, info.triangle_list_bytes,
      json_text(needs_text(use.needs, use.parts)),
      left_out_json({{.scene = info.name, .features = use.left_out, .cost = {}}}), warnings);
}

}  // namespace

void add_info_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "info", "Describe a scene: triangles, bounds, density, extents, materials, animation");
  const auto options = std::make_shared<InfoOptions>();
  add_scene_options(*command, *options, false);
  add_output_options(*command, *options);
  command->add_option("--time", options->time_s, "Time of the animation in seconds (default 0)");
  command->callback([options, &result] {
    // Warnings are part of the description here, so the terminal stays silent about them.
    Terminal terminal(true);
    const std::string name =
        options->scenes.empty() ? std::string(scene::kDefaultSceneName) : options->scenes.front();
    const scene::Scene scene = open_scene(name, *options, terminal);
    scene::TriangleList list;
    scene::update_triangles(scene, options->time_s, list);
    scene::SceneInfo info = scene::describe(scene, list);
    const SceneUse use = use_of(scene, list, *options, info);
    if (options->json) {
      print_json(info, use);
    } else {
      print_text(scene, info);
      print_use(use);
    }
    result = ExitCode::ok;
  });
}

}  // namespace encore::app
