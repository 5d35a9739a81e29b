// Storage-buffer binding points, shared by C++ and GLSL. One structure uses only some of them.
#ifndef ENCORE_SHADERS_SHARED_BINDINGS_H
#define ENCORE_SHADERS_SHARED_BINDINGS_H

#define ENCORE_BINDING_TRIANGLES 0   // gpu::Triangle[]
#define ENCORE_BINDING_NODES 1       // gpu::BvhNode[] or gpu::KdNode[]
#define ENCORE_BINDING_REFERENCES 2  // uint[]: triangle indices, in leaf or cell order
#define ENCORE_BINDING_CELL_STARTS \
  3  // uint[]: grid, first reference of each cell, one more at the end
#define ENCORE_BINDING_CELL_PLANES 4  // float[]: grid, cell boundaries of x, then y, then z

#endif
