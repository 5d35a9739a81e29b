#pragma once

#include <cstdint>

namespace encore::accel {

/// The deepest kd-tree that any settings can ask for; bounds every stack.
inline constexpr std::uint32_t kKdDepthCap = 60;

}  // namespace encore::accel
