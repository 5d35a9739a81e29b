#include "accel/make_structure.h"
#include "app/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace encore::app::bench {

namespace {

constexpr EmbreeQuality kQualities[] = {EmbreeQuality::low, EmbreeQuality::medium,
                                        EmbreeQuality::high};

/// Quick builds are for scenes that change every frame: Embree's are quickest where the scene is
/// kept.
std::vector<EmbreeSettings> peer_settings(EmbreeQuality quality) {
  if (quality != EmbreeQuality::low) return {{.quality = quality}};
  return {{.quality = quality}, {.quality = quality, .dynamic = true}};
}

}  // namespace

void bench_build(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree) {
  // A race a quality, so that ours and its peer are not far apart in time.
  const std::vector<Contestant> all = contestants(bench.plan);
  for (const EmbreeQuality quality : kQualities) {
    if (bench.cancelled()) return;
    if (std::none_of(all.begin(), all.end(),
                     [&](const Contestant& c) { return c.peer == quality; })) {
      continue;
    }
    std::vector<Runner> runners;
    std::vector<std::unique_ptr<EmbreeScene>> peers;
    for (const EmbreeSettings& settings : peer_settings(quality)) {
      if (embree == nullptr) break;
      auto* peer = peers.emplace_back(std::make_unique<EmbreeScene>(*embree, settings)).get();
      runners.push_back({embree_name(settings), [&, peer] { peer->build(scene.triangles); }});
    }
    std::vector<std::unique_ptr<accel::AccelerationStructure>> structures;
    for (const Contestant& contestant : all) {
      if (contestant.peer != quality) continue;
      auto* structure = structures.emplace_back(accel::make_structure(contestant.spec)).get();
      structure->set_build_threads(threads);
      runners.push_back({contestant.name, [&, structure] { structure->build(scene.triangles); }});
    }
    bench.progress(fmt::format("building {} against {}", scene.name, to_string(quality)));
    const RaceTimes times = race(runners, bench.race_settings(threads));
    if (times.front().empty()) return;
    const auto triangles = static_cast<double>(scene.triangles.size());
    for (std::size_t k = peers.size(); k < runners.size(); ++k) {
      BenchRow frame{.part = "build",
                     .scene = scene.name,
                     .triangles = scene.triangles.size(),
                     .threads = threads,
                     .operation = "build",
                     .ours = runners[k].name,
                     .unit = "Mtri/s"};
      for (std::size_t peer = 0; peer < peers.size(); ++peer) {
        frame.peer = runners[peer].name;
        bench.report.add(rate_row(frame, triangles, times[k], triangles, &times[peer]));
      }
      if (peers.empty()) bench.report.add(rate_row(frame, triangles, times[k], 1.0, nullptr));
    }
  }
}

}  // namespace encore::app::bench
