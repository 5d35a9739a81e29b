#include "accel/wide/wide_build_kernels.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace encore::accel {

// Each from its own compilation of kernels/wide_build_*.cpp.
#define ENCORE_DECLARE(isa)                \
  namespace isa {                          \
  const WideBuildKernels& build_kernels(); \
  }
ENCORE_DECLARE(portable)
#if defined(__x86_64__)
ENCORE_DECLARE(sse42)
ENCORE_DECLARE(avx2)
ENCORE_DECLARE(avx512)
#endif
#undef ENCORE_DECLARE

const WideBuildKernels& wide_build_kernels(Isa isa) {
  const std::vector<Isa>& available = available_isas();
  if (std::find(available.begin(), available.end(), isa) == available.end()) {
    throw std::invalid_argument("this machine has no " + std::string(to_string(isa)));
  }
#if defined(__x86_64__)
  if (isa == Isa::sse42) return sse42::build_kernels();
  if (isa == Isa::avx2) return avx2::build_kernels();
  if (isa == Isa::avx512) return avx512::build_kernels();
#endif
  return portable::build_kernels();
}

}  // namespace encore::accel
