#pragma once

#include <string_view>
#include <vector>

namespace encore::accel {

/// Instruction sets that the inner loops are compiled for, each into the same program; ascending.
/// All give the same results, bit for bit: they differ in how many numbers go at once, not in what
/// is computed.
enum class Isa {
  portable,  ///< plain C++; the only one where the processor is no x86
  sse42,
  avx2,
  avx512,  ///< F, BW, DQ and VL
};

/// "portable", "sse4.2", "avx2", "avx-512".
std::string_view to_string(Isa isa);

/// What this processor and operating system can run, ascending.
const std::vector<Isa>& available_isas();

/// What is used: the last of available_isas(), or the one that the environment variable ENCORE_ISA
/// names when the program starts. Throws std::runtime_error if that is unknown or not available.
Isa chosen_isa();

}  // namespace encore::accel
