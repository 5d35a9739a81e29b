#include "app/bench/bench.h"

#include "app/commands/commands.h"
#include "app/interrupt.h"
#include "app/terminal.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <memory>

namespace encore::app {

namespace {

struct BenchOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> parts;
  std::vector<std::string> structures;
  std::vector<std::string> rays;
  std::vector<int> threads;
  std::vector<std::string> loading;
  std::uint64_t subdivide = 1;
  std::uint64_t seed = 1;
  int rounds = 0;
  int side = 0;
  std::string csv;
  bool quick = false;
  bool quiet = false;
};

std::vector<std::string_view> part_names() {
  std::vector<std::string_view> names;
  for (const bench::Part part : bench::all_parts()) names.push_back(to_string(part));
  return names;
}

bench::Part parse_part(const std::string& name) {
  for (const bench::Part part : bench::all_parts()) {
    if (to_string(part) == name) return part;
  }
  throw UsageError(fmt::format("unknown part '{}'; there are {}{}", name,
                               fmt::join(part_names(), ", "),
                               scene::did_you_mean(name, part_names())));
}

std::vector<std::string_view> structure_names() {
  std::vector<std::string_view> names;
  for (const accel::StructureKind kind : accel::all_structure_kinds()) {
    if (kind != accel::StructureKind::brute) names.push_back(accel::to_string(kind));
  }
  return names;
}

accel::StructureKind parse_structure(const std::string& name) {
  const auto kind = accel::parse_structure_kind(name);
  if (kind && *kind != accel::StructureKind::brute) return *kind;
  throw UsageError(fmt::format("unknown structure '{}'; there are {}{}", name,
                               fmt::join(structure_names(), ", "),
                               scene::did_you_mean(name, structure_names())));
}

bench::BenchPlan plan_of(const BenchOptions& options) {
  bench::BenchPlan plan = options.quick ? bench::quick_plan() : bench::BenchPlan{};
  if (!options.scenes.empty()) plan.scenes = options.scenes;
  if (!options.threads.empty()) plan.threads = options.threads;
  if (options.rounds > 0) plan.rounds = options.rounds;
  if (options.side > 0) plan.side = options.side;
  if (!options.parts.empty()) plan.parts.clear();
  for (const std::string& part : options.parts) plan.parts.push_back(parse_part(part));
  if (plan.side % bench::RaySet::kTileSide != 0) {
    throw UsageError(
        fmt::format("--size takes a multiple of {}, not {}", bench::RaySet::kTileSide, plan.side));
  }
  for (const std::string& name : options.structures) {
    plan.structures.push_back(parse_structure(name));
  }
  plan.rays = options.rays;
  plan.subdivide = options.subdivide;
  plan.seed = options.seed;
  plan.loading = options.loading;
  plan.csv = options.csv;
  return plan;
}

ExitCode bench_command(const BenchOptions& options) {
  const bench::BenchPlan plan = plan_of(options);
  Terminal terminal(options.quiet);
  bench::BenchReport report(plan.csv, [&] { terminal.progress_done(); });
  bench::Bench run{.plan = plan,
                   .report = report,
                   .cancel = &interrupted,
                   .on_progress = [&](const std::string& what, double share) {
                     terminal.progress("bench: " + what, share);
                   }};
  run_bench(run);
  terminal.progress_done();
  return interrupted ? ExitCode::interrupted : ExitCode::ok;
}

}  // namespace

void add_bench_command(CLI::App& app, ExitCode& result) {
  auto* command = app.add_subcommand(
      "bench",
      "Race the building, updating and tracing of structures against Embree's, in this process");
  const auto options = std::make_shared<BenchOptions>();
  command->add_option("scenes", options->scenes,
                      "Sample scenes, scene files or model files, or soup (a million triangles "
                      "without order; soup:COUNT); @4, @16 … behind one splits every triangle "
                      "(default: toys bunny bunny@16 hall soup)");
  command
      ->add_option(
          "--parts", options->parts,
          fmt::format("{} (default: all), separated by commas", fmt::join(part_names(), ", ")))
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--threads,-t", options->threads,
                   "Numbers of threads, separated by commas (default 1,2)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(1, 4096));
  command
      ->add_option("--structure,-s", options->structures,
                   "Structures, separated by commas (default: all but brute)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--rays", options->rays,
                   "Part trace: primary, close (the camera zoomed in), bounce, shadow, separated "
                   "by commas (default: all)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"primary", "close", "bounce", "shadow"}));
  command
      ->add_option("--loading", options->loading,
                   "Part loading: a file to read instead of those it writes (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--subdivide", options->subdivide,
                      "Split every triangle of every scene into so many: 4, 16, 64 …");
  command->add_option("--seed", options->seed, "Seed of the bounce rays (default 1)");
  command->add_option("--repeats", options->rounds, "Rounds of each race (default 5)")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--size", options->side,
                   "Side of the pictures in pixels, a multiple of 32 (default 1024)")
      ->check(CLI::Range(32, 16384));
  command->add_option("--csv", options->csv, "File for all rows");
  command->add_flag("--quick", options->quick, "Seconds instead of most of an hour: a small scene");
  command->add_flag("--quiet,-q", options->quiet, "No progress");
  command->footer(
      "Peers: fast presets and grids against Embree's LOW, bvh-sah balanced, bvh-median and\n"
      "kd-median against MEDIUM, bvh-sah best and kd-sah against HIGH; moller-trumbore against\n"
      "plain scenes, watertight and precise against robust ones. Parts: tests/bench/README.md.\n"
      "Interrupted, it prints and saves what there is.");
  command->callback([options, &result] { result = bench_command(*options); });
}

}  // namespace encore::app
