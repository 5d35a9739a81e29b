#include "app/commands/commands.h"
#include "app/common_options.h"
#include "app/device.h"
#include "app/gpu_device.h"
#include "app/gpu_verification.h"
#include "app/gpu_verification_report.h"
#include "app/interrupt.h"
#include "app/json_text.h"
#include "app/stability.h"
#include "app/stability_report.h"
#include "app/verification.h"
#include "renderer/cpu_tracer.h"
#include "renderer/difference_image.h"
#include "renderer/gpu_tracer.h"
#include "renderer/trace_defines.h"
#include "scene/sample_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace encore::app {

namespace {

struct VerifyOptions : CommonOptions {
  std::size_t rays = VerificationPlan{}.rays_per_kind;
  std::uint64_t seed = 1;
  double time_s = 0.0;
  std::string devices = "cpu";
  std::string size = "256";
  std::string images;
  std::optional<int> gl_device;
  std::uint64_t max_triangles = std::numeric_limits<std::uint64_t>::max();
  bool stability = false;
  std::vector<std::string> stability_cases;
  bool full = false;
};

/// The rows as one JSON array, whichever device they are of.
class JsonRows {
 public:
  explicit JsonRows(bool wanted) : wanted_(wanted) {}
  void add(const std::string& row) {
    fmt::print("{}{}", separator_, row);
    separator_ = ",\n  ";
  }
  void end() const {
    if (wanted_) fmt::print("{}\n]\n", std::string_view(separator_).starts_with("[") ? "[" : "");
  }

 private:
  bool wanted_;
  const char* separator_ = "[\n  ";
};

void print_header() {
  fmt::print("{:<20} {:>9}  {:<11} {:<7} {:<13} {:>8} {:>8} {:>7} {:>8} {:>9} {:>9} {:>6} {:>6}\n",
             "scene", "triangles", "structure", "action", "against", "rays", "hits", "missed",
             "invented", "triangle", "distance", "any", "edge");
}

void print_row(const std::string& scene, const VerificationRow& row) {
  const accel::HitComparison& h = row.hits;
  fmt::print("{:<20} {:>9}  {:<11} {:<7} {:<13} {:>8} {:>8} {:>7} {:>8} {:>9} {:>9} {:>6} {:>6}\n",
             scene, row.triangles, row.structure, row.action, row.against, h.rays, h.hits, h.missed,
             h.invented, h.wrong_triangle, h.wrong_distance, h.wrong_occlusion, row.edge_cases);
}

std::string describe_hit(const scene::Hit& hit) {
  if (!hit.found()) return "no hit";
  return fmt::format("triangle {} at t = {:.9g}, u = {:.9g}, v = {:.9g}", hit.triangle, hit.t,
                     hit.u, hit.v);
}

void print_first_mismatch(const VerificationRow& row) {
  const accel::HitComparison& h = row.hits;
  const scene::Ray& r = h.first_ray;
  fmt::print(
      "  first mismatch ({} ray): origin ({:.9g}, {:.9g}, {:.9g}), direction ({:.9g}, {:.9g}, "
      "{:.9g}), t in ({:.9g}, {:.9g}]\n    expected {}\n    found    {}\n",
      row.first_kind, r.origin.x, r.origin.y, r.origin.z, r.direction.x, r.direction.y,
      r.direction.z, r.t_min, r.t_max, describe_hit(h.first_expected), describe_hit(h.first_found));
}

std::string json_row(const std::string& scene, const VerificationRow& row) {
  const accel::HitComparison& h = row.hits;
  return fmt::format(
      "{{\"scene\": {}, \"device\": \"cpu\", \"triangles\": {}, \"structure\": {}, \"action\": {}, "
      "\"against\": {}, \"rays\": {}, \"hits\": {}, \"missed\": {}, \"invented\": {}, "
      "\"wrong_triangle\": {}, "
      "\"wrong_distance\": {}, \"wrong_occlusion\": {}, \"edge_cases\": {}}}",
      json_text(scene), row.triangles, json_text(row.structure), json_text(row.action),
      json_text(row.against), h.rays, h.hits, h.missed, h.invented, h.wrong_triangle,
      h.wrong_distance, h.wrong_occlusion, row.edge_cases);
}

/// The scene if it is not larger than was asked for.
std::optional<scene::Scene> open_small_scene(const std::string& name, const VerifyOptions& options,
                                             Terminal& terminal) {
  scene::Scene scene = open_scene(name, options, terminal);
  if (options.max_triangles != std::numeric_limits<std::uint64_t>::max()) {
    scene::TriangleList list;
    scene::update_triangles(scene, options.time_s, list);
    if (list.triangles.size() > options.max_triangles) {
      terminal.info(fmt::format("{} left out: {} triangles", scene.name, list.triangles.size()));
      return std::nullopt;
    }
  }
  return scene;
}

ExitCode verify_cpu(const VerifyOptions& options, JsonRows& json, Terminal& terminal) {
  std::vector<std::string> names = options.scenes;
  if (names.empty()) names.emplace_back(scene::kDefaultSceneName);

  VerificationPlan plan;
  plan.rays_per_kind = options.rays;
  plan.seed = options.seed;
  plan.time_s = options.time_s;
  std::uint64_t mismatches = 0;
  std::uint64_t rays = 0;
  bool header_printed = options.json;
  for (const std::string& name : names) {
    const auto scene = open_small_scene(name, options, terminal);
    if (!scene) continue;
    const auto specs = chosen_structures(options, *scene);
    const auto rows = verify_scene(*scene, specs, plan, [&](double share) {
      terminal.progress("verifying " + scene->name, share);
    });
    terminal.progress_done();
    if (!header_printed) print_header();
    header_printed = true;
    for (const VerificationRow& row : rows) {
      mismatches += row.hits.mismatches();
      rays += row.hits.rays;
      if (options.json) {
        json.add(json_row(scene->name, row));
      } else {
        print_row(scene->name, row);
        if (row.hits.mismatches() > 0) print_first_mismatch(row);
      }
    }
    std::fflush(stdout);
    if (interrupted) break;
  }
  if (!options.json) {
    fmt::print("{} rays compared, {} mismatches{}\n", rays, mismatches,
               interrupted ? " (interrupted)" : "");
  }
  if (mismatches > 0) return ExitCode::mismatch;
  return interrupted ? ExitCode::interrupted : ExitCode::ok;
}

/// What --device gpu needs besides the options.
struct GpuVerification {
  DeviceVerificationPlan plan;
  std::shared_ptr<renderer::gl::Context> context;
  std::string device;
  DeviceVerificationSums sums;
};

/// All structures of one scene.
void verify_scene_on_gpu(const scene::Scene& scene, const VerifyOptions& options,
                         GpuVerification& run, JsonRows& json, Terminal& terminal) {
  const auto specs = chosen_structures(options, scene);
  for (const accel::StructureSpec& spec : specs) {
    if (!renderer::has_gpu_traversal(spec.kind)) {
      throw UsageError("brute is for the CPU alone; --device gpu takes the other structures");
    }
  }
  renderer::CpuTracer cpu;
  renderer::GpuTracer gpu(run.context);
  cpu.set_cancel_flag(&interrupted);
  gpu.set_cancel_flag(&interrupted);
  DeviceVerificationHooks hooks;
  hooks.progress = [&](double share) { terminal.progress("verifying " + scene.name, share); };
  if (!options.images.empty()) {
    hooks.pictures = [&](const DeviceRow& row, const renderer::Image& expected,
                         const renderer::Image& found, std::span<const std::uint8_t> differs) {
      write_device_pictures(options.images, scene.name, row, expected, found, differs);
    };
  }
  const auto rows = verify_device(scene, specs, run.plan, cpu, gpu, hooks);
  terminal.progress_done();
  for (const DeviceRow& row : rows) {
    run.sums.add(row);
    if (options.json) {
      json.add(json_device_row(scene.name, run.device, row));
    } else {
      print_device_row(scene.name, row);
    }
  }
  std::fflush(stdout);
}

ExitCode verify_gpu(const VerifyOptions& options, JsonRows& json, Terminal& terminal) {
  std::vector<std::string> names = options.scenes;
  if (names.empty()) {
    for (const scene::SampleScene& sample : scene::sample_scenes()) names.push_back(sample.name);
  }
  GpuContext gpu(options.gl_device);
  GpuVerification run{
      .plan = {parse_size(options.size), options.rays, options.seed, options.time_s},
      .context = gpu.get(),
      .device = gpu.info().name,
      .sums = {}};
  if (!options.images.empty()) {
    std::filesystem::create_directories(options.images);
    terminal.info(
        fmt::format("difference images: black equal, dark to light {:g} to {:g} (largest channel, "
                    "logarithmic), "
                    "magenta where hits differ",
                    renderer::kDifferenceFirst, renderer::kDifferenceLast));
  }
  if (!options.json) {
    fmt::print("GPU: {}, against the CPU\n", run.device);
    print_device_header();
  }
  for (const std::string& name : names) {
    const auto scene = open_small_scene(name, options, terminal);
    if (scene) verify_scene_on_gpu(*scene, options, run, json, terminal);
    if (interrupted) break;
  }
  if (!options.json) print_device_sums(run.sums, interrupted);
  if (run.sums.failed_rows > 0) return ExitCode::mismatch;
  if (interrupted) return ExitCode::interrupted;
  return run.sums.uncompared_rows > 0 ? ExitCode::failure : ExitCode::ok;
}

/// The devices of a list such as "cpu,gpu"; throws UsageError.
std::vector<Device> chosen_devices(std::string_view list) {
  std::vector<Device> devices;
  for (std::size_t start = 0; start <= list.size();) {
    const std::size_t end = std::min(list.find(',', start), list.size());
    const std::string_view name = list.substr(start, end - start);
    const auto device = parse_device(name);
    if (!device) throw UsageError(unknown_device(name));
    if (!traces_rays(*device)) throw UsageError("raster has no hits to verify");
    devices.push_back(*device);
    start = end + 1;
  }
  return devices;
}

/// The structures of --stability: those asked for, else all of them, brute too.
std::vector<accel::StructureSpec> stability_structures(const VerifyOptions& options) {
  if (!options.structures.empty()) return chosen_structures(options, scene::Scene{});
  VerifyOptions brute = options;
  brute.structures = {"brute"};
  std::vector<accel::StructureSpec> specs = chosen_structures(brute, scene::Scene{});
  const auto others = chosen_structures(options, scene::Scene{});
  specs.insert(specs.end(), others.begin(), others.end());
  return specs;
}

/// --stability: extreme geometry instead of scenes.
ExitCode verify_stability(const VerifyOptions& options, const std::vector<Device>& devices,
                          JsonRows& json, Terminal& terminal) {
  if (!options.scenes.empty()) {
    throw UsageError("--stability brings its own scenes; name none");
  }
  StabilityPlan plan;
  plan.cases = options.stability_cases;
  plan.seed = options.seed;
  plan.structures = stability_structures(options);
  plan.cpu = std::find(devices.begin(), devices.end(), Device::cpu) != devices.end();
  if (options.full) {
    plan.size = accel::StabilitySize::full;
    plan.watertight_rays = 10'000'000;
    plan.reference_tests = 1e9;
  }
  GpuContext gpu(options.gl_device);
  if (std::find(devices.begin(), devices.end(), Device::gpu) != devices.end()) {
    plan.gpu = gpu.get();
    terminal.info(fmt::format("GPU: {}", gpu.info().name));
  }
  std::uint64_t broken = 0;
  std::uint64_t rows = 0;
  if (!options.json) print_stability_header();
  run_stability(
      plan,
      [&](const StabilityRow& row) {
        ++rows;
        broken += row.broken.empty() ? 0 : 1;
        terminal.progress_done();
        if (options.json) {
          json.add(json_stability_row(row));
        } else {
          print_stability_row(row);
        }
        std::fflush(stdout);
      },
      [&](double share, const std::string& name) { terminal.progress(name, share); });
  terminal.progress_done();
  if (!options.json) {
    fmt::print("{} rows, {} broken limits{}\n", rows, broken, interrupted ? " (interrupted)" : "");
  }
  if (broken > 0) return ExitCode::mismatch;
  return interrupted ? ExitCode::interrupted : ExitCode::ok;
}

ExitCode verify(const VerifyOptions& options) {
  const std::vector<Device> devices = chosen_devices(options.devices);
  parse_size(options.size);
  Terminal terminal(options.quiet);
  JsonRows json(options.json);
  if (options.stability || !options.stability_cases.empty()) {
    const ExitCode result = verify_stability(options, devices, json, terminal);
    json.end();
    return result;
  }
  ExitCode result = ExitCode::ok;
  for (const Device device : devices) {
    const ExitCode one = device == Device::cpu ? verify_cpu(options, json, terminal)
                                               : verify_gpu(options, json, terminal);
    // A mismatch is what one wants to hear of first.
    if (result == ExitCode::ok || one == ExitCode::mismatch) result = one;
    if (interrupted) break;
  }
  json.end();
  return result;
}

}  // namespace

void add_verify_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "verify",
      "Compare every structure's hits with brute force, and that with an exact oracle; or the "
      "GPU's with the CPU's");
  const auto options = std::make_shared<VerifyOptions>();
  add_scene_options(*command, *options, true);
  add_structure_options(*command, *options, true);
  add_output_options(*command, *options);
  command
      ->add_option("--rays", options->rays,
                   "Rays of each kind at most; large scenes get fewer, since the reference "
                   "tests every triangle (default 20000)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}));
  command->add_option("--seed", options->seed, "Seed of the random rays (default 1)");
  command->add_option("--time", options->time_s, "Time of the animation in seconds (default 0)");
  command->add_option(
      "--device", options->devices,
      "cpu (default): its structures against brute force; gpu: its hits against the "
      "CPU's, in all sample scenes if none is named; or cpu,gpu");
  command->add_option("--size", options->size,
                      "--device gpu: side, or WIDTHxHEIGHT, of the camera's picture, every pixel "
                      "of which is compared (default 256)");
  command->add_option("--images", options->images,
                      "--device gpu: folder for both pictures and their difference");
  command->add_option("--max-triangles", options->max_triangles,
                      "Leave out scenes of more triangles");
  command->add_flag("--stability", options->stability,
                    "Extreme geometry instead of scenes: every structure by every intersection "
                    "test, against limits");
  command
      ->add_option("--stability-cases", options->stability_cases,
                   "Only these cases of --stability, by name: a,b")
      ->delimiter(',');
  command->add_flag("--full", options->full,
                    "--stability: up to a million triangles a case, 2^24 in one, and 10^7 rays at "
                    "the edges and vertices of each closed mesh");
  add_gl_device_option(*command, options->gl_device);
  command->footer(
      "Ray kinds: the scene's camera, from outside, inside and far away, along axes, inside the\n"
      "structure's own planes, starting on surfaces, aimed at edges and vertices, and with "
      "limited\n"
      "reach. The columns missed, invented, triangle, distance and any count answers that differ;\n"
      "edge counts ties and rounding edges against the exact oracle, which are not mistakes.\n"
      "Exit code 6 if anything differs; with --device gpu if anything differs that neither a tie, "
      "an\n"
      "edge passed within rounding nor one rounding of t, u or v explains, or if more than 0.01 % "
      "of\n"
      "the pixels differ.");
  command->callback([options, &result] { result = verify(*options); });
}

}  // namespace encore::app
