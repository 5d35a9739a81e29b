#include "app/render_options.h"

#include "app/exit_code.h"
#include "app/gpu_device.h"
#include "app/ray_options.h"
#include "renderer/trace_defines.h"
#include "scene/model_input.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace encore::app {

namespace {

namespace fs = std::filesystem;

/// The numbers of a list separated by commas, spaces or both; throws UsageError.
std::vector<float> parse_numbers(std::string_view text) {
  std::vector<float> numbers;
  const auto next = [&](std::size_t from) { return text.find_first_not_of(", \t", from); };
  for (std::size_t at = next(0); at != std::string_view::npos;) {
    float value = 0.0F;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + at, end, value);
    const auto after = static_cast<std::size_t>(stop - text.data());
    const bool ends = stop == end || text.find_first_of(", \t", after) == after;
    if (error != std::errc{} || !ends || !std::isfinite(value)) {
      throw UsageError(
          fmt::format("--camera: '{}' does not start with a finite number", text.substr(at)));
    }
    numbers.push_back(value);
    at = next(after);
  }
  return numbers;
}

void check_file(std::string_view option, const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return;
  if (scene::lower_extension(file) != ".png") {
    throw UsageError(fmt::format("{} writes PNG; give a name that ends in .png, not '{}'", option,
                                 file.string()));
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error(fmt::format("{}: cannot create the picture: there is no folder '{}'",
                                         file.string(), folder.string()));
  }
}

std::optional<renderer::HeatmapQuantity> chosen_heatmap(const RenderOptions& options) {
  if (options.heatmap.empty()) return std::nullopt;
  const auto quantity = renderer::parse_heatmap_quantity(options.heatmap);
  if (!quantity) {
    throw UsageError(
        fmt::format("unknown heatmap '{}'; there are steps, tests and boxes", options.heatmap));
  }
  return quantity;
}

Device chosen_device(const std::string& name) {
  const auto device = parse_device(name);
  if (!device) throw UsageError(unknown_device(name));
  return *device;
}

/// Options that are fine one by one but not together.
void check_combinations(const RenderOptions& options, const RenderChoice& choice) {
  if (choice.heatmap && !traces_rays(choice.device)) {
    throw UsageError("--heatmap shows what rays cost, and raster traces none; use cpu or gpu");
  }
  if (choice.heatmap && choice.compare) {
    throw UsageError("--compare compares pictures; leave out --heatmap");
  }
  if (choice.compare == choice.device) {
    throw UsageError(
        fmt::format("--compare takes another device than --device {}", to_string(choice.device)));
  }
  if (!options.difference.empty() && !choice.compare) {
    throw UsageError("--difference needs --compare to say with which device");
  }
  if (!options.structures.empty() && !choice.needs_structure()) {
    throw UsageError("raster uses no structure; leave out --structure");
  }
}

}  // namespace

bool RenderChoice::needs_structure() const {
  return traces_rays(device) || (compare && traces_rays(*compare));
}

RenderChoice check_render_options(const RenderOptions& options) {
  RenderChoice choice;
  choice.size = parse_size(options.size);
  choice.heatmap = chosen_heatmap(options);
  choice.device = chosen_device(options.device);
  if (!options.compare.empty()) choice.compare = chosen_device(options.compare);
  check_combinations(options, choice);
  if (!std::isfinite(options.time_s)) throw UsageError("--time takes a finite number of seconds");
  check_file("--out", options.out);
  if (!options.difference.empty()) check_file("--difference", options.difference);
  scene::Camera stated;
  if (!options.camera.empty()) apply_camera(options.camera, stated);
  return choice;
}

void apply_camera(std::string_view text, scene::Camera& camera) {
  const std::vector<float> n = parse_numbers(text);
  if (n.size() != 6 && n.size() != 9 && n.size() != 10) {
    throw UsageError(
        fmt::format("--camera takes eye and target (6 numbers), then up (9), then the vertical "
                    "field of view in degrees (10), not {} numbers",
                    n.size()));
  }
  camera.eye = {n[0], n[1], n[2]};
  camera.target = {n[3], n[4], n[5]};
  if (n.size() >= 9) camera.up = {n[6], n[7], n[8]};
  if (n.size() == 10) {
    camera.vertical_fov_degrees = n[9];
    camera.orthographic_height = 0.0F;
  }
}

accel::StructureSpec chosen_structure(const RenderOptions& options, const RenderChoice& choice,
                                      const scene::Scene& scene) {
  const std::vector<accel::StructureSpec> specs = chosen_structures(options, scene);
  accel::StructureSpec chosen = specs.front();
  if (specs.size() > 1) {
    if (!options.structures.empty()) {
      throw UsageError("render draws with one structure; give --structure a single name");
    }
    for (const accel::StructureSpec& spec : specs) {
      if (spec.kind == accel::StructureKind::bvh_median) chosen = spec;
    }
  }
  const bool on_gpu = choice.device == Device::gpu || choice.compare == Device::gpu;
  if (on_gpu && !renderer::has_gpu_traversal(chosen.kind)) {
    throw UsageError(fmt::format("the GPU cannot trace {}; give --structure another name",
                                 accel::to_string(chosen.kind)));
  }
  return chosen;
}

void add_render_options(CLI::App& command, RenderOptions& options) {
  add_scene_options(command, options, false);
  add_structure_options(command, options, false);
  add_output_options(command, options);
  add_thread_option(command, options);
  add_ray_options(command, options);
  command.add_option("--out,-o", options.out, "The PNG file to write")->required();
  command.add_option("--size", options.size, "Side, or WIDTHxHEIGHT, in pixels (default 512)");
  command.add_option("--time", options.time_s, "Time of the animation in seconds (default 0)");
  command.add_option("--heatmap", options.heatmap,
                     "Draw each ray's cost instead: steps, tests (triangle tests) or boxes (box "
                     "tests), from 0 to the 99th percentile");
  command.add_option("--camera", options.camera,
                     "\"ex,ey,ez, tx,ty,tz, ux,uy,uz, fov\": eye, target, up, vertical field of "
                     "view in degrees; the last four may be left out");
  command.add_option("--device", options.device,
                     "cpu (default), gpu (OpenGL compute) or raster (plain OpenGL, no rays)");
  command.add_option("--compare", options.compare,
                     "Draw on this device, too, and say how far the two pictures are apart");
  command.add_option("--difference", options.difference,
                     "With --compare: the PNG file to write that shows where they differ");
  add_gl_device_option(command, options.gl_device);
}

}  // namespace encore::app
