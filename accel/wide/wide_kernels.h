#pragma once

#include "accel/settings.h"
#include "accel/simd/isa.h"
#include "accel/wide/wide_tree.h"
#include "scene/ray.h"
#include "scene/triangle.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace encore::accel {

/// The inner loops of bvh-sah for one instruction set. Plain pointers and no library calls: what
/// lies behind them is compiled with instructions that nothing else may use
/// (accel/simd/intrinsics.h). `triangles` are the scene's, which doubts in double precision are
/// settled with. All instruction sets give the same hits, bit for bit, and so do rays alone and in
/// packets.
struct WideSingleKernels {
  using Intersect = void (*)(const WideView& tree, const scene::Triangle* triangles,
                             const scene::Ray* rays, std::size_t count, scene::Hit* hits);
  using Occluded = void (*)(const WideView& tree, const scene::Triangle* triangles,
                            const scene::Ray* rays, std::size_t count, std::uint8_t* blocked);
  // By IntersectionMode.
  std::array<Intersect, 3> intersect;
  std::array<Occluded, 3> occluded;
};

/// The same for rectangles of width * height rays, row by row, neighbours being neighbours in
/// space; any width and height, any rays.
struct WideTileKernels {
  using Intersect = void (*)(const WideView& tree, const scene::Triangle* triangles,
                             const scene::Ray* rays, std::size_t width, std::size_t height,
                             scene::Hit* hits);
  using Occluded = void (*)(const WideView& tree, const scene::Triangle* triangles,
                            const scene::Ray* rays, std::size_t width, std::size_t height,
                            std::uint8_t* blocked);
  // By IntersectionMode.
  std::array<Intersect, 3> intersect;
  std::array<Occluded, 3> occluded;
};

/// Throw std::invalid_argument for an instruction set that is not among available_isas().
const WideSingleKernels& wide_single_kernels(Isa isa);
const WideTileKernels& wide_tile_kernels(Isa isa);

}  // namespace encore::accel
