// The stretch of a ray inside a box, conservatively (twin of accel/box_hit.h; Ize 2013).
//
// C++ relies on IEEE's infinities and NaNs for rays that are parallel to an axis. GLSL need not
// honour NaN, and compilers fold 0 * x, so here such axes are told apart beforehand and no
// arithmetic is done with them: whatever a driver makes of NaN, the answer is the same.
#include "numbers.glsl"

struct BoxRay {
  vec3 origin;
  vec3 inverse;    // 1 / direction; 0 on axes that are parallel or cannot be inverted
  bool plain;      // neither of the two below anywhere: nearly every ray
  bvec3 parallel;  // direction component 0: the ray is beside, or inside for good
  bvec3 untimed;   // not 0, but its reciprocal is not to be had at full precision: may be anywhere
};

BoxRay make_box_ray(Ray ray) {
  // By their bits: a driver may flush what is below the normal range to 0 where it computes.
  // GLSL divides to 2.5 ulp for denominators from 2^-126 to 2^126.
  uvec3 magnitude = floatBitsToUint(ray.direction) & 0x7FFFFFFFu;
  BoxRay box_ray;
  box_ray.origin = ray.origin;
  box_ray.parallel = equal(magnitude, uvec3(0u));
  bvec3 divisible = bvec3(uvec3(greaterThanEqual(magnitude, uvec3(1u << 23))) *
                          uvec3(lessThanEqual(magnitude, uvec3(253u << 23))));
  box_ray.plain = all(divisible);
  box_ray.untimed = not(bvec3(uvec3(divisible) + uvec3(box_ray.parallel)));
  box_ray.inverse = mix(vec3(0.0), 1.0 / mix(vec3(1.0), ray.direction, divisible), divisible);
  return box_ray;
}

// Over t in [t_min, t_max], both >= 0; false if the ray certainly misses the closed box.
bool box_stretch(vec3 lower, vec3 upper, BoxRay ray, float t_min, float t_max, out float enter,
                 out float leave) {
  precise vec3 lower_t = (lower - ray.origin) * ray.inverse;
  precise vec3 upper_t = (upper - ray.origin) * ray.inverse;
  vec3 near = min(lower_t, upper_t);
  vec3 far = max(lower_t, upper_t);
  if (!ray.plain) {
    bvec3 inside = bvec3(uvec3(lessThanEqual(lower, ray.origin)) *
                         uvec3(lessThanEqual(ray.origin, upper)));
    bvec3 open = bvec3(uvec3(inside) * uvec3(ray.parallel) + uvec3(ray.untimed));
    bvec3 shut = bvec3(uvec3(not(inside)) * uvec3(ray.parallel));
    near = mix(mix(near, vec3(-kLargestFloat), open), vec3(kLargestFloat), shut);
    far = mix(mix(far, vec3(kLargestFloat), open), vec3(-kLargestFloat), shut);
  }
  enter = max(max(near.x, near.y), max(near.z, t_min));
  leave = min(min(far.x, far.y), min(far.z, t_max));
  return enter * kNarrow <= leave * kWiden;
}
