#include "app/bench/tracing.h"

#include "accel/make_structure.h"
#include "accel/parallel.h"

#include <algorithm>
#include <span>

namespace encore::app::bench {

namespace {

constexpr std::size_t kTilesAPart = 4;

/// body(first tile, end) over the tiles, by so many threads.
template <class Body>
void for_tiles(int threads, std::size_t tiles, const Body& body) {
  accel::Workers workers(threads);
  workers.run([&] { workers.for_parts(tiles, kTilesAPart, body); });
}

}  // namespace

OurTracing::OurTracing(accel::AccelerationStructure& structure, const RaySet& set,
                       const OurWay& way)
    : structure_(structure), set_(set), way_(way) {
  const std::size_t count =
      way.grouping == accel::RayGrouping::single ? set.rays.size() : set.tiles.size();
  if (set.any_hit) {
    blocked_.resize(count);
  } else {
    hits_.resize(count);
  }
}

void OurTracing::run() {
  structure_.set_intersection(way_.mode);
  structure_.set_grouping(way_.grouping);
  for_tiles(way_.threads, set_.tile_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile) {
      if (tile % way_.stride == 0 && set_.first[tile] != set_.first[tile + 1]) trace_tile(tile);
    }
  });
}

void OurTracing::trace_tile(std::size_t tile) {
  const bool single = way_.grouping == accel::RayGrouping::single;
  const std::size_t first = single ? set_.first[tile] : tile * RaySet::kTileRays;
  const std::size_t count = single ? set_.first[tile + 1] - first : std::size_t{RaySet::kTileRays};
  const auto rays = std::span(single ? set_.rays : set_.tiles).subspan(first, count);
  if (set_.any_hit) {
    structure_.occluded_tile(rays, RaySet::kTileSide, std::span(blocked_).subspan(first, count));
  } else {
    structure_.intersect_tile(rays, RaySet::kTileSide, std::span(hits_).subspan(first, count));
  }
}

std::vector<std::uint8_t> OurTracing::found() const {
  std::vector<std::uint8_t> result(set_.rays.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::size_t at = way_.grouping == accel::RayGrouping::single ? i : set_.place[i];
    result[i] = set_.any_hit ? blocked_[at] : (hits_[at].found() ? 1 : 0);
  }
  return result;
}

EmbreeTracing::EmbreeTracing(const EmbreeScene& scene, const Rays& rays, EmbreePackets packets,
                             int threads)
    : scene_(scene), rays_(rays), packets_(packets), threads_(threads) {
  if (packets != EmbreePackets::one) {
    hits_.resize(rays.embree.packets.size());
  } else if (rays.set.any_hit) {
    blocked_.resize(rays.set.rays.size());
  } else {
    single_.resize(rays.set.rays.size());
  }
}

void EmbreeTracing::run() {
  for_tiles(threads_, rays_.set.tile_count(), [&](std::size_t begin, std::size_t end) {
    if (packets_ == EmbreePackets::one) {
      trace_singly(begin, end);
    } else {
      scene_.trace(rays_.embree, packets_, begin, end, hits_);
    }
  });
}

void EmbreeTracing::trace_singly(std::size_t first_tile, std::size_t end_tile) {
  const std::size_t first = rays_.set.first[first_tile];
  const std::size_t count = rays_.set.first[end_tile] - first;
  const auto rays = std::span(rays_.set.rays).subspan(first, count);
  if (rays_.set.any_hit) {
    scene_.occluded(rays, std::span(blocked_).subspan(first, count));
  } else {
    scene_.intersect(rays, std::span(single_).subspan(first, count));
  }
}

std::vector<std::uint8_t> EmbreeTracing::found() const {
  if (packets_ != EmbreePackets::one) return rays_.embree.found(hits_);
  if (rays_.set.any_hit) return blocked_;
  std::vector<std::uint8_t> result;
  result.reserve(single_.size());
  for (const scene::Hit& hit : single_) result.push_back(hit.found() ? 1 : 0);
  return result;
}

double rays_of_stride(const RaySet& set, std::size_t stride) {
  std::size_t rays = 0;
  for (std::size_t tile = 0; tile < set.tile_count(); tile += stride) {
    rays += set.first[tile + 1] - set.first[tile];
  }
  return static_cast<double>(rays);
}

double differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                 const RaySet& set, std::size_t stride) {
  std::size_t rays = 0;
  std::size_t differ = 0;
  for (std::size_t tile = 0; tile < set.tile_count(); tile += stride) {
    for (std::size_t i = set.first[tile]; i < set.first[tile + 1]; ++i) {
      ++rays;
      differ += a[i] != b[i] ? 1 : 0;
    }
  }
  return rays > 0 ? static_cast<double>(differ) / static_cast<double>(rays) : 0.0;
}

std::vector<Rays> make_rays(const BenchScene& scene, int side, std::uint64_t seed) {
  // By what has been held to brute force for longest.
  const auto structure =
      accel::make_structure(accel::default_spec(accel::StructureKind::bvh_median));
  structure->build(scene.triangles);
  const auto hits_of = [&](const RaySet& set) {
    OurTracing truth(*structure, set, {});
    truth.run();
    return truth.hits();
  };
  RaySet primary = primary_rays(scene.camera, side);
  RaySet close = primary_rays(zoomed(scene.camera, primary, hits_of(primary), side), side);
  close.kind = "close";
  const std::vector<scene::Hit> hits = hits_of(close);
  RaySet bounce = bounce_rays(close, hits, scene.triangles, seed);
  RaySet shadow = shadow_rays(close, hits, scene.triangles);
  std::vector<Rays> kinds;
  kinds.emplace_back(std::move(primary));
  kinds.emplace_back(std::move(close));
  kinds.emplace_back(std::move(bounce));
  kinds.emplace_back(std::move(shadow));
  return kinds;
}

}  // namespace encore::app::bench
