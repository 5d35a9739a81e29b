// The paths of a list, whose rays have been traced: adds what comes from where they have hit, and
// sends them on, or to what waits on their stacks. Where shadows are asked for, what lights add has
// been added before (paths_light.comp).
layout(local_size_x = ENCORE_GROUP_SIZE) in;

#include "path_surface.glsl"

uniform int queue_first;
uniform int ray_count;
#ifdef ENCORE_BOUNCES
// How many surfaces pass light on, one after the other; a path's stack is as long.
uniform uint most_depth;
uniform uint next_reflections;  // where the lists of the next rays begin
uniform uint next_refractions;

layout(std430, binding = ENCORE_BINDING_WAITING_RAYS) restrict buffer WaitingRays {
  WaitingRay waiting_rays[];
};

void go_on_with(uint path, WaitingRay next) {
  paths[path].ray = Ray(next.origin, 0.0, next.direction, kInfinity);
  paths[path].weight = next.weight;
  paths[path].depth = next.depth;
  if (next.refracted != 0u) {
    uint place = atomicAdd(path_queues[ENCORE_QUEUE_REFRACTIONS], 1u);
    path_queues[next_refractions + place] = path;
  } else {
    uint place = atomicAdd(path_queues[ENCORE_QUEUE_REFLECTIONS], 1u);
    path_queues[next_reflections + place] = path;
  }
}

WaitingRay as_waiting(Continuation next, uint depth, bool refracted) {
  return WaitingRay(next.origin, depth, next.direction, refracted ? 1u : 0u, next.weight, 0u);
}

// At the end of the ray in hand.
void take_waiting(uint path) {
  uint waiting = paths[path].waiting;
  if (waiting == 0u) return;
  paths[path].waiting = waiting - 1u;
  go_on_with(path, waiting_rays[path * most_depth + waiting - 1u]);
}

void send_on(uint path, Scattering light, uint depth) {
  if (light.reflection.goes_on && light.refraction.goes_on) {
    uint waiting = paths[path].waiting;
    waiting_rays[path * most_depth + waiting] = as_waiting(light.refraction, depth, true);
    paths[path].waiting = waiting + 1u;
  }
  if (light.reflection.goes_on) {
    go_on_with(path, as_waiting(light.reflection, depth, false));
  } else if (light.refraction.goes_on) {
    go_on_with(path, as_waiting(light.refraction, depth, true));
  } else {
    take_waiting(path);
  }
}
#endif

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= ray_count) return;
  uint path = path_queues[queue_first + i];
  Hit hit = paths[path].hit;
  vec3 weight = paths[path].weight;
  vec3 color = paths[path].color;
  if (hit.triangle == kNoHit) {
    paths[path].color = color + weight * camera.background;
#ifdef ENCORE_BOUNCES
    take_waiting(path);
#endif
    return;
  }
  vec3 ray_direction = paths[path].ray.direction;
#ifdef ENCORE_BOUNCES
  Bounce material = bounce_of(hit.triangle);
  float own = own_share(material);
  if (own > 0.0) paths[path].color = color + weight * own * shade(ray_direction, hit);
  uint depth = paths[path].depth;
  if (own == 1.0 || depth >= most_depth) {
    take_waiting(path);
    return;
  }
  SurfacePoint at = surface_hit(ray_direction, hit);
  send_on(path, scatter(ray_direction, at, material, weight), depth + 1u);
#else
  paths[path].color = color + weight * shade(ray_direction, hit);
#endif
}
