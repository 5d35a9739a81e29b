#pragma once

#include <cstdint>
#include <optional>

namespace encore::app::bench {

/// Resident memory of this process now, in bytes; nothing where the system does not tell.
std::optional<std::uint64_t> resident_bytes();

/// Gives back what the allocator keeps, and forgets the most that was ever resident, so that
/// peak_resident_bytes() is the most from now on. False where the system cannot.
bool forget_peak_resident();
std::optional<std::uint64_t> peak_resident_bytes();

}  // namespace encore::app::bench
