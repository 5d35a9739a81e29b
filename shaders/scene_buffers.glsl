// The storage buffers of the scene and its structure, by what a program uses of them.
#include "shaders/shared/bindings.h"
#include "shaders/shared/gpu_types.h"

layout(std430, binding = ENCORE_BINDING_TRIANGLES) readonly restrict buffer Triangles {
  Triangle triangles[];
};
layout(std140, binding = ENCORE_BINDING_STRUCTURE) uniform StructureBlock {
  StructureParameters structure;
};

#ifdef ENCORE_TRAVERSE_BVH
layout(std430, binding = ENCORE_BINDING_NODES) readonly restrict buffer Nodes {
  BvhNode nodes[];
};
#endif
#ifdef ENCORE_TRAVERSE_KDTREE
layout(std430, binding = ENCORE_BINDING_NODES) readonly restrict buffer Nodes {
  KdNode nodes[];
};
#endif
#ifdef ENCORE_TRAVERSE_WIDE
// gpu::WideNode, in rows of four numbers.
layout(std430, binding = ENCORE_BINDING_NODES) readonly restrict buffer Nodes {
  uvec4 node_rows[];
};
#endif
#if defined(ENCORE_TRAVERSE_KDTREE) || defined(ENCORE_TRAVERSE_GRID) || \
    defined(ENCORE_TRAVERSE_WIDE)
layout(std430, binding = ENCORE_BINDING_REFERENCES) readonly restrict buffer References {
  uint references[];
};
#endif
#ifdef ENCORE_TRAVERSE_GRID
layout(std430, binding = ENCORE_BINDING_CELL_STARTS) readonly restrict buffer CellStarts {
  uint cell_starts[];
};
layout(std430, binding = ENCORE_BINDING_CELL_PLANES) readonly restrict buffer CellPlanes {
  float cell_planes[];
};
#endif
