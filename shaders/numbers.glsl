// Constants that C++ takes from <limits>, and what several shaders say of a ray and a hit.
#ifndef ENCORE_NUMBERS_GLSL
#define ENCORE_NUMBERS_GLSL

#include "shaders/shared/gpu_types.h"
#include "shaders/shared/tolerance.h"

const uint kNoHit = 0xFFFFFFFFu;  // scene/ray.h
// Macros, since compilers differ on whether a conversion of bits is a constant expression.
#define kLargestFloat uintBitsToFloat(0x7F7FFFFFu)
#define kInfinity uintBitsToFloat(0x7F800000u)

const float kWiden = 1.0 + ENCORE_PLANE_SLACK;   // accel/tolerance.h
const float kNarrow = 1.0 - ENCORE_PLANE_SLACK;

float largest_component(vec3 v) {
  return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

#endif
