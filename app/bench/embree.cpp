#include "app/bench/embree.h"

#include <algorithm>

namespace encore::app::bench {

namespace {

constexpr std::uint32_t kPacketSide = 4;
constexpr std::uint32_t kTileSide = RaySet::kTileSide;

/// Where the `n`-th ray of a tile lies in it, going through it by squares of 4 x 4 pixels.
std::uint32_t place_in_tile(std::uint32_t n) {
  const std::uint32_t square = n / (kPacketSide * kPacketSide);
  const std::uint32_t within = n % (kPacketSide * kPacketSide);
  const std::uint32_t squares = kTileSide / kPacketSide;
  const std::uint32_t x = square % squares * kPacketSide + within % kPacketSide;
  const std::uint32_t y = square / squares * kPacketSide + within / kPacketSide;
  return y * kTileSide + x;
}

}  // namespace

void RayPacket::put(const scene::Ray& ray, std::size_t lane) {
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis][lane] = ray.origin[axis];
    direction[axis][lane] = ray.direction[axis];
  }
  t_min[lane] = ray.t_min;
  t_max[lane] = ray.t_max;
  valid[lane] = -1;
}

std::string_view to_string(EmbreeQuality quality) {
  switch (quality) {
    case EmbreeQuality::low:
      return "LOW";
    case EmbreeQuality::medium:
      return "MEDIUM";
    default:
      return "HIGH";
  }
}

std::string_view to_string(EmbreePackets packets) {
  switch (packets) {
    case EmbreePackets::one:
      return "1";
    case EmbreePackets::eight_coherent:
      return "8 coherent";
    case EmbreePackets::eight:
      return "8";
    case EmbreePackets::sixteen_coherent:
      return "16 coherent";
    default:
      return "16";
  }
}

const std::vector<EmbreePackets>& all_embree_packets() {
  static const std::vector<EmbreePackets> all = {
      EmbreePackets::one, EmbreePackets::eight_coherent, EmbreePackets::eight,
      EmbreePackets::sixteen_coherent, EmbreePackets::sixteen};
  return all;
}

std::string embree_name(const EmbreeSettings& settings) {
  std::string name = "Embree " + std::string(to_string(settings.quality));
  if (settings.refit) name = "Embree REFIT";
  if (settings.dynamic) name += " dynamic";
  if (settings.robust) name += " robust";
  if (settings.compact) name += " compact";
  return name;
}

EmbreeRays::EmbreeRays(const RaySet& set) : any_hit(set.any_hit), first(1, 0) {
  std::vector<std::uint32_t> ray_at(set.tiles.size(), scene::kNoHit);
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    ray_at[set.place[i]] = static_cast<std::uint32_t>(i);
  }
  for (std::size_t tile = 0; tile < set.tile_count(); ++tile) {
    std::size_t lane = RayPacket::kSize;
    for (std::uint32_t n = 0; n < RaySet::kTileRays; ++n) {
      const std::uint32_t ray = ray_at[tile * RaySet::kTileRays + place_in_tile(n)];
      if (ray == scene::kNoHit) continue;
      if (lane == RayPacket::kSize) {
        lane = 0;
        packets.emplace_back();
        index.resize(index.size() + RayPacket::kSize, scene::kNoHit);
      }
      index[(packets.size() - 1) * RayPacket::kSize + lane] = ray;
      packets.back().put(set.rays[ray], lane++);
    }
    first.push_back(packets.size());
  }
}

std::vector<std::uint8_t> EmbreeRays::found(std::span<const HitPacket> hits) const {
  std::vector<std::uint8_t> result(index.size(), 0);
  std::size_t rays = 0;
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] == scene::kNoHit) continue;
    ++rays;
    const HitPacket& packet = hits[i / RayPacket::kSize];
    result[index[i]] = packet.triangle[i % RayPacket::kSize] != scene::kNoHit ? 1 : 0;
  }
  result.resize(rays);
  return result;
}

}  // namespace encore::app::bench
