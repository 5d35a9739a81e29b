#include "accel/kdtree/kd_tile.h"

#include "accel/kdtree/kdtree.h"
#include "accel/simd/isa_dispatch.h"

namespace encore::accel {

ENCORE_DECLARE_KERNELS(KdTileKernels, kd_tile_kernels_here)

const KdTileKernels& kd_tile_kernels(Isa isa) {
  return ENCORE_PICK_KERNELS(isa, kd_tile_kernels_here);
}

KdTileView KdTree::tile_view() const {
  return {memory_.nodes.data(), memory_.references.data(), bounds_.min, bounds_.max};
}

void KdTree::intersect_together(std::span<const Ray> rays, std::size_t width,
                                std::span<Hit> hits) const {
  if (triangles_.empty()) return intersect(rays, hits);
  const auto mode = static_cast<std::size_t>(intersection());
  kd_tile_kernels(isa_).intersect[mode](
      tile_view(), make_tile_job(*this, triangles_.data(), rays, width, hits.data(), nullptr));
}

void KdTree::occluded_together(std::span<const Ray> rays, std::size_t width,
                               std::span<std::uint8_t> blocked) const {
  if (triangles_.empty()) return occluded(rays, blocked);
  const auto mode = static_cast<std::size_t>(intersection());
  kd_tile_kernels(isa_).occluded[mode](
      tile_view(), make_tile_job(*this, triangles_.data(), rays, width, nullptr, blocked.data()));
}

}  // namespace encore::accel
