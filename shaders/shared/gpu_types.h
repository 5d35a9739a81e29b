// Structs that lie in memory as the GPU reads them: the CPU walks the very same nodes.
//
// Written in the common subset of C++ and GLSL (std430): every member is a 4-byte scalar or a
// three-vector followed by a scalar, so no padding is ever inserted by either side.
#ifndef ENCORE_SHADERS_SHARED_GPU_TYPES_H
#define ENCORE_SHADERS_SHARED_GPU_TYPES_H

#ifdef __cplusplus
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace encore::gpu {
using vec3 = glm::vec3;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using dvec3 = glm::dvec3;
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

// One node of a hierarchy with up to eight children (accel/wide/wide_tree.h says what `child` and
// empty places hold). By axis the lower ends of all children's boxes, then their upper ends with
// the sign turned: what a ray meets first and last is then computed alike, and one register of 16
// numbers holds an axis.
struct WideNode {
  float bounds[48];  // [axis][lower, -upper][child]
  uint child[8];
  uint reserved[8];
};

// One kd-tree node in 8 bytes (after Pharr and Humphreys 2004). Bits 0..1 of `flags`: the split
// axis, 3 for a leaf. Bits 2..31: inner node: index of the upper child, the lower child follows
// its parent directly; leaf: the number of references, which start at `data` taken as an integer.
struct KdNode {
  uint data;  // inner node: bits of the float split position; leaf: first reference
  uint flags;
};

// What a traversal has to know of a structure besides its buffers; whatever a structure does not
// have is 0.
struct StructureParameters {
  vec3 min;    // bounds of all triangles
  uint depth;  // trees: the longest path from the root, in nodes below it
  vec3 max;
  uint references;     // length of the array of references; trees without one: of triangles
  uvec3 cells;         // grids: cells along each axis
  uint first_plane_y;  // grids: where the planes of y and z begin among the cell planes
  vec3 smallest_gap;   // grids: the least distance between neighbouring planes of each axis
  uint first_plane_z;
};

// A camera made ready for one image (renderer/camera_rays.h says what the members mean).
struct CameraParameters {
  dvec3 forward;
  double center_x;
  dvec3 right;
  double center_y;
  dvec3 up;
  uint orthographic;  // 1: rays start at their pixels and run along `forward`; else 0
  uint reserved0;
  vec3 origin;
  uint material_count;  // entries of the materials' buffer, the one for those that do not exist too
  vec3 background;
  uint light_count;
};

// The nearest hit of a ray (scene/ray.h).
struct Hit {
  float t;
  uint triangle;
  float u;
  float v;
};

// A ray (scene/ray.h).
struct Ray {
  vec3 origin;
  float t_min;
  vec3 direction;
  float t_max;
};

#define ENCORE_NO_TEXTURE 0xFFFFFFFFu

// What shading needs of a material: emission and ambient light are summed beforehand.
struct Material {
  vec3 diffuse;
  float shininess;
  vec3 specular;
  uint texture;  // which one multiplies the diffuse colour; ENCORE_NO_TEXTURE: none
  vec3 glow;
  uint reserved1;
};

struct Light {
  vec3 position;
  uint reserved0;
  vec3 color;
  uint reserved1;
};

#ifdef __cplusplus
static_assert(sizeof(StructureParameters) == 64);
static_assert(sizeof(CameraParameters) == 128 && offsetof(CameraParameters, origin) == 96);
static_assert(sizeof(Hit) == 16 && sizeof(Ray) == 32);
static_assert(sizeof(Material) == 48 && sizeof(Light) == 32);
static_assert(sizeof(Triangle) == 48 && alignof(Triangle) == 4);
static_assert(sizeof(BvhNode) == 32);
static_assert(sizeof(WideNode) == 256 && offsetof(WideNode, child) == 192);
static_assert(sizeof(KdNode) == 8);
}  // namespace encore::gpu
#endif

#endif
