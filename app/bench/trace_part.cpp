#include "accel/make_structure.h"
#include "app/bench/bench.h"
#include "app/bench/tracing.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace encore::app::bench {

namespace {

using accel::AccelerationStructure;
using accel::IntersectionMode;
using accel::RayGrouping;

/// The thesis' structures may be a thousand times slower than the quickest: of large pictures they
/// get every so many tiles, which is no divisor of a row.
constexpr std::size_t kThesisStride = 7;
constexpr std::size_t kManyTiles = 256;

/// What is raced: who, and what it stands for.
struct Entry {
  std::string name;
  std::unique_ptr<Tracing> tracing;
  double items = 0;  ///< rays a run
  std::size_t stride = 1;
  bool ours = true;
  bool robust = false;    ///< of Embree's
  bool together = false;  ///< in packets
  IntersectionMode mode = IntersectionMode::precise;
};

/// One quality of Embree's and what of ours stands beside it, all built over the scene.
struct Field {
  EmbreeQuality quality;
  std::unique_ptr<EmbreeScene> plain, robust;
  struct Own {
    Contestant contestant;
    std::unique_ptr<AccelerationStructure> structure;
  };
  std::vector<Own> own;
};

Field build_field(const Bench& bench, EmbreeQuality quality, const BenchScene& scene, int threads,
                  EmbreeDevice* embree) {
  Field field{quality, nullptr, nullptr, {}};
  for (const Contestant& contestant : contestants(bench.plan)) {
    if (contestant.peer != quality) continue;
    auto structure = accel::make_structure(contestant.spec);
    structure->set_build_threads(threads);
    structure->build(scene.triangles);
    field.own.push_back({contestant, std::move(structure)});
  }
  if (field.own.empty()) return field;
  if (embree != nullptr) {
    field.plain = std::make_unique<EmbreeScene>(*embree, EmbreeSettings{.quality = quality});
    field.robust =
        std::make_unique<EmbreeScene>(*embree, EmbreeSettings{.quality = quality, .robust = true});
    field.plain->build(scene.triangles);
    field.robust->build(scene.triangles);
  }
  return field;
}

std::vector<Entry> entries_of(const Field& field, const Rays& rays, int threads) {
  std::vector<Entry> entries;
  const auto all_rays = static_cast<double>(rays.set.rays.size());
  for (const bool robust : {false, true}) {
    const EmbreeScene* scene = robust ? field.robust.get() : field.plain.get();
    if (scene == nullptr) continue;
    for (const EmbreePackets packets : all_embree_packets()) {
      Entry entry;
      entry.name = fmt::format("{} {}", embree_name({.quality = field.quality, .robust = robust}),
                               to_string(packets));
      entry.tracing = std::make_unique<EmbreeTracing>(*scene, rays, packets, threads);
      entry.items = all_rays;
      entry.ours = false;
      entry.robust = robust;
      entry.together = packets != EmbreePackets::one;
      entries.push_back(std::move(entry));
    }
  }
  for (const Field::Own& own : field.own) {
    const bool thesis = own.contestant.spec.kind != accel::StructureKind::bvh_sah;
    for (const IntersectionMode mode : {IntersectionMode::moller_trumbore,
                                        IntersectionMode::watertight, IntersectionMode::precise}) {
      if (thesis && mode != IntersectionMode::moller_trumbore) continue;
      for (const RayGrouping grouping : {RayGrouping::single, RayGrouping::packets}) {
        Entry entry;
        entry.together = grouping == RayGrouping::packets;
        entry.name = fmt::format("{} {} {}", own.contestant.name,
                                 entry.together ? "tile" : "single", to_string(mode));
        entry.stride = thesis && rays.set.tile_count() >= kManyTiles ? kThesisStride : 1;
        entry.tracing = std::make_unique<OurTracing>(*own.structure, rays.set,
                                                     OurWay{mode, grouping, entry.stride, threads});
        entry.items = rays_of_stride(rays.set, entry.stride);
        entry.mode = mode;
        entries.push_back(std::move(entry));
      }
    }
  }
  return entries;
}

/// The quickest of ours and of Embree's so far, whatever they are; may be empty.
struct Champions {
  std::vector<Entry> ours, peer;  ///< one each at most
  double our_rate = 0.0;
  double peer_rate = 0.0;
};

struct Timed {
  std::vector<Entry> entries;
  RaceTimes times;
  [[nodiscard]] double rate(std::size_t k) const {
    return entries[k].items / spread_of(times[k]).median;
  }
  /// The quickest of those that `fits`; nothing if there is none.
  template <class Fits>
  [[nodiscard]] std::optional<std::size_t> quickest(const Fits& fits) const {
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < entries.size(); ++k) {
      if (fits(entries[k]) && (!best || rate(k) > rate(*best))) best = k;
    }
    return best;
  }
};

Timed race_entries(std::vector<Entry> entries, const RaceSettings& settings) {
  std::vector<Runner> runners;
  for (const Entry& entry : entries) {
    runners.push_back({entry.name, [tracing = entry.tracing.get()] { tracing->run(); }});
  }
  RaceTimes times = race(runners, settings);
  return {std::move(entries), std::move(times)};
}

/// The peer of one of ours: moller-trumbore stands beside Embree's plain scenes, the other modes
/// beside robust ones; single rays beside single rays, packets beside the best packets.
std::optional<std::size_t> peer_of(const Timed& timed, const Entry& ours) {
  const bool robust = ours.mode != IntersectionMode::moller_trumbore;
  return timed.quickest(
      [&](const Entry& e) { return !e.ours && e.robust == robust && e.together == ours.together; });
}

void add_row(Bench& bench, BenchRow frame, const Timed& timed, std::size_t ours,
             std::optional<std::size_t> peer, const Rays& rays) {
  const Entry& mine = timed.entries[ours];
  frame.ours = mine.name;
  if (peer) {
    frame.peer = timed.entries[*peer].name;
    frame.note =
        fmt::format("{:.4f} % differ",
                    100.0 * differing(mine.tracing->found(), timed.entries[*peer].tracing->found(),
                                      rays.set, mine.stride));
    if (mine.stride > 1) frame.note += fmt::format(", every {}th tile", mine.stride);
    bench.report.add(rate_row(frame, mine.items, timed.times[ours], timed.entries[*peer].items,
                              &timed.times[*peer]));
  } else {
    bench.report.add(rate_row(frame, mine.items, timed.times[ours], 1.0, nullptr));
  }
}

/// Takes the quickest of both sides out of a race if they are quicker than what there is.
void crown(Timed& timed, Champions& champions) {
  const auto take = [&](bool ours, std::vector<Entry>& place, double& rate) {
    const auto best = timed.quickest([&](const Entry& e) { return e.ours == ours; });
    if (!best || timed.rate(*best) <= rate) return;
    rate = timed.rate(*best);
    place.clear();
    place.push_back(std::move(timed.entries[*best]));
  };
  take(true, champions.ours, champions.our_rate);
  take(false, champions.peer, champions.peer_rate);
}

void trace_field(Bench& bench, const BenchRow& frame, const Field& field, const Rays& rays,
                 Champions& champions) {
  bench.progress(fmt::format("tracing {} rays of {} against {}", rays.set.kind, frame.scene,
                             to_string(field.quality)));
  Timed timed =
      race_entries(entries_of(field, rays, frame.threads), bench.race_settings(frame.threads));
  if (timed.times.empty() || timed.times.front().empty()) return;
  for (std::size_t k = 0; k < timed.entries.size(); ++k) {
    if (timed.entries[k].ours) {
      add_row(bench, frame, timed, k, peer_of(timed, timed.entries[k]), rays);
    }
  }
  crown(timed, champions);
}

/// Whatever was quickest against whatever was quickest, once more and side by side.
void race_champions(Bench& bench, BenchRow frame, Champions champions, const Rays& rays) {
  if (champions.ours.empty() || champions.peer.empty() || bench.cancelled()) return;
  std::vector<Entry> entries;
  entries.push_back(std::move(champions.ours.front()));
  entries.push_back(std::move(champions.peer.front()));
  const Timed timed = race_entries(std::move(entries), bench.race_settings(frame.threads));
  if (timed.times.front().empty()) return;
  frame.operation += " best";
  add_row(bench, frame, timed, 0, 1, rays);
}

}  // namespace

void bench_trace(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree) {
  if (bench.cancelled() || scene.triangles.empty()) return;
  bench.progress("making rays for " + scene.name);
  const std::vector<Rays> kinds = make_rays(scene, bench.plan.side, bench.plan.seed);
  bench.report.say(fmt::format("\n{}: {} primary rays, {} bounce and {} shadow rays", scene.name,
                               kinds.front().set.rays.size(), kinds[2].set.rays.size(),
                               kinds[3].set.rays.size()));
  std::vector<Field> fields;
  for (const EmbreeQuality quality :
       {EmbreeQuality::low, EmbreeQuality::medium, EmbreeQuality::high}) {
    if (bench.cancelled()) return;
    Field field = build_field(bench, quality, scene, threads, embree);
    if (!field.own.empty()) fields.push_back(std::move(field));
  }
  const auto& wanted = bench.plan.rays;
  for (const Rays& rays : kinds) {
    if (rays.set.rays.empty()) continue;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), rays.set.kind) == wanted.end()) {
      continue;
    }
    const BenchRow frame{.part = "trace",
                         .scene = scene.name,
                         .triangles = scene.triangles.size(),
                         .threads = threads,
                         .operation = rays.set.kind,
                         .unit = "Mrays/s"};
    Champions champions;
    for (const Field& field : fields) {
      if (!bench.cancelled()) trace_field(bench, frame, field, rays, champions);
    }
    race_champions(bench, frame, std::move(champions), rays);
  }
}

}  // namespace encore::app::bench
