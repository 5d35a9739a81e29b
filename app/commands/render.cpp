#include "accel/make_structure.h"
#include "app/commands/commands.h"
#include "app/common_options.h"
#include "app/interrupt.h"
#include "app/json_text.h"
#include "renderer/cpu_tracer.h"
#include "renderer/heatmap.h"
#include "renderer/image_io.h"
#include "scene/model_input.h"
#include "scene/sample_scenes.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace encore::app {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct RenderOptions : CommonOptions {
  std::string size = "512";
  std::string out;
  double time_s = 0.0;
  std::string heatmap;
  std::string camera;
};

/// What the picture cost and shows.
struct RenderReport {
  std::string scene;
  std::size_t triangles = 0;
  std::string structure;
  ImageSize size;
  int threads = 0;
  double build_ms = 0.0;
  double trace_ms = 0.0;
  std::uint64_t hits = 0;
  std::optional<renderer::CostStatistics> costs;

  [[nodiscard]] double million_rays_per_s() const {
    return double(size.width) * double(size.height) / (1000.0 * trace_ms);
  }
};

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

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

/// Lays what --camera states over the scene's own camera: eye and target, then up, then the field
/// of view, each group optional from the end.
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
  if (n.size() == 10) camera.vertical_fov_degrees = n[9];
}

/// Checks what can be checked before any work is done. Throws UsageError or std::runtime_error.
void check_out(const fs::path& out) {
  std::error_code error;
  const fs::file_status status = fs::status(out, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return;
  if (scene::lower_extension(out) != ".png") {
    throw UsageError(
        fmt::format("--out writes PNG; give a name that ends in .png, not '{}'", out.string()));
  }
  const fs::path folder = out.has_parent_path() ? out.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error(fmt::format("{}: cannot create the picture: there is no folder '{}'",
                                         out.string(), folder.string()));
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

/// The one structure to draw with: the one asked for, else the scene's, else bvh-median.
accel::StructureSpec chosen_structure(const RenderOptions& options, const scene::Scene& scene) {
  const std::vector<accel::StructureSpec> specs = chosen_structures(options, scene);
  if (specs.size() == 1) return specs.front();
  if (!options.structures.empty()) {
    throw UsageError("render draws with one structure; give --structure a single name");
  }
  for (const accel::StructureSpec& spec : specs) {
    if (spec.kind == accel::StructureKind::bvh_median) return spec;
  }
  return specs.front();
}

void print_report(const RenderReport& r, const RenderOptions& options, Terminal& terminal) {
  const auto& c = r.costs;
  if (options.json) {
    std::string heatmap = "null";
    if (c) {
      heatmap = fmt::format(
          "{{\"quantity\": {}, \"min\": {}, \"median\": {}, \"percentile_99\": {}, \"max\": {}, "
          "\"mean\": {}}}",
          json_text(options.heatmap), c->min, c->median, c->percentile_99, c->max,
          json_number(c->mean));
    }
    fmt::print(
        "{{\"file\": {}, \"scene\": {}, \"triangles\": {}, \"time_s\": {}, \"structure\": {}, "
        "\"width\": {}, \"height\": {}, \"threads\": {}, \"build_ms\": {}, \"trace_ms\": {}, "
        "\"million_rays_per_s\": {}, \"hits\": {}, \"heatmap\": {}}}\n",
        json_text(options.out), json_text(r.scene), r.triangles, json_number(options.time_s),
        json_text(r.structure), r.size.width, r.size.height, r.threads, json_number(r.build_ms),
        json_number(r.trace_ms), json_number(r.million_rays_per_s()), r.hits, heatmap);
    return;
  }
  terminal.info(
      fmt::format("{}: {}x{}, {}, build {:.2f} ms, trace {:.2f} ms, {:.2f} Mrays/s, {} hits",
                  options.out, r.size.width, r.size.height, r.structure, r.build_ms, r.trace_ms,
                  r.million_rays_per_s(), r.hits));
  if (c) {
    terminal.info(fmt::format(
        "{} a ray: min {}, median {}, mean {:.2f}, 99th percentile {} (last colour), max {}",
        options.heatmap, c->min, c->median, c->mean, c->percentile_99, c->max));
  }
}

/// Draws the picture or the heatmap and notes time and hits; false if it was interrupted.
bool draw(const RenderOptions& options, std::optional<renderer::HeatmapQuantity> heatmap,
          const renderer::RenderInput& input, renderer::Image& image, RenderReport& report) {
  renderer::CpuTracer tracer(chosen_threads(options, *input.scene));
  tracer.init(input);
  tracer.set_cancel_flag(&interrupted);
  report.threads = tracer.threads();
  const scene::Camera& camera = input.scene->camera;
  std::vector<accel::TraceCounters> counters;
  const auto start = Clock::now();
  try {
    if (heatmap) {
      tracer.trace_counters(camera, image.width, image.height, counters);
    } else {
      tracer.render(camera, image);
    }
  } catch (const std::invalid_argument& wrong) {
    // Only the camera can be wrong here: it came from the command line or from the scene.
    if (!options.camera.empty()) throw UsageError(fmt::format("--camera: {}", wrong.what()));
    throw scene::InputError(fmt::format("{}: {}", input.scene->source, wrong.what()));
  }
  report.trace_ms = milliseconds_since(start);
  report.hits = tracer.hit_count();
  if (!tracer.complete()) return false;
  if (heatmap) report.costs = renderer::draw_heatmap(counters, *heatmap, image);
  return true;
}

ExitCode render(const RenderOptions& options) {
  Terminal terminal(options.quiet);
  RenderReport report;
  // Everything that can be wrong with the command line is found before anything is loaded.
  report.size = parse_size(options.size);
  const auto heatmap = chosen_heatmap(options);
  if (!std::isfinite(options.time_s)) throw UsageError("--time takes a finite number of seconds");
  check_out(options.out);
  scene::Camera stated;
  if (!options.camera.empty()) apply_camera(options.camera, stated);

  scene::Scene scene = open_scene(
      options.scenes.empty() ? std::string(scene::kDefaultSceneName) : options.scenes.front(),
      options, terminal);
  if (!options.camera.empty()) apply_camera(options.camera, scene.camera);
  const accel::StructureSpec spec = chosen_structure(options, scene);
  scene::TriangleList triangles;
  scene::update_triangles(scene, options.time_s, triangles);
  if (triangles.dropped_non_finite > 0) {
    terminal.warning(fmt::format("{} triangles with coordinates that are not finite are left out",
                                 triangles.dropped_non_finite));
  }
  report.scene = scene.name;
  report.triangles = triangles.triangles.size();

  const auto structure = accel::make_structure(spec);
  report.structure = structure->name();
  const auto build_start = Clock::now();
  structure->build(triangles.triangles);
  report.build_ms = milliseconds_since(build_start);

  renderer::Image image;
  image.resize(report.size.width, report.size.height);
  if (!draw(options, heatmap, {&scene, &triangles, structure.get()}, image, report)) {
    terminal.warning(fmt::format("interrupted; {} was not written", options.out));
    return ExitCode::interrupted;
  }
  renderer::write_png(image, options.out);
  print_report(report, options, terminal);
  return ExitCode::ok;
}

}  // namespace

void add_render_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand("render", "Draw a scene, or what each of its rays costs");
  const auto options = std::make_shared<RenderOptions>();
  add_scene_options(*command, *options, false);
  add_structure_options(*command, *options, false);
  add_output_options(*command, *options);
  add_thread_option(*command, *options);
  command->add_option("--out,-o", options->out, "The PNG file to write")->required();
  command->add_option("--size", options->size, "Side, or WIDTHxHEIGHT, in pixels (default 512)");
  command->add_option("--time", options->time_s, "Time of the animation in seconds (default 0)");
  command->add_option("--heatmap", options->heatmap,
                      "Draw each ray's cost instead: steps, tests (triangle tests) or boxes (box "
                      "tests), from 0 to the 99th percentile");
  command->add_option("--camera", options->camera,
                      "\"ex,ey,ez, tx,ty,tz, ux,uy,uz, fov\": eye, target, up, vertical field of "
                      "view in degrees; the last four may be left out");
  command->callback([options, &result] { result = render(*options); });
}

}  // namespace encore::app
