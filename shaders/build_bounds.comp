// The box of all triangles' centres: six least numbers, those of the upper ends with the sign
// turned. One thread a triangle; first within a group, then over all.
#include "build_center.glsl"
#include "each.glsl"
#include "ordered_bits.glsl"

layout(std430, binding = ENCORE_BINDING_BUILD_BOUNDS) restrict buffer BuildBounds {
  int build_bounds[];
};

shared int least[6];

void main() {
  uint lane = gl_LocalInvocationID.x;
  if (lane < 6u) least[lane] = 0x7FFFFFFF;
  barrier();
  uint index = thread_index();
  if (index < thread_count) {
    uvec3 center = floatBitsToUint(center_of(index));
    for (uint axis = 0u; axis < 3u; ++axis) {
      atomicMin(least[axis], ordered(center[axis]));
      atomicMin(least[axis + 3u], ordered(center[axis] ^ 0x80000000u));
    }
  }
  barrier();
  if (lane < 6u) atomicMin(build_bounds[lane], least[lane]);
}
