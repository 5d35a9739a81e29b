#pragma once

#if defined(__SSE4_2__)
// GCC 12 takes the registers that its own intrinsics leave undefined for mistakes.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif

#if !defined(ENCORE_ISA)
#error "only for files that are compiled once an instruction set (encore_isa_sources in CMake)"
#endif

// Everything that is compiled once an instruction set lies in the namespace
// encore::accel::ENCORE_ISA: a function of the same name that two of them brought along would be
// linked from either, and with it instructions that the processor may not have.
