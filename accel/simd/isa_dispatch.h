#pragma once

#include "accel/simd/isa.h"

#include <algorithm>
#include <stdexcept>

namespace encore::accel {

/// Throws std::invalid_argument for an instruction set that is not among available_isas().
inline void require(Isa isa) {
  const auto& available = available_isas();
  if (std::find(available.begin(), available.end(), isa) == available.end()) {
    throw std::invalid_argument("this machine lacks the instruction set that was asked for");
  }
}

}  // namespace encore::accel

/// Declares `const Kernels& function()` of every instruction set, each from its own compilation of
/// a file in accel/kernels.
#if defined(__x86_64__)
#define ENCORE_DECLARE_KERNELS(Kernels, function) \
  namespace portable {                            \
  const Kernels& function();                      \
  }                                               \
  namespace sse42 {                               \
  const Kernels& function();                      \
  }                                               \
  namespace avx2 {                                \
  const Kernels& function();                      \
  }                                               \
  namespace avx512 {                              \
  const Kernels& function();                      \
  }
#define ENCORE_PICK_KERNELS(isa, function)   \
  (isa) == Isa::avx512  ? avx512::function() \
  : (isa) == Isa::avx2  ? avx2::function()   \
  : (isa) == Isa::sse42 ? sse42::function()  \
                        : portable::function()
#else
#define ENCORE_DECLARE_KERNELS(Kernels, function) \
  namespace portable {                            \
  const Kernels& function();                      \
  }
#define ENCORE_PICK_KERNELS(isa, function) (static_cast<void>(isa), portable::function())
#endif
