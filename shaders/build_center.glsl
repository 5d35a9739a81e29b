// Where a triangle lies, for who builds a tree of it: the middle of its box. A rounding or a number
// flushed to zero moves a triangle in the order and changes no hit.
#include "shaders/shared/bindings.h"
#include "shaders/shared/gpu_types.h"

layout(std430, binding = ENCORE_BINDING_TRIANGLES) readonly restrict buffer Triangles {
  Triangle triangles[];
};

vec3 center_of(uint index) {
  Triangle triangle = triangles[index];
  vec3 lower = min(min(triangle.v0, triangle.v1), triangle.v2);
  vec3 upper = max(max(triangle.v0, triangle.v1), triangle.v2);
  return 0.5 * lower + 0.5 * upper;
}
