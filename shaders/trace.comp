// One ray a thread: ray, nearest hit, and what is asked of it. Defines pick the traversal and leave
// out the rest (renderer/trace_defines.h lists them).
layout(local_size_x = ENCORE_GROUP_X, local_size_y = ENCORE_GROUP_Y) in;

// A file is put in once, where it is first named, whatever the conditions: so what several branches
// need comes before them.
#include "box_hit.glsl"
#include "counters.glsl"
#include "numbers.glsl"
#include "triangle_filter.glsl"
#include "pausing.glsl"
#ifdef ENCORE_PAUSE_AFTER
// One slot a ray of this piece: one of the states below; for a ray that has paused also its hit so
// far, what it has cost so far, and where its traversal stands.
layout(std430, binding = ENCORE_BINDING_PAUSED_RAYS) restrict buffer PausedRays {
  uint paused_rays[];
};
// How many rays of this piece are not done.
layout(std430, binding = ENCORE_BINDING_PAUSED_COUNT) restrict buffer PausedCount {
  uint paused_count;
};
const uint kRayDone = 0u;
const uint kRayPaused = 1u;
const uint kRayGaveUp = 2u;  // to begin again in the program that can pause
const uint kPausedHeaderWords = 8u;
uniform int slot_words;
uniform int first_slot;  // the ray whose slot is the first
#endif
#ifdef ENCORE_TRAVERSE_BVH
#include "traverse_bvh.glsl"
#endif
#ifdef ENCORE_TRAVERSE_WIDE
#include "traverse_wide.glsl"
#endif
#ifdef ENCORE_TRAVERSE_KDTREE
#include "traverse_kdtree.glsl"
#endif
#ifdef ENCORE_TRAVERSE_GRID
#include "traverse_grid.glsl"
#endif
#ifdef ENCORE_RAYS_FROM_BUFFER
layout(std430, binding = ENCORE_BINDING_RAYS) readonly restrict buffer Rays {
  Ray rays[];
};
uniform int ray_count;
#elif defined(ENCORE_PATHS)
#include "paths.glsl"
#ifdef ENCORE_ANY_HIT
#include "shadow_rays.glsl"
#else
uniform int ray_count;
uniform int queue_first;  // where the list of these rays' paths begins
#endif
#else
#include "camera_rays.glsl"
#endif
#ifdef ENCORE_OUTPUT_PICTURE
#include "shading.glsl"
layout(rgba32f, binding = ENCORE_BINDING_PICTURE) writeonly restrict uniform image2D picture;
#endif
#ifdef ENCORE_OUTPUT_HITS
layout(std430, binding = ENCORE_BINDING_HITS) writeonly restrict buffer Hits {
  Hit hits[];
};
#endif
#ifdef ENCORE_OUTPUT_COUNTERS
layout(std430, binding = ENCORE_BINDING_COUNTERS) writeonly restrict buffer Counters {
  uint ray_counters[];
};
#endif

uniform ivec2 first_pixel;  // of this piece of the picture
uniform ivec2 last_pixel;   // one past it
uniform int width;          // of the whole picture
uniform int first_index;    // the ray whose result lies first in the buffer

#if defined(ENCORE_PAUSE_AFTER) && !defined(ENCORE_RESUMABLE)
// False if the ray gave up.
bool trace(Ray ray, int index, inout Hit hit) {
  uint slot = uint(index - first_slot) * uint(slot_words);
  start_traversal(ray);
  bool done = traverse(ray, hit);
  paused_rays[slot] = done ? kRayDone : kRayGaveUp;
  if (!done) atomicAdd(paused_count, 1u);
  return done;
}
#elif defined(ENCORE_RESUMABLE)
// False if the ray paused, or was done before.
bool trace(Ray ray, int index, inout Hit hit) {
  uint slot = uint(index - first_slot) * uint(slot_words);
  if (paused_rays[slot] == kRayDone) return false;
  if (paused_rays[slot] == kRayPaused) {
    hit = Hit(uintBitsToFloat(paused_rays[slot + 1u]), paused_rays[slot + 2u],
              uintBitsToFloat(paused_rays[slot + 3u]), uintBitsToFloat(paused_rays[slot + 4u]));
#ifdef ENCORE_OUTPUT_COUNTERS
    counted_steps = paused_rays[slot + 5u];
    counted_box_tests = paused_rays[slot + 6u];
    counted_triangle_tests = paused_rays[slot + 7u];
#endif
    load_traversal(slot + kPausedHeaderWords, ray);
  } else {
    start_traversal(ray);
  }
  if (traverse(ray, hit)) {
    paused_rays[slot] = kRayDone;
    return true;
  }
  paused_rays[slot] = kRayPaused;
  paused_rays[slot + 1u] = floatBitsToUint(hit.t);
  paused_rays[slot + 2u] = hit.triangle;
  paused_rays[slot + 3u] = floatBitsToUint(hit.u);
  paused_rays[slot + 4u] = floatBitsToUint(hit.v);
#ifdef ENCORE_OUTPUT_COUNTERS
  paused_rays[slot + 5u] = counted_steps;
  paused_rays[slot + 6u] = counted_box_tests;
  paused_rays[slot + 7u] = counted_triangle_tests;
#endif
  store_traversal(slot + kPausedHeaderWords);
  atomicAdd(paused_count, 1u);
  return false;
}
#else
bool trace(Ray ray, int index, inout Hit hit) {
  start_traversal(ray);
  traverse(ray, hit);
  return true;
}
#endif

void main() {
  ivec2 pixel = first_pixel + ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, last_pixel))) return;
  int index = pixel.y * width + pixel.x;
#ifdef ENCORE_RAYS_FROM_BUFFER
  if (index >= ray_count) return;
  Ray ray = rays[index];
#elif defined(ENCORE_PATHS) && !defined(ENCORE_ANY_HIT)
  if (index >= ray_count) return;
  uint path = path_queues[queue_first + index];
  Ray ray = paths[path].ray;
#elif defined(ENCORE_PATHS)
  if (uint(index) >= path_queues[ENCORE_QUEUE_SHADOWS]) return;
  Ray ray = Ray(shadow_rays[index].origin, 0.0, shadow_rays[index].direction,
                shadow_rays[index].t_max);
#else
  Ray ray = camera_ray(pixel);
#endif
  Hit hit = Hit(ray.t_max, kNoHit, 0.0, 0.0);
  if (!trace(ray, index, hit)) return;

#ifdef ENCORE_OUTPUT_PICTURE
  vec3 color = hit.triangle != kNoHit ? shade(ray.direction, hit) : camera.background;
  imageStore(picture, pixel, vec4(color, 1.0));
#endif
#ifdef ENCORE_OUTPUT_HITS
  hits[index - first_index] = hit;
#endif
#if defined(ENCORE_PATHS) && !defined(ENCORE_ANY_HIT)
  paths[path].hit = hit;
#endif
#if defined(ENCORE_PATHS) && defined(ENCORE_ANY_HIT)
  if (hit.triangle == kNoHit) paths[shadow_rays[index].path].color += shadow_rays[index].light;
#endif
#ifdef ENCORE_OUTPUT_COUNTERS
  uint place = 3u * uint(index - first_index);
  ray_counters[place] = counted_steps;
  ray_counters[place + 1u] = counted_box_tests;
  ray_counters[place + 2u] = counted_triangle_tests;
#endif
}
