// What a path's ray has hit, ready for rays that leave from there.
#include "paths.glsl"
#include "scatter.glsl"
#include "shading.glsl"

#ifdef ENCORE_BOUNCES
layout(std430, binding = ENCORE_BINDING_BOUNCES) readonly restrict buffer Bounces {
  Bounce bounces[];  // as many as materials
};

Bounce bounce_of(uint triangle) {
  return bounces[min(triangles[triangle].material, camera.material_count - 1u)];
}
#endif

#ifdef ENCORE_NORMALS
dvec3 corner_normal(uint triangle, uint corner) {
  uint first = 9u * triangle + 3u * corner;
  return dvec3(corner_normals[first], corner_normals[first + 1u], corner_normals[first + 2u]);
}
#endif

SurfacePoint surface_hit(vec3 ray_direction, Hit hit) {
  precise dvec3 smooth_normal = dvec3(0.0lf);
#ifdef ENCORE_NORMALS
  double u = double(hit.u);
  double v = double(hit.v);
  smooth_normal = corner_normal(hit.triangle, 0u) * (1.0lf - u - v) +
                  corner_normal(hit.triangle, 1u) * u + corner_normal(hit.triangle, 2u) * v;
#endif
  Triangle triangle = triangles[hit.triangle];
  return surface_point(ray_direction, hit, triangle.v0, triangle.v1, triangle.v2, smooth_normal);
}
