// One light and the paths of a list: where it may add something, a ray that asks whether it does.
layout(local_size_x = ENCORE_GROUP_SIZE) in;

#include "path_surface.glsl"
#include "shadow_rays.glsl"

uniform int queue_first;
uniform int ray_count;

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= ray_count) return;
  uint path = path_queues[queue_first + i];
  Hit hit = paths[path].hit;
  if (hit.triangle == kNoHit) return;
  vec3 ray_direction = paths[path].ray.direction;
  vec3 weight = paths[path].weight;
#ifdef ENCORE_BOUNCES
  float own = own_share(bounce_of(hit.triangle));
  if (!(own > 0.0)) return;
  weight *= own;
#endif
  SurfacePoint at = surface_hit(ray_direction, hit);
  ShadowRay ray;
  if (!shadow_ray(at, lights[light_in_hand].position, ray.origin, ray.direction, ray.t_max)) return;
  ray.path = path;
  ray.light = weight * shade(ray_direction, hit);
  ray.reserved0 = 0u;
  shadow_rays[atomicAdd(path_queues[ENCORE_QUEUE_SHADOWS], 1u)] = ray;
}
