// A texture's colour at a coordinate (twin of renderer/texture_lookup.cpp; texture_lookup.h states
// it), in single precision.
#include "numbers.glsl"
#include "shaders/shared/bindings.h"

layout(std430, binding = ENCORE_BINDING_TEXCOORDS) readonly restrict buffer Texcoords {
  float corner_texcoords[];
};
// The linear values of 8-bit sRGB ones, as bits of floats; then four words a texture: where its
// texels begin, its width and height, 0; then all texels.
layout(std430, binding = ENCORE_BINDING_TEXTURES) readonly restrict buffer Textures {
  uint textures[];
};

vec3 texel(uint place) {
  uint value = textures[place];
  return vec3(uintBitsToFloat(textures[value & 255u]),
              uintBitsToFloat(textures[(value >> 8u) & 255u]),
              uintBitsToFloat(textures[(value >> 16u) & 255u]));
}

// In [0, 1), also where rounding would make it 1.
float wrapped(float coordinate) {
  precise float inside = coordinate - floor(coordinate);
  return inside >= 0.0 && inside < 1.0 ? inside : 0.0;
}

vec3 texture_color(uint number, vec2 coordinate) {
  uint header = 256u + 4u * number;
  uint first = textures[header];
  int width = int(textures[header + 1u]);
  int height = int(textures[header + 2u]);
  precise float x = wrapped(coordinate.x) * float(width) - 0.5;
  precise float y = (1.0 - wrapped(coordinate.y)) * float(height) - 0.5;
  int left = int(floor(x));
  int above = int(floor(y));
  int right = left + 1 < width ? left + 1 : 0;
  int below = above + 1 < height ? above + 1 : 0;
  float right_share = x - floor(x);
  float below_share = y - floor(y);
  if (left < 0) left = width - 1;
  if (above < 0) above = height - 1;
  uint upper_row = first + uint(above * width);
  uint lower_row = first + uint(below * width);
  vec3 upper = texel(upper_row + uint(left)) * (1.0 - right_share) +
               texel(upper_row + uint(right)) * right_share;
  vec3 lower = texel(lower_row + uint(left)) * (1.0 - right_share) +
               texel(lower_row + uint(right)) * right_share;
  return upper * (1.0 - below_share) + lower * below_share;
}

// In the order of the CPU: a far coordinate's rounding would show.
vec2 interpolated_texcoord(Hit hit) {
  uint first = 6u * hit.triangle;
  vec2 at0 = vec2(corner_texcoords[first], corner_texcoords[first + 1u]);
  vec2 at1 = vec2(corner_texcoords[first + 2u], corner_texcoords[first + 3u]);
  vec2 at2 = vec2(corner_texcoords[first + 4u], corner_texcoords[first + 5u]);
  precise vec2 coordinate = at0 * (1.0 - hit.u - hit.v) + at1 * hit.u + at2 * hit.v;
  return coordinate;
}
