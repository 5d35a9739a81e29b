#pragma once

#include "accel/acceleration_structure.h"
#include "app/bench/embree.h"
#include "app/bench/ray_set.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace encore::app::bench {

/// Rays of one kind, as ours and as Embree take them.
struct Rays {
  explicit Rays(RaySet s) : set(std::move(s)), embree(set) {}
  RaySet set;
  EmbreeRays embree;
};

/// One way to trace a set of rays, and what it found.
class Tracing {
 public:
  virtual ~Tracing() = default;
  virtual void run() = 0;
  /// Whether each of RaySet::rays that was traced hit anything.
  [[nodiscard]] virtual std::vector<std::uint8_t> found() const = 0;
};

/// How one of our structures is asked.
struct OurWay {
  accel::IntersectionMode mode = accel::IntersectionMode::precise;
  accel::RayGrouping grouping = accel::RayGrouping::single;
  std::size_t stride = 1;  ///< every so many tiles
  int threads = 1;
};

/// Everything referred to must outlive it. One run at a time for each structure, whose mode and
/// grouping it sets.
class OurTracing final : public Tracing {
 public:
  OurTracing(accel::AccelerationStructure& structure, const RaySet& set, const OurWay& way);
  void run() override;
  [[nodiscard]] std::vector<std::uint8_t> found() const override;
  /// Of the nearest hits, one a ray (single) or a place in the tiles (packets).
  [[nodiscard]] const std::vector<scene::Hit>& hits() const { return hits_; }

 private:
  void trace_tile(std::size_t tile);

  accel::AccelerationStructure& structure_;
  const RaySet& set_;
  OurWay way_;
  std::vector<scene::Hit> hits_;
  std::vector<std::uint8_t> blocked_;
};

class EmbreeTracing final : public Tracing {
 public:
  EmbreeTracing(const EmbreeScene& scene, const Rays& rays, EmbreePackets packets, int threads);
  void run() override;
  [[nodiscard]] std::vector<std::uint8_t> found() const override;

 private:
  void trace_singly(std::size_t first_tile, std::size_t end_tile);

  const EmbreeScene& scene_;
  const Rays& rays_;
  EmbreePackets packets_;
  int threads_;
  std::vector<HitPacket> hits_;
  std::vector<scene::Hit> single_;
  std::vector<std::uint8_t> blocked_;
};

/// The rays of every so many tiles.
double rays_of_stride(const RaySet& set, std::size_t stride);

/// Share of those rays on which two disagree, by what Tracing::found() said.
double differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                 const RaySet& set, std::size_t stride);

/// The kinds of rays that a scene is traced with: "primary" from its own camera; "close" zoomed
/// until what it sees fills the picture; "bounce" and "shadow" from what those hit.
std::vector<Rays> make_rays(const BenchScene& scene, int side, std::uint64_t seed);

}  // namespace encore::app::bench
