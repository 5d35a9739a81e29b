#include "accel/grid/grid_tile.h"

#include "accel/grid/grid.h"
#include "accel/simd/isa_dispatch.h"

namespace encore::accel {

ENCORE_DECLARE_KERNELS(GridTileKernels, grid_tile_kernels_here)

const GridTileKernels& grid_tile_kernels(Isa isa) {
  return ENCORE_PICK_KERNELS(isa, grid_tile_kernels_here);
}

GridTileView Grid::tile_view() const {
  return {cell_starts_.data(),
          references_.data(),
          {layout_.planes(0), layout_.planes(1), layout_.planes(2)},
          {layout_.size(0), layout_.size(1), layout_.size(2)}};
}

void Grid::intersect_together(std::span<const Ray> rays, std::size_t width,
                              std::span<Hit> hits) const {
  if (references_.empty()) return intersect(rays, hits);
  const auto mode = static_cast<std::size_t>(intersection());
  grid_tile_kernels(isa_).intersect[mode](
      tile_view(), make_tile_job(*this, triangles_.data(), rays, width, hits.data(), nullptr));
}

void Grid::occluded_together(std::span<const Ray> rays, std::size_t width,
                             std::span<std::uint8_t> blocked) const {
  if (references_.empty()) return occluded(rays, blocked);
  const auto mode = static_cast<std::size_t>(intersection());
  grid_tile_kernels(isa_).occluded[mode](
      tile_view(), make_tile_job(*this, triangles_.data(), rays, width, nullptr, blocked.data()));
}

}  // namespace encore::accel
