#include "accel/wide/wide_build_kernels.h"

#include "accel/simd/isa_dispatch.h"

namespace encore::accel {

ENCORE_DECLARE_KERNELS(WideBuildKernels, build_kernels)

const WideBuildKernels& wide_build_kernels(Isa isa) {
  require(isa);
  return ENCORE_PICK_KERNELS(isa, build_kernels);
}

}  // namespace encore::accel
