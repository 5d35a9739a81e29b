// A path for each pixel of a band: the camera's ray through one sample's place.
layout(local_size_x = ENCORE_GROUP_X, local_size_y = ENCORE_GROUP_Y) in;

#include "camera_rays.glsl"
#include "paths.glsl"
#include "sample_pattern.glsl"

uniform int width;
uniform int first_row;
uniform int row_count;
uniform uint sample_number;
uniform uint seed;
uniform int queue_first;
uniform bool first_sample;  // of those that this picture is the mean of

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (place.x >= width || place.y >= row_count) return;
  ivec2 pixel = ivec2(place.x, first_row + place.y);
  uint path = uint(place.y * width + place.x);
#ifdef ENCORE_SEVERAL_SAMPLES
  paths[path].ray = camera_ray(pixel, sample_offset(pixel, sample_number, seed));
#else
  paths[path].ray = camera_ray(pixel, dvec2(0.5lf, 0.5lf));
#endif
  paths[path].weight = vec3(1.0);
  paths[path].depth = 0u;
  paths[path].waiting = 0u;
  if (first_sample) paths[path].color = vec3(0.0);
  path_queues[uint(queue_first) + path] = path;
}
