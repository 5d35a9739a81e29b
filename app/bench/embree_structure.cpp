#include "app/bench/embree_structure.h"

#include <algorithm>

namespace encore::app::bench {

namespace {

constexpr std::size_t kSide = 4;

}  // namespace

EmbreeStructure::EmbreeStructure(EmbreeDevice& device, const EmbreeSettings& settings)
    : settings_(settings), name_(embree_name(settings)), scene_(device, settings) {}

void EmbreeStructure::build(std::span<const accel::Triangle> triangles) {
  scene_.build(triangles);
  built_ = triangles.size();
  mark_changed();
}

void EmbreeStructure::update(std::span<const accel::Triangle> triangles) {
  if (triangles.size() != built_ || !settings_.refit) return build(triangles);
  scene_.refit(triangles);
  mark_changed();
}

void EmbreeStructure::intersect(std::span<const accel::Ray> rays,
                                std::span<accel::Hit> hits) const {
  scene_.intersect(rays, hits);
}

void EmbreeStructure::intersect_counted(std::span<const accel::Ray> rays,
                                        std::span<accel::Hit> hits,
                                        std::span<accel::TraceCounters> counters) const {
  std::fill(counters.begin(), counters.end(), accel::TraceCounters{});
  scene_.intersect(rays, hits);
}

void EmbreeStructure::occluded(std::span<const accel::Ray> rays,
                               std::span<std::uint8_t> blocked) const {
  scene_.occluded(rays, blocked);
}

void EmbreeStructure::intersect_together(std::span<const accel::Ray> rays, std::size_t width,
                                         std::span<accel::Hit> hits) const {
  const std::size_t height = width > 0 ? rays.size() / width : 0;
  for (std::size_t y = 0; y < height; y += kSide) {
    for (std::size_t x = 0; x < width; x += kSide) {
      RayPacket packet{};
      HitPacket found;
      std::size_t place[RayPacket::kSize] = {};
      std::size_t lanes = 0;
      for (std::size_t j = y; j < std::min(y + kSide, height); ++j) {
        for (std::size_t i = x; i < std::min(x + kSide, width); ++i) {
          place[lanes] = j * width + i;
          packet.put(rays[place[lanes]], lanes);
          ++lanes;
        }
      }
      scene_.trace(packet, found);
      for (std::size_t k = 0; k < lanes; ++k) {
        hits[place[k]] = {found.t[k], found.triangle[k], found.u[k], found.v[k]};
      }
    }
  }
}

}  // namespace encore::app::bench
