// Phong shading of one hit (twin of renderer/shading.cpp, which states the model). In single
// precision, where C++ takes double: pictures agree to about 1e-6, and a GPU is not slowed down by
// arithmetic that no eye can tell. Vectors are scaled before they are squared, so neither huge nor
// tiny scenes overflow.
#include "camera_rays.glsl"
#include "numbers.glsl"
#include "scene_buffers.glsl"

layout(std430, binding = ENCORE_BINDING_MATERIALS) readonly restrict buffer Materials {
  Material materials[];  // the last one stands for those that do not exist
};
#ifdef ENCORE_LIGHTS
layout(std430, binding = ENCORE_BINDING_LIGHTS) readonly restrict buffer Lights {
  Light lights[];
};
#endif
#ifdef ENCORE_NORMALS
layout(std430, binding = ENCORE_BINDING_NORMALS) readonly restrict buffer Normals {
  float corner_normals[];
};
#endif
#ifdef ENCORE_COLORS
layout(std430, binding = ENCORE_BINDING_COLORS) readonly restrict buffer Colors {
  float corner_colors[];
};
#endif
#ifdef ENCORE_TEXTURES
#include "texture_lookup.glsl"
#endif

// Unit length; the zero vector stays what it is.
vec3 safe_normalize(vec3 v) {
  float size = largest_component(v);
  return size > 0.0 ? normalize(v / size) : v;
}

// Three vectors that lie packed, nine floats a triangle, weighted by the hit's barycentrics.
#define ENCORE_INTERPOLATE(corners, hit)                                                    \
  (vec3(corners[9u * hit.triangle], corners[9u * hit.triangle + 1u],                        \
        corners[9u * hit.triangle + 2u]) * (1.0 - hit.u - hit.v) +                          \
   vec3(corners[9u * hit.triangle + 3u], corners[9u * hit.triangle + 4u],                   \
        corners[9u * hit.triangle + 5u]) * hit.u +                                          \
   vec3(corners[9u * hit.triangle + 6u], corners[9u * hit.triangle + 7u],                   \
        corners[9u * hit.triangle + 8u]) * hit.v)

#ifdef ENCORE_ONE_LIGHT
uniform uint light_in_hand;
#endif

// Colour, linear RGB, of a surface hit by a ray of unit direction; with ENCORE_ONE_LIGHT what one
// light adds to it.
vec3 shade(vec3 ray_direction, Hit hit) {
  Triangle triangle = triangles[hit.triangle];
  Material material = materials[min(triangle.material, camera.material_count - 1u)];
  vec3 edge1 = triangle.v1 - triangle.v0;
  vec3 edge2 = triangle.v2 - triangle.v0;
  vec3 view = -ray_direction;
  vec3 color = material.glow;

#ifdef ENCORE_LIGHTS
  // The geometric normal on the viewer's side; an interpolated one on the same side.
  float size = max(largest_component(edge1), largest_component(edge2));
  vec3 normal = size > 0.0 ? cross(edge1 / size, edge2 / size) : vec3(0.0);
  if (dot(normal, view) < 0.0) normal = -normal;
#ifdef ENCORE_NORMALS
  vec3 smooth_normal = ENCORE_INTERPOLATE(corner_normals, hit);
  if (largest_component(smooth_normal) > 0.0) {
    normal = dot(smooth_normal, normal) < 0.0 ? -smooth_normal : smooth_normal;
  }
#endif
  normal = largest_component(normal) > 0.0 ? safe_normalize(normal) : view;

  vec3 diffuse = vec3(0.0);
#ifdef ENCORE_SPECULAR
  vec3 specular = vec3(0.0);
#endif
#ifdef ENCORE_ONE_LIGHT
  color = vec3(0.0);
  for (uint i = light_in_hand; i <= light_in_hand; ++i) {
#else
  for (uint i = 0u; i < camera.light_count; ++i) {
#endif
    // From the triangle's own corner: exact to its size, however far away the eye is.
    vec3 to_light = (lights[i].position - triangle.v0) - edge1 * hit.u - edge2 * hit.v;
    vec3 direction = safe_normalize(to_light);
    float cosine = dot(normal, direction);
    // Also skips a light at the point itself.
    if (!(cosine > 0.0)) continue;
    diffuse += lights[i].color * cosine;
#ifdef ENCORE_SPECULAR
    float mirrored = 2.0 * cosine * dot(normal, view) - dot(direction, view);
    if (mirrored > 0.0) {
      specular += lights[i].color * pow(min(mirrored, 1.0), material.shininess);
    }
#endif
  }
  vec3 surface = material.diffuse;
#ifdef ENCORE_COLORS
  surface *= ENCORE_INTERPOLATE(corner_colors, hit);
#endif
#ifdef ENCORE_TEXTURES
  if (material.texture != ENCORE_NO_TEXTURE) {
    surface *= texture_color(material.texture, interpolated_texcoord(hit));
  }
#endif
  color += surface * diffuse;
#ifdef ENCORE_SPECULAR
  color += material.specular * specular;
#endif
#endif
  return color;
}
