#include "accel/make_structure.h"
#include "app/commands/commands.h"
#include "app/gpu_device.h"
#include "app/interrupt.h"
#include "app/ray_options.h"
#include "app/render_device.h"
#include "app/render_options.h"
#include "app/render_report.h"
#include "renderer/difference_image.h"
#include "renderer/image_io.h"
#include "scene/sample_scenes.h"

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace encore::app {

namespace {

using Clock = std::chrono::steady_clock;

/// The picture or the heatmap, and what it took; false if it was interrupted.
bool draw(RenderDevice& device, const RenderChoice& choice, renderer::Image& image,
          RenderReport& report) {
  image.resize(choice.size.width, choice.size.height);
  if (!choice.heatmap) {
    if (!device.draw(choice.size, image)) return false;
  } else {
    std::vector<accel::TraceCounters> counters;
    if (!device.trace_counters(choice.size, counters)) return false;
    report.costs = renderer::draw_heatmap(counters, *choice.heatmap, image);
  }
  report.figures = device.figures();
  return true;
}

/// Draws on the other device, too; writes the difference where asked. False if interrupted.
bool compare(RenderDevice& device, RenderDevice& other, const renderer::Image& image,
             const RenderOptions& options, RenderReport& report) {
  renderer::Image other_image;
  if (!other.draw(report.size, other_image)) return false;
  RenderComparison comparison{other.figures(), renderer::compare_images(image, other_image), {}};

  std::vector<scene::Hit> hits;
  std::vector<scene::Hit> other_hits;
  std::vector<std::uint8_t> differs;
  if (device.trace_hits(report.size, hits) && other.trace_hits(report.size, other_hits)) {
    comparison.differing_hits = 0;
    differs.resize(hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      differs[i] = std::memcmp(&hits[i], &other_hits[i], sizeof(scene::Hit)) != 0 ? 1 : 0;
      *comparison.differing_hits += differs[i];
    }
  }
  if (interrupted) return false;
  report.comparison = comparison;
  if (!options.difference.empty()) {
    renderer::write_png(renderer::difference_image(image, other_image, differs),
                        options.difference);
  }
  return true;
}

/// Everything that draws; false if it was interrupted.
bool draw_and_write(const RenderOptions& options, const RenderChoice& choice,
                    const renderer::RenderInput& input, RenderReport& report) {
  GpuContext gpu(options.gl_device);
  const int threads = chosen_threads(options, *input.scene);
  const scene::RaySettings rays = chosen_rays(options, *input.scene);
  RenderDevice device(choice.device, input, gpu, threads, rays);
  std::optional<RenderDevice> other;
  if (choice.compare) other.emplace(*choice.compare, input, gpu, threads, rays);
  renderer::Image image;
  try {
    if (!draw(device, choice, image, report)) return false;
    if (other && !compare(device, *other, image, options, report)) return false;
  } catch (const std::invalid_argument& wrong) {
    // Only the camera can be wrong here: it came from the command line or from the scene.
    if (!options.camera.empty()) throw UsageError(fmt::format("--camera: {}", wrong.what()));
    throw scene::InputError(fmt::format("{}: {}", input.scene->source, wrong.what()));
  }
  renderer::write_png(image, options.out);
  return true;
}

ExitCode render(const RenderOptions& options) {
  Terminal terminal(options.quiet);
  const RenderChoice choice = check_render_options(options);
  RenderReport report;
  report.size = choice.size;

  scene::Scene scene = open_scene(
      options.scenes.empty() ? std::string(scene::kDefaultSceneName) : options.scenes.front(),
      options, terminal);
  if (!options.camera.empty()) apply_camera(options.camera, scene.camera);
  scene::TriangleList triangles;
  scene::update_triangles(scene, options.time_s, triangles);
  if (triangles.dropped_non_finite > 0) {
    terminal.warning(fmt::format(
        "{} triangles with coordinates that are not finite, or beyond 2^126, are left out",
        triangles.dropped_non_finite));
  }
  report.scene = scene.name;
  report.triangles = triangles.triangles.size();

  std::unique_ptr<accel::AccelerationStructure> structure;
  if (choice.needs_structure()) {
    structure = accel::make_structure(chosen_structure(options, choice, scene));
    report.structure = structure->name();
    const auto start = Clock::now();
    structure->build(triangles.triangles);
    report.build_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  }
  if (!draw_and_write(options, choice, {&scene, &triangles, structure.get()}, report)) {
    terminal.warning(fmt::format("interrupted; {} was not written", options.out));
    return ExitCode::interrupted;
  }
  print_render_report(report, options, terminal);
  return ExitCode::ok;
}

}  // namespace

void add_render_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand("render", "Draw a scene, or what each of its rays costs");
  const auto options = std::make_shared<RenderOptions>();
  add_render_options(*command, *options);
  command->callback([options, &result] { result = render(*options); });
}

}  // namespace encore::app
