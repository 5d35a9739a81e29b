// Morton codes of the triangles' centres, ten bits an axis, with their triangles. One thread a
// triangle.
#include "build_center.glsl"
#include "each.glsl"
#include "ordered_bits.glsl"

layout(std430, binding = ENCORE_BINDING_BUILD_BOUNDS) readonly restrict buffer BuildBounds {
  int build_bounds[];
};
layout(std430, binding = ENCORE_BINDING_SORT_TO) writeonly restrict buffer Keys {
  uvec2 keys[];
};

// The lowest ten bits, with two zeros before each.
uint spread(uint place) {
  uint bits = place & 0x3FFu;
  bits = (bits | bits << 16) & 0x030000FFu;
  bits = (bits | bits << 8) & 0x0300F00Fu;
  bits = (bits | bits << 4) & 0x030C30C3u;
  return (bits | bits << 2) & 0x09249249u;
}

// An end of the centres' box, an eighth of it: no difference of two is then too large.
float end_of(uint which) {
  return 0.125 * uintBitsToFloat(bits_of_ordered(build_bounds[which]));
}

void main() {
  uint index = thread_index();
  if (index >= thread_count) return;
  vec3 center = 0.125 * center_of(index);
  uint code = 0u;
  for (uint axis = 0u; axis < 3u; ++axis) {
    float lower = end_of(axis);
    float size = -end_of(axis + 3u) - lower;
    // Where they all lie side by side, or as good as that, the axis says nothing.
    float share = size > 1e-37 ? (center[axis] - lower) / size : 0.0;
    code |= spread(uint(clamp(share * 1024.0, 0.0, 1023.0))) << axis;
  }
  keys[index] = uvec2(code, index);
}
