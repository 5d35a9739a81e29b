// Tells every pair of siblings of a bounding volume hierarchy who their parent is. One thread a
// node; children lie side by side, at 2k - 1 and 2k, so a pair needs a single link.
#include "each.glsl"
#include "shaders/shared/bindings.h"
#include "shaders/shared/gpu_types.h"

layout(std430, binding = ENCORE_BINDING_NODES) readonly restrict buffer Nodes {
  BvhNode nodes[];
};
layout(std430, binding = ENCORE_BINDING_PARENTS) writeonly restrict buffer Parents {
  uint parents[];
};

void main() {
  uint node = thread_index();
  if (node >= thread_count || nodes[node].count != 0u) return;
  parents[(nodes[node].first + 1u) / 2u] = node;
}
