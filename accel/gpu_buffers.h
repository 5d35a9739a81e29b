#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace encore::accel {

/// A structure's memory as the GPU is to see it: which binding (shaders/shared/bindings.h), which
/// bytes. The bytes are the structure's own and valid until its next build or update.
struct GpuBuffer {
  int binding;
  std::span<const std::byte> bytes;
};
using GpuBuffers = std::vector<GpuBuffer>;

}  // namespace encore::accel
