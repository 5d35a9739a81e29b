#include "accel/wide/wide_kernels.h"

#include "accel/simd/isa_dispatch.h"

namespace encore::accel {

ENCORE_DECLARE_KERNELS(WideSingleKernels, single_kernels)
ENCORE_DECLARE_KERNELS(WideTileKernels, tile_kernels)

const WideSingleKernels& wide_single_kernels(Isa isa) {
  require(isa);
  return ENCORE_PICK_KERNELS(isa, single_kernels);
}

const WideTileKernels& wide_tile_kernels(Isa isa) {
  require(isa);
  return ENCORE_PICK_KERNELS(isa, tile_kernels);
}

}  // namespace encore::accel
