// Build, refit and trace times of every structure, and Embree's in the same run. See README.md.
#include "accel/make_structure.h"
#include "tests/bench/bench_scene.h"
#include "tests/bench/table_reporter.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>

#if defined(ENCORE_HAVE_EMBREE)
#include "tests/bench/embree_reference.h"
#endif

namespace encore::bench {
namespace {

using accel::StructureKind;
using ScenePointer = std::shared_ptr<const BenchScene>;

constexpr const char* kReference = "embree-medium";

/// Registers one benchmark that runs `body` in each iteration. `prepare` runs once, before the
/// first of them is timed; `after` may set counters.
void add(TableReporter& reporter, const BenchCase& bench_case, std::function<void()> prepare,
         std::function<void()> body, std::function<void(benchmark::State&)> after = {}) {
  reporter.add(bench_case);
  auto prepared = std::make_shared<bool>(false);
  benchmark::RegisterBenchmark(bench_case.name().c_str(),
                               [=](benchmark::State& state) {
                                 if (!*prepared) prepare();
                                 *prepared = true;
                                 for (auto _ : state) body();
                                 if (after) after(state);
                               })
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
}

void count_hits(benchmark::State& state, const std::vector<scene::Hit>& hits) {
  state.counters["hits"] = static_cast<double>(
      std::count_if(hits.begin(), hits.end(), [](const scene::Hit& h) { return h.found(); }));
}

/// `structure` is anything with build(triangles) and intersect(rays, hits), made when first needed.
template <class Structure>
void add_build_and_trace(TableReporter& reporter, const ScenePointer& scene,
                         const std::string& name,
                         std::function<std::unique_ptr<Structure>()> make) {
  auto structure = std::make_shared<std::unique_ptr<Structure>>();
  const auto prepare = [=] {
    if (*structure) return;
    *structure = make();
    (*structure)->build(scene->triangles);
  };
  add(reporter,
      {"build", scene->name, name, kReference, static_cast<double>(scene->triangles.size())},
      prepare, [=] { (*structure)->build(scene->triangles); });
  auto hits = std::make_shared<std::vector<scene::Hit>>(scene->rays.size());
  add(
      reporter, {"trace", scene->name, name, kReference, static_cast<double>(scene->rays.size())},
      prepare, [=] { (*structure)->intersect(scene->rays, *hits); },
      [=](benchmark::State& state) { count_hits(state, *hits); });
}

/// Update times of one structure; the scene's two states take turns if `moving`.
template <class Structure>
void add_refit(TableReporter& reporter, const ScenePointer& scene, const std::string& name,
               bool moving, std::function<std::unique_ptr<Structure>()> make_built,
               std::function<void(Structure&, std::span<const scene::Triangle>)> refit) {
  auto structure = std::make_shared<std::unique_ptr<Structure>>();
  auto frame = std::make_shared<int>(0);
  add(
      reporter,
      {"refit", scene->name, name, "embree, all moved",
       static_cast<double>(scene->triangles.size())},
      [=] { *structure = make_built(); },
      [=] {
        const bool moved = moving && ++*frame % 2 == 1;
        refit(**structure, moved ? scene->moved : scene->triangles);
      });
}

void add_structures(TableReporter& reporter, const ScenePointer& scene) {
  for (const StructureKind kind : accel::all_structure_kinds()) {
    if (kind == StructureKind::brute) continue;
    accel::StructureSpec spec = accel::default_spec(kind);
    const std::string name(to_string(kind));
    add_build_and_trace<accel::AccelerationStructure>(
        reporter, scene, name, [spec] { return accel::make_structure(spec); });
    if (!accel::make_structure(spec)->can_refit()) continue;
    for (const accel::UpdateCase update_case :
         {accel::UpdateCase::real, accel::UpdateCase::best, accel::UpdateCase::average,
          accel::UpdateCase::worst}) {
      accel::BvhSettings settings;
      settings.update_case = update_case;
      spec.settings = settings;
      const bool moving = update_case == accel::UpdateCase::real;
      add_refit<accel::AccelerationStructure>(
          reporter, scene,
          name + ", " + (moving ? "all moved" : std::string(to_string(update_case))), moving,
          [=] {
            auto structure = accel::make_structure(spec);
            structure->build(scene->triangles);
            return structure;
          },
          [](accel::AccelerationStructure& s, std::span<const scene::Triangle> t) { s.update(t); });
    }
  }
}

#if defined(ENCORE_HAVE_EMBREE)
void add_embree(TableReporter& reporter, const ScenePointer& scene) {
  using Quality = EmbreeReference::Quality;
  for (const Quality quality : {Quality::low, Quality::medium}) {
    add_build_and_trace<EmbreeReference>(
        reporter, scene, quality == Quality::low ? "embree-low" : kReference,
        [quality] { return std::make_unique<EmbreeReference>(quality); });
  }
  add_refit<EmbreeReference>(
      reporter, scene, "embree, all moved", true,
      [scene] {
        auto embree = std::make_unique<EmbreeReference>(Quality::medium);
        embree->build_refittable(scene->triangles);
        return embree;
      },
      [](EmbreeReference& e, std::span<const scene::Triangle> t) { e.refit(t); });
}
#else
void add_embree(TableReporter&, const ScenePointer&) {}
#endif

int run(int argc, char** argv) {
  // Our defaults go first, so that the user's own options overrule them.
  std::vector<std::string> defaults = {argv[0], "--benchmark_repetitions=5",
                                       "--benchmark_min_time=0.02",
                                       "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> arguments;
  for (std::string& text : defaults) arguments.push_back(text.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());

  // What is left are scenes and model files.
  std::vector<std::string> scenes(arguments.begin() + 1, arguments.begin() + count);
  for (const std::string& scene : scenes) {
    if (scene.starts_with("-")) {
      fmt::print(stderr, "unknown option {}; scenes, model files or --benchmark_...\n", scene);
      return 2;
    }
  }
  if (scenes.empty()) scenes = default_bench_scenes();
  TableReporter reporter;
  for (const std::string& name : scenes) {
    const auto scene = std::make_shared<const BenchScene>(load_bench_scene(name));
    add_structures(reporter, scene);
    add_embree(reporter, scene);
  }
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace encore::bench

int main(int argc, char** argv) {
  try {
    return encore::bench::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
