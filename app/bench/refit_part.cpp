#include "accel/make_structure.h"
#include "accel/parallel.h"
#include "app/bench/bench.h"

#include <fmt/format.h>

#include <cstring>
#include <memory>

namespace encore::app::bench {

namespace {

constexpr std::size_t kCopyPart = std::size_t{4} << 20U;

/// A copy large enough to come from memory, not from a cache.
class LargeCopy {
 public:
  explicit LargeCopy(std::size_t bytes) : from_(bytes, 1), to_(bytes) {}
  void run(int threads) {
    from_[0] = static_cast<char>(from_[0] + 1);
    accel::Workers workers(threads);
    workers.run([&] {
      workers.for_parts(from_.size(), kCopyPart, [&](std::size_t begin, std::size_t end) {
        std::memcpy(to_.data() + begin, from_.data() + begin, end - begin);
      });
    });
  }
  /// Read and written.
  [[nodiscard]] double bytes() const { return 2.0 * static_cast<double>(from_.size()); }

 private:
  std::vector<char> from_, to_;
};

/// Fits to the scene's two states in turn.
template <class Fit>
Runner refit_runner(const std::string& name, const BenchScene& scene, Fit fit) {
  auto odd = std::make_shared<bool>(false);
  return {name, [=, &scene] {
            *odd = !*odd;
            fit(*odd ? scene.moved : scene.triangles);
          }};
}

struct Refits {
  std::vector<std::unique_ptr<accel::AccelerationStructure>> structures;
  std::vector<std::unique_ptr<EmbreeScene>> peers;
  std::vector<Runner> runners;  ///< the peers first
};

Refits make_refits(const Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree) {
  Refits refits;
  if (embree != nullptr) {
    for (const bool compact : {false, true}) {
      const EmbreeSettings settings{
          .quality = EmbreeQuality::low, .compact = compact, .refit = true};
      EmbreeScene* peer =
          refits.peers.emplace_back(std::make_unique<EmbreeScene>(*embree, settings)).get();
      peer->build(scene.triangles);
      refits.runners.push_back(refit_runner(
          embree_name(settings), scene,
          [peer](std::span<const scene::Triangle> triangles) { peer->refit(triangles); }));
    }
  }
  for (const Contestant& contestant : contestants(bench.plan)) {
    auto structure = accel::make_structure(contestant.spec);
    if (!structure->can_refit()) continue;
    structure->set_build_threads(threads);
    structure->build(scene.triangles);
    accel::AccelerationStructure* own = refits.structures.emplace_back(std::move(structure)).get();
    refits.runners.push_back(refit_runner(
        contestant.name, scene,
        [own](std::span<const scene::Triangle> triangles) { own->update(triangles); }));
  }
  return refits;
}

/// The least that has to go through memory: every triangle read, every byte of the structure
/// written.
double least_bytes(const accel::AccelerationStructure& structure, std::size_t triangles) {
  return static_cast<double>(structure.stats().bytes) +
         static_cast<double>(triangles * sizeof(scene::Triangle));
}

}  // namespace

void bench_refit(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree) {
  if (bench.cancelled()) return;
  bench.progress("refitting " + scene.name);
  Refits refits = make_refits(bench, scene, threads, embree);
  LargeCopy copy(bench.plan.copy_bytes);
  refits.runners.push_back({"memcpy", [&] { copy.run(threads); }});
  const RaceTimes times = race(refits.runners, bench.race_settings(threads));
  if (times.front().empty()) return;
  const double bandwidth = copy.bytes() / spread_of(times.back()).median;
  const auto triangles = static_cast<double>(scene.triangles.size());
  for (std::size_t k = 0; k < refits.structures.size(); ++k) {
    const std::size_t ours = refits.peers.size() + k;
    BenchRow frame{.part = "refit",
                   .scene = scene.name,
                   .triangles = scene.triangles.size(),
                   .threads = threads,
                   .operation = "refit",
                   .ours = refits.runners[ours].name,
                   .unit = "Mtri/s"};
    const double bytes = least_bytes(*refits.structures[k], scene.triangles.size());
    const double speed = bytes / spread_of(times[ours]).median;
    frame.note =
        fmt::format("{:.0f} B/tri, {:.1f} GB/s, {:.0f} % of memcpy's {:.1f}", bytes / triangles,
                    speed * 1e-9, 100.0 * speed / bandwidth, bandwidth * 1e-9);
    for (std::size_t peer = 0; peer < refits.peers.size(); ++peer) {
      frame.peer = refits.runners[peer].name;
      bench.report.add(rate_row(frame, triangles, times[ours], triangles, &times[peer]));
    }
    if (refits.peers.empty()) {
      bench.report.add(rate_row(frame, triangles, times[ours], triangles, nullptr));
    }
  }
}

}  // namespace encore::app::bench
