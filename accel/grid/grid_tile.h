#pragma once

#include "accel/simd/isa.h"
#include "accel/simd/tile_job.h"

#include <array>
#include <cstdint>

namespace encore::accel {

/// What rectangles of rays need of a grid: the references of cell c are references[starts[c] ..
/// starts[c + 1]), x runs fastest.
struct GridTileView {
  const std::uint32_t* starts;
  const std::uint32_t* references;
  const float* planes[3];  ///< size + 1 each
  std::uint32_t size[3];
};

/// Takes rectangles of rays through a grid in packets of 64, for one instruction set; by
/// IntersectionMode: slice by slice along the axis that the rays mostly run along, in each through
/// the cells that the frustum around them overlaps (Wald, Ize, Kensler, Knoll and Parker 2006).
/// Cells with triangles are entered by those rays alone that meet the cell's box.
struct GridTileKernels {
  using Trace = void (*)(const GridTileView& view, const TileJob& job);
  std::array<Trace, 3> intersect;
  std::array<Trace, 3> occluded;
};

/// `isa` must be one of available_isas().
const GridTileKernels& grid_tile_kernels(Isa isa);

}  // namespace encore::accel
