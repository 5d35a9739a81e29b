#include "app/bench/bench.h"

#include "accel/simd/isa.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace encore::app::bench {

namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

bool wants(const BenchPlan& plan, Part part) {
  return std::find(plan.parts.begin(), plan.parts.end(), part) != plan.parts.end();
}

/// Sixteen times as many triangles are about a million at most.
bool worth_growing(const BenchScene& scene) {
  return !scene.triangles.empty() && scene.triangles.size() <= std::size_t{1} << 17U;
}

/// About how many steps there will be.
int expected_steps(const BenchPlan& plan) {
  const auto count = [&](Part part, int steps) { return wants(plan, part) ? steps : 0; };
  const int each = count(Part::build, 3) + count(Part::refit, 1) + count(Part::trace, 13) +
                   count(Part::scaling, 2);
  return static_cast<int>(plan.scenes.size() * plan.threads.size()) * each +
         count(Part::dynamic, 1) + count(Part::loading, 4);
}

void say_head(const Bench& bench) {
  const auto embree = EmbreeDevice::open(1);
  bench.report.say(fmt::format("Machine: {}, {} cores; instruction set {}", processor_name(),
                               std::thread::hardware_concurrency(),
                               accel::to_string(accel::chosen_isa())));
  bench.report.say(embree != nullptr
                       ? "Peer: Embree " + embree->version()
                       : "No Embree 3 here: its rows are left out (install libembree-dev, build "
                         "again)");
  bench.report.say(
      "Ratios are of speeds, round by round, ours and its peer's taking turns: over 1, ours is\n"
      "faster. One thread: processor time; more: wall time. noise: slowest round over quickest.");
}

}  // namespace

std::string_view to_string(Part part) {
  switch (part) {
    case Part::build:
      return "build";
    case Part::refit:
      return "refit";
    case Part::trace:
      return "trace";
    case Part::scaling:
      return "scaling";
    case Part::dynamic:
      return "dynamic";
    default:
      return "loading";
  }
}

const std::vector<Part>& all_parts() {
  static const std::vector<Part> all = {Part::build,   Part::refit,   Part::trace,
                                        Part::scaling, Part::dynamic, Part::loading};
  return all;
}

BenchPlan quick_plan() {
  BenchPlan plan;
  plan.scenes = {"cow"};
  plan.moving = {"toys"};
  plan.loading_scene = "cow";
  plan.side = 128;
  plan.rounds = 3;
  plan.least_s = 0.002;
  plan.budget_s = 1.0;
  plan.frames = 2;
  plan.copy_bytes = std::size_t{16} << 20U;
  return plan;
}

RaceSettings Bench::race_settings(int threads) const {
  return {.rounds = plan.rounds,
          .least_s = plan.least_s,
          .budget_s = plan.budget_s,
          .threads = threads,
          .cancel = cancel};
}

void Bench::progress(const std::string& what) {
  if (on_progress) {
    on_progress(what, std::min(0.99, static_cast<double>(steps) / expected_steps(plan)));
  }
  ++steps;
}

std::vector<Contestant> contestants(const BenchPlan& plan) {
  using accel::StructureKind;
  const auto plain = [](StructureKind kind, EmbreeQuality peer) {
    return Contestant{std::string(to_string(kind)), accel::default_spec(kind), peer};
  };
  const auto preset = [](accel::BuildPreset p, EmbreeQuality peer) {
    Contestant c{"bvh-sah " + std::string(to_string(p)),
                 accel::default_spec(StructureKind::bvh_sah), peer};
    accel::BvhSettings settings;
    settings.preset = p;
    c.spec.settings = settings;
    return c;
  };
  std::vector<Contestant> all = {preset(accel::BuildPreset::fast, EmbreeQuality::low),
                                 preset(accel::BuildPreset::balanced, EmbreeQuality::medium),
                                 preset(accel::BuildPreset::best, EmbreeQuality::high)};
  all.push_back(plain(StructureKind::grid_box, EmbreeQuality::low));
  all.push_back(plain(StructureKind::grid_exact, EmbreeQuality::low));
  all.push_back(plain(StructureKind::bvh_median, EmbreeQuality::medium));
  all.push_back(plain(StructureKind::kd_median, EmbreeQuality::medium));
  all.push_back(plain(StructureKind::kd_sah, EmbreeQuality::high));
  if (plan.structures.empty()) return all;
  std::erase_if(all, [&](const Contestant& c) {
    return std::find(plan.structures.begin(), plan.structures.end(), c.spec.kind) ==
           plan.structures.end();
  });
  return all;
}

BenchRow rate_row(const BenchRow& frame, double items, const std::vector<double>& ours,
                  double peer_items, const std::vector<double>* peer) {
  BenchRow row = frame;
  const Spread mine = spread_of(ours);
  row.our_value = mine.median > 0.0 ? items / mine.median * 1e-6 : 0.0;
  row.noise = mine.min > 0.0 ? mine.max / mine.min : 0.0;
  row.repeats = ours.size();
  if (peer == nullptr) {
    row.peer.clear();
    return row;
  }
  const Spread theirs = spread_of(*peer);
  row.peer_value = theirs.median > 0.0 ? peer_items / theirs.median * 1e-6 : 0.0;
  const double each = items / peer_items;
  row.ratio = speed_ratio(ours, *peer);
  row.ratio = {each * row.ratio.min, each * row.ratio.median, each * row.ratio.max};
  return row;
}

void run_bench(Bench& bench) {
  const BenchPlan& plan = bench.plan;
  say_head(bench);
  const bool scenes = wants(plan, Part::build) || wants(plan, Part::refit) ||
                      wants(plan, Part::trace) || wants(plan, Part::scaling);
  for (const std::string& name : plan.scenes) {
    if (bench.cancelled() || !scenes) break;
    bench.progress("loading " + name);
    const BenchScene scene = load_bench_scene(name, plan.subdivide);
    for (const int threads : plan.threads) {
      if (bench.cancelled()) break;
      // One device at a time: each limits the threads of the whole process.
      const auto embree = EmbreeDevice::open(threads);
      if (wants(plan, Part::build)) bench_build(bench, scene, threads, embree.get());
      if (wants(plan, Part::refit)) bench_refit(bench, scene, threads, embree.get());
      if (wants(plan, Part::trace)) bench_trace(bench, scene, threads, embree.get());
      if (wants(plan, Part::scaling)) bench_speedup(bench, scene, threads, embree.get());
    }
    if (wants(plan, Part::scaling) && worth_growing(scene)) bench_growth(bench, scene);
  }
  if (wants(plan, Part::dynamic)) bench_dynamic(bench);
  if (wants(plan, Part::loading)) bench_loading(bench);
  if (bench.cancelled()) bench.report.say("\nInterrupted: this is what there is.");
}

}  // namespace encore::app::bench
