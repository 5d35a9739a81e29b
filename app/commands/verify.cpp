#include "app/commands/commands.h"
#include "app/common_options.h"
#include "app/interrupt.h"
#include "app/json_text.h"
#include "app/verification.h"
#include "scene/sample_scenes.h"

#include <fmt/format.h>

#include <memory>

namespace encore::app {

namespace {

struct VerifyOptions : CommonOptions {
  std::size_t rays = VerificationPlan{}.rays_per_kind;
  std::uint64_t seed = 1;
  double time_s = 0.0;
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
      "{{\"scene\": {}, \"triangles\": {}, \"structure\": {}, \"action\": {}, \"against\": {}, "
      "\"rays\": {}, \"hits\": {}, \"missed\": {}, \"invented\": {}, \"wrong_triangle\": {}, "
      "\"wrong_distance\": {}, \"wrong_occlusion\": {}, \"edge_cases\": {}}}",
      json_text(scene), row.triangles, json_text(row.structure), json_text(row.action),
      json_text(row.against), h.rays, h.hits, h.missed, h.invented, h.wrong_triangle,
      h.wrong_distance, h.wrong_occlusion, row.edge_cases);
}

ExitCode verify(const VerifyOptions& options) {
  Terminal terminal(options.quiet);
  std::vector<std::string> names = options.scenes;
  if (names.empty()) names.emplace_back(scene::kDefaultSceneName);

  VerificationPlan plan;
  plan.rays_per_kind = options.rays;
  plan.seed = options.seed;
  plan.time_s = options.time_s;
  std::uint64_t mismatches = 0;
  std::uint64_t rays = 0;
  const char* separator = "[\n  ";
  bool header_printed = options.json;
  for (const std::string& name : names) {
    const scene::Scene scene = open_scene(name, options, terminal);
    const auto specs = chosen_structures(options, scene);
    const auto rows = verify_scene(scene, specs, plan, [&](double share) {
      terminal.progress("verifying " + scene.name, share);
    });
    terminal.progress_done();
    if (!header_printed) print_header();
    header_printed = true;
    for (const VerificationRow& row : rows) {
      mismatches += row.hits.mismatches();
      rays += row.hits.rays;
      if (options.json) {
        fmt::print("{}{}", separator, json_row(scene.name, row));
        separator = ",\n  ";
      } else {
        print_row(scene.name, row);
        if (row.hits.mismatches() > 0) print_first_mismatch(row);
      }
    }
    std::fflush(stdout);
    if (interrupted) break;
  }
  if (options.json) {
    fmt::print("\n]\n");
  } else {
    fmt::print("{} rays compared, {} mismatches{}\n", rays, mismatches,
               interrupted ? " (interrupted)" : "");
  }
  if (mismatches > 0) return ExitCode::mismatch;
  return interrupted ? ExitCode::interrupted : ExitCode::ok;
}

}  // namespace

void add_verify_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "verify", "Compare every structure's hits with brute force, and that with an exact oracle");
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
  command->footer(
      "Ray kinds: the scene's camera, from outside, inside and far away, along axes, inside the\n"
      "structure's own planes, starting on surfaces, aimed at edges and vertices, and with "
      "limited\n"
      "reach. The columns missed, invented, triangle, distance and any count answers that differ;\n"
      "edge counts ties and rounding edges against the exact oracle, which are not mistakes.\n"
      "Exit code 6 if anything differs.");
  command->callback([options, &result] { result = verify(*options); });
}

}  // namespace encore::app
