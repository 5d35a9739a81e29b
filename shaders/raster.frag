// The colour of a triangle in one pixel, shaded exactly as a ray's hit would be.
#include "shading.glsl"

layout(early_fragment_tests) in;

in vec2 weights;
flat in uint triangle_index;

layout(location = 4) uniform vec3 forward;
layout(location = 6) uniform vec3 right;
layout(location = 7) uniform vec3 up;
layout(location = 8) uniform vec2 center;

layout(location = 0) out vec4 color;

void main() {
  // The ray through this pixel's centre (renderer/camera_rays.h), in single precision: only shading
  // depends on it here. Orthographic views come with a `right` and `up` of zero. gl_FragCoord
  // counts rows from the picture's top.
  vec3 along = forward + (gl_FragCoord.x - center.x) * right + (center.y - gl_FragCoord.y) * up;
  vec3 direction = safe_normalize(along);
  // Interpolation strays where a triangle almost touches the eye. Shading does not ask how far away
  // the hit is.
  float u = clamp(weights.x, 0.0, 1.0);
  float v = clamp(weights.y, 0.0, 1.0 - u);
  Hit hit = Hit(0.0, triangle_index, u, v);
  color = vec4(shade(direction, hit), 1.0);
}
