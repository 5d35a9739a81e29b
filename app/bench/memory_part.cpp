#include "accel/make_structure.h"
#include "app/bench/bench.h"
#include "app/bench/process_memory.h"

#include <algorithm>
#include <array>
#include <memory>

namespace encore::app::bench {

namespace {

/// Of our triangle list, which every structure of ours needs beside itself.
constexpr double kOurGeometry = sizeof(scene::Triangle);

/// What Embree needs beside its own: an indexed mesh, 16 bytes a vertex that is none other's and
/// three indices a triangle.
double indexed_geometry(const std::vector<scene::Triangle>& triangles) {
  std::vector<std::array<float, 3>> vertices;
  vertices.reserve(3 * triangles.size());
  for (const scene::Triangle& t : triangles) {
    for (const glm::vec3& v : {t.v0, t.v1, t.v2}) vertices.push_back({v.x, v.y, v.z});
  }
  std::sort(vertices.begin(), vertices.end());
  const auto end = std::unique(vertices.begin(), vertices.end());
  return 12.0 +
         16.0 * static_cast<double>(end - vertices.begin()) / static_cast<double>(triangles.size());
}

/// Bytes a triangle.
struct Memory {
  double held = 0.0;
  double peak = 0.0;  ///< while it was built, of its own; 0: not known
};

Memory of_embree(EmbreeDevice& device, const EmbreeSettings& settings, const BenchScene& scene) {
  const auto triangles = static_cast<double>(scene.triangles.size());
  EmbreeScene peer(device, settings);
  const std::uint64_t before = device.bytes();
  device.forget_peak();
  peer.build(scene.triangles);
  return {static_cast<double>(device.bytes() - before) / triangles,
          static_cast<double>(device.peak_bytes() - before) / triangles};
}

Memory of_ours(const Contestant& contestant, const BenchScene& scene, int threads) {
  const auto triangles = static_cast<double>(scene.triangles.size());
  const auto structure = accel::make_structure(contestant.spec);
  structure->set_build_threads(threads);
  const bool watched = forget_peak_resident();
  const auto before = resident_bytes();
  structure->build(scene.triangles);
  const auto peak = peak_resident_bytes();
  Memory memory{static_cast<double>(structure->stats().bytes) / triangles, 0.0};
  if (watched && before && peak && *peak > *before) {
    memory.peak = static_cast<double>(*peak - *before) / triangles;
  }
  return memory;
}

BenchRow memory_row(const BenchRow& frame, const std::string& what, double ours,
                    const std::string& peer, double theirs) {
  BenchRow row = frame;
  row.operation = what;
  row.unit = "B/tri";
  row.our_value = ours;
  row.repeats = 1;
  if (theirs <= 0.0 || ours <= 0.0) return row;
  row.peer = peer;
  row.peer_value = theirs;
  row.ratio = {theirs / ours, theirs / ours, theirs / ours};
  return row;
}

}  // namespace

void bench_memory(Bench& bench, const BenchScene& scene, int threads, EmbreeDevice* embree) {
  if (scene.triangles.empty()) return;
  bench.progress("memory of " + scene.name);
  const double geometry = indexed_geometry(scene.triangles);
  for (const Contestant& contestant : contestants(bench.plan)) {
    if (bench.cancelled()) return;
    const EmbreeSettings compact{.quality = contestant.peer, .compact = true};
    const Memory theirs = embree != nullptr ? of_embree(*embree, compact, scene) : Memory{};
    const Memory ours = of_ours(contestant, scene, threads);
    const BenchRow frame{.part = "scaling",
                         .scene = scene.name,
                         .triangles = scene.triangles.size(),
                         .threads = threads,
                         .ours = contestant.name};
    const std::string peer = embree_name(compact);
    bench.report.add(memory_row(frame, "memory", ours.held, peer, theirs.held));
    bench.report.add(memory_row(frame, "and geometry", ours.held + kOurGeometry, peer,
                                theirs.held > 0.0 ? theirs.held + geometry : 0.0));
    if (ours.peak > 0.0) {
      bench.report.add(memory_row(frame, "building", ours.peak, peer, theirs.peak));
    }
  }
}

}  // namespace encore::app::bench
