#pragma once

#include "accel/settings.h"
#include "app/bench/bench_scene.h"
#include "app/bench/embree.h"
#include "app/bench/race.h"
#include "app/bench/report.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace encore::app::bench {

enum class Part { build, refit, trace, scaling, dynamic, loading };
std::string_view to_string(Part part);
const std::vector<Part>& all_parts();

/// What `encore bench` is asked for.
struct BenchPlan {
  std::vector<Part> parts = all_parts();
  std::vector<std::string> scenes = default_bench_scenes();
  std::uint64_t subdivide = 1;
  std::vector<int> threads = {1, 2};
  std::vector<accel::StructureKind> structures;  ///< empty: all but brute force
  std::vector<std::string> rays;                 ///< kinds of the part trace; empty: all
  std::vector<std::string> moving = {"toys"};    ///< scenes of the part dynamic
  std::string loading_scene = "bunny@16";        ///< what the part loading writes
  std::vector<std::string> loading;  ///< files of the part loading; empty: it writes its own
  int side = 1024;                   ///< of the pictures, in pixels; a multiple of 32
  int rounds = 5;
  double least_s = 0.03;   ///< of a sample
  double budget_s = 12.0;  ///< of a race: none begins another round after that, once it has three
  int frames = 6;          ///< of a round of the part dynamic
  std::size_t copy_bytes = std::size_t{256} << 20U;  ///< of the copy beside the refits
  std::uint64_t seed = 1;
  std::string csv;
};

/// The plan of --quick: seconds on small scenes, for a look and for tests.
BenchPlan quick_plan();

/// What all parts have at hand.
struct Bench {
  const BenchPlan& plan;
  BenchReport& report;
  const std::atomic<bool>* cancel = nullptr;
  /// Is told what is being done, and what share of all was done before, in [0, 1].
  std::function<void(const std::string&, double)> on_progress;
  int steps = 0;  ///< begun so far

  [[nodiscard]] bool cancelled() const { return cancel != nullptr && cancel->load(); }
  [[nodiscard]] RaceSettings race_settings(int threads) const;
  /// The next step begins.
  void progress(const std::string& what);
};

/// One way of ours to organise a scene, and the quality of Embree's that it stands beside.
struct Contestant {
  std::string name;
  accel::StructureSpec spec;
  EmbreeQuality peer;
};
/// Those of the plan's structures, bvh-sah with each of its presets.
std::vector<Contestant> contestants(const BenchPlan& plan);

/// Everything that the plan asks for, part by part; ends early, with what there is, if cancelled.
void run_bench(Bench& bench);

// The parts. `embree` is null where there is none.
void bench_build(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree);
void bench_refit(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree);
void bench_trace(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree);
/// Speed of several threads over one's; nothing for one.
void bench_speedup(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree);
/// What becomes of the building rate and of the memory with 16 times the triangles. Opens a device
/// of its own.
void bench_growth(Bench& bench, const BenchScene& scene);
void bench_memory(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree);
/// Moving scenes frame by frame, with all threads. Opens a device of its own.
void bench_dynamic(Bench& bench);
/// Files to their first picture.
void bench_loading(Bench& bench);

/// A row with the medians of the times of both as rates (`items` a run, in units of 1e6) and the
/// ratios of their pairs; `peer` may be null.
BenchRow rate_row(const BenchRow& frame, double items, const std::vector<double>& ours,
                  double peer_items, const std::vector<double>* peer);

}  // namespace encore::app::bench
