// Binding points and sizes that C++ and GLSL share. One program uses only some of them.
#ifndef ENCORE_SHADERS_SHARED_BINDINGS_H
#define ENCORE_SHADERS_SHARED_BINDINGS_H

// Storage buffers.
#define ENCORE_BINDING_TRIANGLES 0    // gpu::Triangle[]
#define ENCORE_BINDING_NODES 1        // gpu::BvhNode[] or gpu::KdNode[]
#define ENCORE_BINDING_REFERENCES 2   // uint[]: triangle indices, in leaf or cell order
#define ENCORE_BINDING_CELL_STARTS 3  // uint[]: grid, first reference of each cell, one more at end
#define ENCORE_BINDING_CELL_PLANES 4  // float[]: grid, cell boundaries of x, then y, then z
#define ENCORE_BINDING_MATERIALS 5    // gpu::Material[]
#define ENCORE_BINDING_LIGHTS 6       // gpu::Light[]
#define ENCORE_BINDING_NORMALS 7      // float[]: nine a triangle, shading normals of its corners
#define ENCORE_BINDING_COLORS 8       // float[]: nine a triangle, colours of its corners
#define ENCORE_BINDING_RAYS 9         // gpu::Ray[]: rays that come from a buffer
#define ENCORE_BINDING_HITS 10        // gpu::Hit[]: results
#define ENCORE_BINDING_COUNTERS 11    // uint[]: three a ray: steps, box tests, triangle tests
#define ENCORE_BINDING_PAUSED_RAYS 12   // uint[]: a slot a ray, see pausing.glsl
#define ENCORE_BINDING_PAUSED_COUNT 13  // uint: how many slots are in use
#define ENCORE_BINDING_TEXCOORDS 14  // float[]: six a triangle, texture coordinates of its corners
#define ENCORE_BINDING_TEXTURES 15   // uint[]: see texture_lookup.glsl
// Pictures of several rays a pixel (paths.glsl) reuse the bindings of what they do not need.
#define ENCORE_BINDING_PATHS 9          // gpu::Path[]: one a pixel of a band
#define ENCORE_BINDING_PATH_QUEUES 10   // uint[]: who is to be traced
#define ENCORE_BINDING_SHADOW_RAYS 11   // gpu::ShadowRay[]: of one light
#define ENCORE_BINDING_WAITING_RAYS 12  // gpu::WaitingRay[]: a stack a path
#define ENCORE_BINDING_BOUNCES 13       // gpu::Bounce[]: what materials mirror and let through
// The refit pass alone reuses the bindings of what it does not need.
#define ENCORE_BINDING_PARENTS 2      // uint[]: of each pair of siblings, the parent's index
#define ENCORE_BINDING_ARRIVALS 3     // uint[]: of each pair of siblings, who has arrived
#define ENCORE_BINDING_LEAF_WRITES 4  // uint[]: one bit a node, which leaves are to be written
#define ENCORE_BINDING_WIDE_PARENTS 4  // uint[]: of each gpu::WideNode, eight times its parent and
                                       // its place there
// A build on the device, which ends with a refit, too.
#define ENCORE_BINDING_BUILD_BOUNDS 4  // int[]: the box of all centres
#define ENCORE_BINDING_SORT_FROM 5     // uvec2[]: a key and its triangle
#define ENCORE_BINDING_SORT_TO 6       // the same, sorted by another digit
#define ENCORE_BINDING_SORT_COUNTS 7   // uint[]: by digit and block

// Uniform buffers.
#define ENCORE_BINDING_STRUCTURE 0  // gpu::StructureParameters
#define ENCORE_BINDING_CAMERA 1     // gpu::CameraParameters

// Words at the start of the path queues.
#define ENCORE_QUEUE_SHADOWS 0      // shadow rays of the light in hand
#define ENCORE_QUEUE_REFLECTIONS 1  // how many paths go on with a reflected ray
#define ENCORE_QUEUE_REFRACTIONS 2  // how many with a refracted one
#define ENCORE_QUEUE_WORDS 4        // what lists begin after

// Images.
#define ENCORE_BINDING_PICTURE 0  // rgba32f, linear RGB, row 0 at the top

#endif
