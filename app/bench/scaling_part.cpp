#include "accel/make_structure.h"
#include "app/bench/bench.h"
#include "app/bench/tracing.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>

namespace encore::app::bench {

namespace {

/// Holds the whole process to so many threads.
tbb::global_control at_most(int threads) {
  return {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)};
}

/// Something done in two ways, each timed by itself: few and many triangles, or one thread and
/// several.
struct Doubled {
  std::string name;
  EmbreeQuality quality = EmbreeQuality::medium;
  bool ours = true;
  std::size_t first = 0;  ///< its runners
  std::size_t second = 0;
};

struct DoubledRace {
  std::vector<Runner> runners;
  std::vector<Doubled> all;

  void add(const std::string& name, EmbreeQuality quality, bool ours,
           std::function<void()> first_run, std::function<void()> second_run) {
    all.push_back({name, quality, ours, runners.size(), runners.size() + 1});
    runners.push_back({name, std::move(first_run)});
    runners.push_back({name, std::move(second_run)});
  }
};

/// Round by round first / second of one of them, times `factor`.
std::vector<double> quotients(const RaceTimes& times, const Doubled& d, double factor) {
  std::vector<double> result;
  for (std::size_t i = 0; i < times[d.first].size(); ++i) {
    result.push_back(factor * times[d.first][i] / times[d.second][i]);
  }
  return result;
}

/// A row for each of ours: its quotient beside its peer's. `factor`: what a quotient of 1 means.
void add_rows(Bench& bench, const BenchRow& frame, const DoubledRace& doubled,
              const RaceTimes& times, double factor) {
  if (times.empty() || times.front().empty()) return;
  for (const Doubled& mine : doubled.all) {
    if (!mine.ours) continue;
    const std::vector<double> ours = quotients(times, mine, factor);
    BenchRow row = frame;
    row.ours = mine.name;
    row.our_value = spread_of(ours).median;
    row.repeats = ours.size();
    const Spread spread = spread_of(ours);
    row.noise = spread.min > 0.0 ? spread.max / spread.min : 0.0;
    for (const Doubled& peer : doubled.all) {
      if (peer.ours || peer.quality != mine.quality) continue;
      const std::vector<double> theirs = quotients(times, peer, factor);
      row.peer = peer.name;
      row.peer_value = spread_of(theirs).median;
      row.ratio = speed_ratio(theirs, ours);
    }
    bench.report.add(row);
  }
}

/// Everybody's structure over two scenes, or one scene twice.
struct Builders {
  std::vector<std::unique_ptr<accel::AccelerationStructure>> structures;
  std::vector<std::unique_ptr<EmbreeScene>> peers;

  accel::AccelerationStructure* make(const Contestant& contestant, int threads) {
    auto* structure = structures.emplace_back(accel::make_structure(contestant.spec)).get();
    structure->set_build_threads(threads);
    return structure;
  }
  EmbreeScene* make(EmbreeDevice& device, EmbreeQuality quality) {
    return peers
        .emplace_back(std::make_unique<EmbreeScene>(device, EmbreeSettings{.quality = quality}))
        .get();
  }
};

std::vector<EmbreeQuality> qualities_of(const std::vector<Contestant>& all) {
  std::vector<EmbreeQuality> qualities;
  for (const Contestant& c : all) {
    if (std::find(qualities.begin(), qualities.end(), c.peer) == qualities.end()) {
      qualities.push_back(c.peer);
    }
  }
  return qualities;
}

/// What a triangle costs in the small scene over what it costs in the large one; 1: the same.
void growth(Bench& bench, const BenchScene& small, const BenchScene& large, EmbreeDevice* embree) {
  bench.progress(fmt::format("building {} and {}", small.name, large.name));
  Builders builders;
  DoubledRace doubled;
  const std::vector<Contestant> all = contestants(bench.plan);
  for (const EmbreeQuality quality : qualities_of(all)) {
    if (embree == nullptr) break;
    EmbreeScene* one = builders.make(*embree, quality);
    EmbreeScene* other = builders.make(*embree, quality);
    doubled.add(
        embree_name({.quality = quality}), quality, false,
        [&, one] { one->build(small.triangles); }, [&, other] { other->build(large.triangles); });
  }
  for (const Contestant& contestant : all) {
    auto* one = builders.make(contestant, 1);
    auto* other = builders.make(contestant, 1);
    doubled.add(
        contestant.name, contestant.peer, true, [&, one] { one->build(small.triangles); },
        [&, other] { other->build(large.triangles); });
  }
  const RaceTimes times = race(doubled.runners, bench.race_settings(1));
  const BenchRow frame{
      .part = "scaling",
      .scene = large.name,
      .triangles = large.triangles.size(),
      .threads = 1,
      .operation = fmt::format("rate x{:.0f}", static_cast<double>(large.triangles.size()) /
                                                   static_cast<double>(small.triangles.size())),
      .unit = "kept"};
  add_rows(
      bench, frame, doubled, times,
      static_cast<double>(large.triangles.size()) / static_cast<double>(small.triangles.size()));
}

/// Races what was doubled, one thread against several, and adds the rows.
void add_speedups(Bench& bench, const BenchScene& scene, int threads, const char* operation,
                  const DoubledRace& doubled) {
  const RaceTimes times = race(doubled.runners, bench.race_settings(threads));
  add_rows(bench,
           {.part = "scaling",
            .scene = scene.name,
            .triangles = scene.triangles.size(),
            .threads = threads,
            .operation = operation,
            .unit = "x 1's"},
           doubled, times, 1.0);
}

/// One thread's time over that of several, for builds.
void build_speedup(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree) {
  bench.progress(fmt::format("building {} with 1 and {} threads", scene.name, threads));
  Builders builders;
  DoubledRace doubled;
  const std::vector<Contestant> all = contestants(bench.plan);
  for (const EmbreeQuality quality : qualities_of(all)) {
    if (embree == nullptr) break;
    EmbreeScene* peer = builders.make(*embree, quality);
    doubled.add(
        embree_name({.quality = quality}), quality, false,
        [&, peer] {
          const auto one = at_most(1);
          peer->build(scene.triangles);
        },
        [&, peer] { peer->build(scene.triangles); });
  }
  for (const Contestant& contestant : all) {
    auto* structure = builders.make(contestant, 1);
    const auto build = [&, structure](int n) {
      structure->set_build_threads(n);
      structure->build(scene.triangles);
    };
    doubled.add(
        contestant.name, contestant.peer, true, [=] { build(1); }, [=] { build(threads); });
  }
  add_speedups(bench, scene, threads, "build speed", doubled);
}

/// The same for tracing primary rays.
void trace_speedup(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree) {
  bench.progress(fmt::format("tracing {} with 1 and {} threads", scene.name, threads));
  const Rays rays(primary_rays(scene.camera, bench.plan.side));
  Builders builders;
  DoubledRace doubled;
  std::vector<std::unique_ptr<Tracing>> tracings;
  const auto add = [&](const std::string& name, EmbreeQuality quality, bool ours,
                       std::unique_ptr<Tracing> one, std::unique_ptr<Tracing> several) {
    doubled.add(
        name, quality, ours, [t = one.get()] { t->run(); }, [t = several.get()] { t->run(); });
    tracings.push_back(std::move(one));
    tracings.push_back(std::move(several));
  };
  const std::vector<Contestant> all = contestants(bench.plan);
  for (const EmbreeQuality quality : qualities_of(all)) {
    if (embree == nullptr) break;
    EmbreeScene* peer = builders.make(*embree, quality);
    peer->build(scene.triangles);
    const auto make = [&](int n) {
      return std::make_unique<EmbreeTracing>(*peer, rays, EmbreePackets::sixteen_coherent, n);
    };
    add(embree_name({.quality = quality}), quality, false, make(1), make(threads));
  }
  for (const Contestant& contestant : all) {
    auto* structure = builders.make(contestant, threads);
    structure->build(scene.triangles);
    const auto make = [&](int n) {
      return std::make_unique<OurTracing>(
          *structure, rays.set,
          OurWay{accel::IntersectionMode::moller_trumbore, accel::RayGrouping::packets, 1, n});
    };
    add(contestant.name, contestant.peer, true, make(1), make(threads));
  }
  add_speedups(bench, scene, threads, "trace speed", doubled);
}

}  // namespace

void bench_growth(Bench& bench, const BenchScene& scene) {
  constexpr std::size_t kPieces = 16;
  if (bench.cancelled() || scene.triangles.empty()) return;
  BenchScene large = scene;
  large.triangles = split_in_four(split_in_four(scene.triangles));
  large.moved.clear();
  large.name = fmt::format("{}@{}", scene.name, kPieces);
  const auto embree = EmbreeDevice::open(1);
  growth(bench, scene, large, embree.get());
  if (!bench.cancelled()) bench_memory(bench, large, 1, embree.get());
}

void bench_speedup(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree) {
  if (threads == 1 || scene.triangles.empty()) return;
  if (!bench.cancelled()) build_speedup(bench, scene, threads, embree);
  if (!bench.cancelled()) trace_speedup(bench, scene, threads, embree);
}

}  // namespace encore::app::bench
