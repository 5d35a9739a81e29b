// The picture below an overlay, whatever its own size.
#include "overlay_view.glsl"

layout(binding = 0) uniform sampler2D backdrop;
layout(location = 0) uniform int linear_values;  // 1: they are linear and have yet to be coded

layout(location = 0) out vec4 painted;

// IEC 61966-2-1.
float srgb(float value) {
  float v = clamp(value, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1.0 / 2.4) - 0.055;
}

void main() {
  ivec2 size = textureSize(backdrop, 0);
  ivec2 texel = min(ivec2(gl_FragCoord.xy * vec2(size) / view.size), size - 1);
  vec3 found = texelFetch(backdrop, texel, 0).rgb;
  if (linear_values != 0) found = vec3(srgb(found.r), srgb(found.g), srgb(found.b));
  painted = vec4(found, 1.0);
}
