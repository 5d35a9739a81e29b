#pragma once

#include "app/bench/bench_scene.h"
#include "scene/ray.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace encore::app::bench {

/// Rays of one kind, pixel by pixel, in square tiles one after the other.
struct RaySet {
  static constexpr int kTileSide = 32;
  static constexpr std::size_t kTileRays = std::size_t{kTileSide} * kTileSide;

  std::string kind;               ///< "primary", "bounce", "shadow"
  bool any_hit = false;           ///< whether anything blocks them is all that is asked
  std::vector<scene::Ray> tiles;  ///< kTileRays a tile, row by row; without a ray: t_max < 0
  /// The rays that there are, in the order of `tiles`, and where each tile's begin (one more than
  /// there are tiles).
  std::vector<scene::Ray> rays;
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> place;  ///< of each of `rays` in `tiles`

  [[nodiscard]] std::size_t tile_count() const { return tiles.size() / kTileRays; }
};

/// One ray through the centre of each pixel of a square picture; `side` is a multiple of kTileSide.
RaySet primary_rays(const scene::Camera& camera, int side);

/// The camera with a field of view so narrow that what `primary`, its own rays, hit fills the
/// picture, looking at the middle of it. The same camera where nothing was hit or it is
/// orthographic.
scene::Camera zoomed(const scene::Camera& camera, const RaySet& primary,
                     std::span<const scene::Hit> hits, int side);

/// From each hit of `primary` one ray in a direction of cosine distribution about the side of the
/// surface that was seen.
RaySet bounce_rays(const RaySet& primary, std::span<const scene::Hit> hits,
                   std::span<const scene::Triangle> triangles, std::uint64_t seed);

/// From each hit of `primary` one ray to a point light to the upper right of the scene.
RaySet shadow_rays(const RaySet& primary, std::span<const scene::Hit> hits,
                   std::span<const scene::Triangle> triangles);

}  // namespace encore::app::bench
