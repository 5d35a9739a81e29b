// Tells the nodes of a hierarchy of up to eight children a node who their parent is. One thread a
// child.
#include "each.glsl"
#include "shaders/shared/bindings.h"
#include "wide_words.glsl"

layout(std430, binding = ENCORE_BINDING_WIDE_PARENTS) writeonly restrict buffer Parents {
  uint parents[];
};

void main() {
  uint index = thread_index();
  if (index >= thread_count) return;
  uint child = wide_child_of(index / 8u, index % 8u);
  // Who is not there has the leaf's bit, too.
  if ((child & kWideLeafBit) == 0u) parents[child] = index;
}
