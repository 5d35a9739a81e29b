// Structs of pictures that take more than one ray a pixel, as in gpu_types.h.
#ifndef ENCORE_SHADERS_SHARED_PATH_TYPES_H
#define ENCORE_SHADERS_SHARED_PATH_TYPES_H

#include "shaders/shared/gpu_types.h"

#ifdef __cplusplus
namespace encore::gpu {
#endif

// What becomes of a ray at a material (renderer/paths/scatter.h), where rays go on.
struct Bounce {
  vec3 specular;
  float reflectivity;
  float opacity;
  float index_of_refraction;
  uint reserved0;
  uint reserved1;
};

// What one pixel's light is followed by, where that takes more than one ray.
struct Path {
  Ray ray;  // the one in hand, and its hit
  Hit hit;
  vec3 weight;   // share of the ray's light that reaches the eye
  uint depth;    // how many surfaces have passed it on
  vec3 color;    // sum over all rays of all samples so far
  uint waiting;  // rays on the path's stack
};

// A ray that a path goes on with later.
struct WaitingRay {
  vec3 origin;
  uint depth;
  vec3 direction;
  uint refracted;  // 1: a refraction, 0: a reflection
  vec3 weight;
  uint reserved0;
};

// A ray towards a light, and what the light adds to the path's colour if nothing is in the way.
struct ShadowRay {
  vec3 origin;
  uint path;
  vec3 direction;
  float t_max;
  vec3 light;
  uint reserved0;
};

#ifdef __cplusplus
static_assert(sizeof(Bounce) == 32);
static_assert(sizeof(Path) == 80 && offsetof(Path, color) == 64);
static_assert(sizeof(WaitingRay) == 48 && sizeof(ShadowRay) == 48);
}  // namespace encore::gpu
#endif

#endif
