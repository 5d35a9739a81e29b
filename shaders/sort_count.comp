// The first step of sort.glsl.
#include "each.glsl"
#include "sort.glsl"

shared uint counts[kSortDigits];

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint block = group_index();
  if (lane < kSortDigits) counts[lane] = 0u;
  barrier();
  // Neighbouring threads read neighbouring keys: who of a block counts a key does not matter.
  for (uint i = 0u; i < kSortEach; ++i) {
    uint index = block * kSortBlock + i * uint(ENCORE_GROUP_SIZE) + lane;
    if (index < key_count) atomicAdd(counts[digit_of(sort_from[index].x)], 1u);
  }
  barrier();
  uint blocks = sort_blocks();
  if (lane < kSortDigits && block < blocks) sort_counts[lane * blocks + block] = counts[lane];
}
