// The boxes of an overlay, all of them, of which an instance draws the one of its index.
layout(location = 0) in uint box;
layout(binding = 2) uniform usamplerBuffer box_data;    // two texels a box: min, rgba; max, flags
layout(binding = 3) uniform usamplerBuffer box_colors;  // rgba

const uint kFilled = 1u;
const uint kBold = 2u;

struct Box {
  vec3 low;
  vec3 high;
  vec4 color;
  uint flags;
};

Box fetch_box() {
  int place = 2 * int(box);
  uvec4 first = texelFetch(box_data, place);
  uvec4 second = texelFetch(box_data, place + 1);
  uint rgba = texelFetch(box_colors, int(box)).r;
  return Box(uintBitsToFloat(first.xyz), uintBitsToFloat(second.xyz), unpackUnorm4x8(rgba),
             second.w);
}

// False for what has no extent: an empty box, or one without end.
bool is_box(Box b) {
  return all(lessThanEqual(b.low, b.high)) && all(lessThan(abs(b.low), vec3(3.4e38))) &&
         all(lessThan(abs(b.high), vec3(3.4e38)));
}
