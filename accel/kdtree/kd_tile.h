#pragma once

#include "accel/simd/isa.h"
#include "accel/simd/tile_job.h"
#include "shaders/shared/gpu_types.h"

#include <array>
#include <cstdint>

namespace encore::accel {

/// What rectangles of rays need of a kd-tree.
struct KdTileView {
  const gpu::KdNode* nodes;
  const std::uint32_t* references;
  gpu::vec3 min, max;
};

/// Takes rectangles of rays through a kd-tree in packets of 64 (Wald et al. 2001), for one
/// instruction set; by IntersectionMode. Every ray keeps its own stretch and goes where it would
/// have gone alone. Packets whose directions differ in a sign are traced ray by ray.
struct KdTileKernels {
  using Trace = void (*)(const KdTileView& view, const TileJob& job);
  std::array<Trace, 3> intersect;
  std::array<Trace, 3> occluded;
};

/// `isa` must be one of available_isas().
const KdTileKernels& kd_tile_kernels(Isa isa);

}  // namespace encore::accel
