#pragma once

#include "renderer/portable_power.h"
#include "renderer/shading.h"
#include "renderer/texture_lookup.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace encore::renderer {

// The parts of Phong's model (shading.h), for those who add lights one after the other. Whatever
// `kNeeds` leaves out is not compiled.

inline const scene::Material& material_of(const scene::Scene& scene,
                                          const scene::Triangle& triangle) {
  static const scene::Material kMissing;
  return triangle.material < scene.materials.size() ? scene.materials[triangle.material] : kMissing;
}

template <class Vector, class Corners>
Vector interpolate(const Corners& corners, const scene::Hit& hit) {
  using T = typename Vector::value_type;
  const T u = hit.u;
  const T v = hit.v;
  return Vector(corners[0]) * (T(1) - u - v) + Vector(corners[1]) * u + Vector(corners[2]) * v;
}

/// A point that lights shine on, in double precision.
struct LitSurface {
  const scene::Material* material = nullptr;
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0};  ///< unit shading normal on the viewer's side
  glm::dvec3 view{0.0};    ///< unit, towards the viewer
  double shininess = 0.0;
  bool shines = false;  ///< has a specular colour; of use only where highlights are wanted

  template <ShadingNeeds kNeeds>
  void set_material(const scene::Material& of) {
    material = &of;
    if constexpr (kNeeds.specular) {
      shininess = std::max(0.0, static_cast<double>(of.shininess));
      shines = of.specular != glm::vec3(0.0F);
    }
  }
};

/// Light that arrives at a point, by how it leaves again.
struct Reflected {
  glm::vec3 diffuse{0.0F};
  glm::vec3 specular{0.0F};
};

template <ShadingNeeds kNeeds>
LitSurface lit_surface(const ShadingScene& input, const scene::Ray& ray, const scene::Hit& hit) {
  const scene::Triangle& triangle = input.triangles->triangles[hit.triangle];
  LitSurface surface;
  surface.set_material<kNeeds>(material_of(*input.scene, triangle));
  const glm::dvec3 corner(triangle.v0);
  const glm::dvec3 edge1 = glm::dvec3(triangle.v1) - corner;
  const glm::dvec3 edge2 = glm::dvec3(triangle.v2) - corner;
  surface.view = -glm::dvec3(ray.direction);

  // The geometric normal on the viewer's side.
  glm::dvec3 normal = glm::cross(edge1, edge2);
  if (glm::dot(normal, surface.view) < 0.0) normal = -normal;
  if constexpr (kNeeds.normals) {
    const auto smooth = interpolate<glm::dvec3>(input.triangles->normals[hit.triangle], hit);
    if (glm::dot(smooth, smooth) > 0.0) {
      normal = glm::dot(smooth, normal) < 0.0 ? -smooth : smooth;
    }
  }
  const double squared_length = glm::dot(normal, normal);
  surface.normal = squared_length > 0.0 ? normal * (1.0 / std::sqrt(squared_length)) : surface.view;

  // From barycentrics: exact to the triangle's size, however far the eye is away.
  surface.point = corner + edge1 * static_cast<double>(hit.u) + edge2 * static_cast<double>(hit.v);
  return surface;
}

/// `mirrored`: the cosine between the view and the light's mirrored direction.
inline void add_highlight(const LitSurface& surface, const scene::Light& light, double mirrored,
                          Reflected& sum) {
  // What a dull surface does not reflect need not be known.
  if (!(mirrored > 0.0) || !surface.shines) return;
  const double highlight = portable_power(std::min(mirrored, 1.0), surface.shininess);
  sum.specular += light.color * static_cast<float>(highlight);
}

/// Adds what reaches the surface of a light that nothing stands in front of.
template <ShadingNeeds kNeeds>
void add_light(const LitSurface& surface, const scene::Light& light, Reflected& sum) {
  const glm::dvec3 to_light = glm::dvec3(light.position) - surface.point;
  const double along_normal = glm::dot(surface.normal, to_light);
  // Also skips a light at the point itself.
  if (!(along_normal > 0.0)) return;
  const double inverse_distance = 1.0 / std::sqrt(glm::dot(to_light, to_light));
  const double cosine = along_normal * inverse_distance;
  sum.diffuse += light.color * static_cast<float>(cosine);
  if constexpr (kNeeds.specular) {
    // R = 2 (N.L) N - L, so R.V needs no vector of its own.
    const double mirrored = 2.0 * cosine * glm::dot(surface.normal, surface.view) -
                            glm::dot(to_light, surface.view) * inverse_distance;
    add_highlight(surface, light, mirrored, sum);
  }
}

/// The colour of a surface that this light arrives at.
template <ShadingNeeds kNeeds>
glm::vec3 surface_color(const ShadingScene& input, const LitSurface& surface, const scene::Hit& hit,
                        const Reflected& light) {
  const scene::Material& material = *surface.material;
  glm::vec3 diffuse = material.diffuse;
  if constexpr (kNeeds.colors) {
    diffuse *= interpolate<glm::vec3>(input.triangles->colors[hit.triangle], hit);
  }
  if constexpr (kNeeds.textures) {
    if (material.diffuse_texture != nullptr) {
      diffuse *=
          texture_color(*material.diffuse_texture,
                        interpolate<glm::vec2>(input.triangles->texcoords[hit.triangle], hit));
    }
  }
  glm::vec3 color = material.emission + kAmbientLight * material.ambient + diffuse * light.diffuse;
  if constexpr (kNeeds.specular) color += material.specular * light.specular;
  return color;
}

inline constexpr std::size_t kShadingVariants = 16;

inline constexpr ShadingNeeds variant_needs(std::size_t variant) {
  return {.normals = (variant & 8U) != 0,
          .colors = (variant & 4U) != 0,
          .textures = (variant & 2U) != 0,
          .specular = (variant & 1U) != 0};
}

inline constexpr std::size_t variant_of(const ShadingNeeds& needs) {
  return (needs.normals ? 8U : 0U) + (needs.colors ? 4U : 0U) + (needs.textures ? 2U : 0U) +
         (needs.specular ? 1U : 0U);
}

}  // namespace encore::renderer
