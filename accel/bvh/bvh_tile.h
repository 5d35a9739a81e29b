#pragma once

#include "accel/simd/isa.h"
#include "accel/simd/tile_job.h"
#include "shaders/shared/gpu_types.h"

#include <array>
#include <cstdint>

namespace encore::accel {

/// What rectangles of rays need of a bvh-median: its nodes, the root first and no leaf.
struct BvhTileView {
  const gpu::BvhNode* nodes;
};

/// Takes rectangles of rays through a bvh-median in packets of 64, for one instruction set; by
/// IntersectionMode. The frustum around a packet decides which boxes it goes on to (Wald, Boulos
/// and Shirley 2007), each ray's own slab test which triangles it is held against.
struct BvhTileKernels {
  using Trace = void (*)(const BvhTileView& view, const TileJob& job);
  std::array<Trace, 3> intersect;
  std::array<Trace, 3> occluded;
};

/// `isa` must be one of available_isas().
const BvhTileKernels& bvh_tile_kernels(Isa isa);

}  // namespace encore::accel
