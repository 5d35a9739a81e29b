// Holds triangles against a ray: by the mode of intersection, test_triangle() is the twin of
// accel/triangle_filter.h, triangle_moller_trumbore.h or triangle_watertight.h. What it needs of a
// ray is worked out once, by prepare_ray().
#include "numbers.glsl"
#include "scene_buffers.glsl"
#ifdef ENCORE_MOLLER_TRUMBORE
#include "triangle_moller_trumbore.glsl"
#else
#include "triangle_hit.glsl"
#ifdef ENCORE_WATERTIGHT
#include "triangle_watertight.glsl"
#else
#include "triangle_precise.glsl"
#endif
#endif

// Ends a traversal (which is to return true when it is over) at the first hit that it accepts, where
// any will do: programs for rays that only ask whether something is in the way define
// ENCORE_ANY_HIT. A ray that pauses has not hit anything yet, so nothing of this need be stored.
#ifdef ENCORE_ANY_HIT
#define ENCORE_END_IF_HIT \
  if (hit.triangle != kNoHit) return true
#else
#define ENCORE_END_IF_HIT
#endif
