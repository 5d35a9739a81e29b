#pragma once

#include "shaders/shared/gpu_types.h"

#include <bit>
#include <cstdint>

namespace encore::accel {

/// Reading and writing of gpu::KdNode's bit fields.

/// Indices of nodes and counts of references have 30 bits.
inline constexpr std::uint32_t kKdMostNodes = 1U << 30;
inline constexpr std::uint32_t kKdLeafTag = 3;

inline gpu::KdNode kd_leaf(std::uint32_t first, std::uint32_t count) {
  return {first, count << 2 | kKdLeafTag};
}
/// An inner node whose upper child is not known yet.
inline gpu::KdNode kd_inner(int axis, float position) {
  return {std::bit_cast<std::uint32_t>(position), static_cast<std::uint32_t>(axis)};
}
inline void kd_set_upper(gpu::KdNode& node, std::uint32_t upper) {
  node.flags = upper << 2 | (node.flags & 3U);
}

/// 0..2, or kKdLeafTag for a leaf.
inline std::uint32_t kd_tag(const gpu::KdNode& node) {
  return node.flags & 3U;
}
inline float kd_position(const gpu::KdNode& node) {
  return std::bit_cast<float>(node.data);
}
inline std::uint32_t kd_upper(const gpu::KdNode& node) {
  return node.flags >> 2;
}
inline std::uint32_t kd_first(const gpu::KdNode& node) {
  return node.data;
}
inline std::uint32_t kd_count(const gpu::KdNode& node) {
  return node.flags >> 2;
}

}  // namespace encore::accel
