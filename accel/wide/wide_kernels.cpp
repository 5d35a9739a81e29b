#include "accel/wide/wide_kernels.h"

#include <stdexcept>

namespace encore::accel {

// Each from its own compilation of kernels/wide_single.cpp and kernels/wide_tile.cpp.
#define ENCORE_DECLARE(isa)                  \
  namespace isa {                            \
  const WideSingleKernels& single_kernels(); \
  const WideTileKernels& tile_kernels();     \
  }
ENCORE_DECLARE(portable)
#if defined(__x86_64__)
ENCORE_DECLARE(sse42)
ENCORE_DECLARE(avx2)
ENCORE_DECLARE(avx512)
#endif
#undef ENCORE_DECLARE

namespace {

void check(Isa isa) {
  for (const Isa available : available_isas()) {
    if (available == isa) return;
  }
  throw std::invalid_argument("this machine lacks the instruction set that was asked for");
}

}  // namespace

const WideSingleKernels& wide_single_kernels(Isa isa) {
  check(isa);
#if defined(__x86_64__)
  if (isa == Isa::sse42) return sse42::single_kernels();
  if (isa == Isa::avx2) return avx2::single_kernels();
  if (isa == Isa::avx512) return avx512::single_kernels();
#endif
  return portable::single_kernels();
}

const WideTileKernels& wide_tile_kernels(Isa isa) {
  check(isa);
#if defined(__x86_64__)
  if (isa == Isa::sse42) return sse42::tile_kernels();
  if (isa == Isa::avx2) return avx2::tile_kernels();
  if (isa == Isa::avx512) return avx512::tile_kernels();
#endif
  return portable::tile_kernels();
}

}  // namespace encore::accel
