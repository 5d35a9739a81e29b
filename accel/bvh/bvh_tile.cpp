#include "accel/bvh/bvh_tile.h"

#include "accel/bvh/bvh.h"
#include "accel/simd/isa_dispatch.h"

namespace encore::accel {

ENCORE_DECLARE_KERNELS(BvhTileKernels, bvh_tile_kernels_here)

const BvhTileKernels& bvh_tile_kernels(Isa isa) {
  return ENCORE_PICK_KERNELS(isa, bvh_tile_kernels_here);
}

void Bvh::intersect_together(std::span<const Ray> rays, std::size_t width,
                             std::span<Hit> hits) const {
  if (triangles_.size() < 2) return intersect(rays, hits);
  const auto mode = static_cast<std::size_t>(intersection());
  bvh_tile_kernels(isa_).intersect[mode](
      {root()}, make_tile_job(*this, triangles_.data(), rays, width, hits.data(), nullptr));
}

void Bvh::occluded_together(std::span<const Ray> rays, std::size_t width,
                            std::span<std::uint8_t> blocked) const {
  if (triangles_.size() < 2) return occluded(rays, blocked);
  const auto mode = static_cast<std::size_t>(intersection());
  bvh_tile_kernels(isa_).occluded[mode](
      {root()}, make_tile_job(*this, triangles_.data(), rays, width, nullptr, blocked.data()));
}

}  // namespace encore::accel
