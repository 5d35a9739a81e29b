#pragma once

#include "accel/settings.h"

#include <cstdint>

namespace encore::accel {

/// The most bytes that a structure of so many triangles holds when built (BuildStats::bytes),
/// whatever the triangles are. With the default settings, in bytes:
/// - bvh: 64 #T
/// - bvh-sah: 197 #T + 256; 295 #T + 256 with BuildPreset::best
/// - grids: 132 #T + 4 round(cbrt(#T))^3 + 17 MiB
/// - kd-trees: 192 #T + 768 KiB
/// - brute: 0
/// Building takes more for a while, but no more than 16 times as much for kd-trees (32 bytes for
/// each reference that waits) and 4 times for the others.
std::uint64_t most_bytes(const StructureSpec& spec, std::uint64_t triangles);

}  // namespace encore::accel
