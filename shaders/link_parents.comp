// Tells every pair of siblings of a bounding volume hierarchy who their parent is. One thread a
// node; children lie side by side, at 2k - 1 and 2k, so a pair needs a single link.
layout(local_size_x = ENCORE_GROUP_SIZE) in;

#include "shaders/shared/bindings.h"
#include "shaders/shared/gpu_types.h"

layout(std430, binding = ENCORE_BINDING_NODES) readonly restrict buffer Nodes {
  BvhNode nodes[];
};
layout(std430, binding = ENCORE_BINDING_PARENTS) writeonly restrict buffer Parents {
  uint parents[];
};

uniform uint node_count;

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint node = group * uint(ENCORE_GROUP_SIZE) + gl_LocalInvocationID.x;
  if (node >= node_count || nodes[node].count != 0u) return;
  parents[(nodes[node].first + 1u) / 2u] = node;
}
