// Structs that lie in memory as the GPU reads them: the CPU walks the very same nodes.
//
// Written in the common subset of C++ and GLSL (std430): every member is a 4-byte scalar or a
// three-vector followed by a scalar, so no padding is ever inserted by either side.
#ifndef ENCORE_SHADERS_SHARED_GPU_TYPES_H
#define ENCORE_SHADERS_SHARED_GPU_TYPES_H

#ifdef __cplusplus
#include <glm/vec3.hpp>

#include <cstdint>

namespace encore::gpu {
using vec3 = glm::vec3;
using uint = std::uint32_t;
#endif

// One triangle in world space. Vertices are exact copies of the mesh's: neighbours that share an
// edge hold bit-identical vertices, which the edge tests rely on.
struct Triangle {
  vec3 v0;
  uint material;  // index into the scene's materials
  vec3 v1;
  uint reserved0;
  vec3 v2;
  uint reserved1;
};

// One node of a binary bounding volume hierarchy. The children of an inner node lie side by side
// at `first` and `first + 1`, after their parent. A leaf (count > 0) of a single triangle holds its
// index in `first`, so trees of such leaves need no references; a leaf of several holds references
// `first` to `first + count - 1`.
struct BvhNode {
  vec3 min;
  uint first;
  vec3 max;
  uint count;  // 0: inner node
};

// One kd-tree node in 8 bytes (after Pharr and Humphreys 2004). Bits 0..1 of `flags`: the split
// axis, 3 for a leaf. Bits 2..31: inner node: index of the upper child, the lower child follows
// its parent directly; leaf: the number of references, which start at `data` taken as an integer.
struct KdNode {
  uint data;  // inner node: bits of the float split position; leaf: first reference
  uint flags;
};

#ifdef __cplusplus
static_assert(sizeof(Triangle) == 48 && alignof(Triangle) == 4);
static_assert(sizeof(BvhNode) == 32);
static_assert(sizeof(KdNode) == 8);
}  // namespace encore::gpu
#endif

#endif
