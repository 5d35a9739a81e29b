// The mean of a band's samples becomes its part of the picture.
layout(local_size_x = ENCORE_GROUP_X, local_size_y = ENCORE_GROUP_Y) in;

#include "paths.glsl"

layout(rgba32f, binding = ENCORE_BINDING_PICTURE) writeonly restrict uniform image2D picture;

uniform int width;
uniform int first_row;
uniform int row_count;
uniform int sample_count;

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (place.x >= width || place.y >= row_count) return;
  vec3 color = paths[place.y * width + place.x].color / float(sample_count);
  imageStore(picture, ivec2(place.x, first_row + place.y), vec4(color, 1.0));
}
