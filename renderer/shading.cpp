#include "renderer/shading.h"

#include "renderer/portable_power.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace encore::renderer {

namespace {

using scene::Hit;
using scene::Material;
using scene::Ray;
using scene::Triangle;

const Material& material_of(const scene::Scene& scene, const Triangle& triangle) {
  static const Material kMissing;
  return triangle.material < scene.materials.size() ? scene.materials[triangle.material] : kMissing;
}

template <class Vector>
Vector interpolate(const std::array<glm::vec3, 3>& corners, const Hit& hit) {
  using T = typename Vector::value_type;
  const T u = hit.u;
  const T v = hit.v;
  return Vector(corners[0]) * (T(1) - u - v) + Vector(corners[1]) * u + Vector(corners[2]) * v;
}

/// Light that arrives at a point, by how it leaves again.
struct Reflected {
  glm::vec3 diffuse{0.0F};
  glm::vec3 specular{0.0F};
};

template <bool Specular>
Reflected reflect_lights(const scene::Scene& scene, const glm::dvec3& point,
                         const glm::dvec3& normal, const glm::dvec3& view, double shininess) {
  Reflected sum;
  for (const scene::Light& light : scene.lights) {
    const glm::dvec3 to_light = glm::dvec3(light.position) - point;
    const double along_normal = glm::dot(normal, to_light);
    // Also skips a light at the point itself.
    if (!(along_normal > 0.0)) continue;
    const double inverse_distance = 1.0 / std::sqrt(glm::dot(to_light, to_light));
    const double cosine = along_normal * inverse_distance;
    sum.diffuse += light.color * static_cast<float>(cosine);
    if constexpr (Specular) {
      // R = 2 (N.L) N - L, so R.V needs no vector of its own.
      const double mirrored =
          2.0 * cosine * glm::dot(normal, view) - glm::dot(to_light, view) * inverse_distance;
      if (mirrored > 0.0) {
        const double highlight = portable_power(std::min(mirrored, 1.0), shininess);
        sum.specular += light.color * static_cast<float>(highlight);
      }
    }
  }
  return sum;
}

template <bool Normals, bool Colors, bool Specular>
glm::vec3 shade_hit(const ShadingScene& input, const Ray& ray, const Hit& hit) {
  const Triangle& triangle = input.triangles->triangles[hit.triangle];
  const Material& material = material_of(*input.scene, triangle);
  const glm::dvec3 corner(triangle.v0);
  const glm::dvec3 edge1 = glm::dvec3(triangle.v1) - corner;
  const glm::dvec3 edge2 = glm::dvec3(triangle.v2) - corner;
  const glm::dvec3 view = -glm::dvec3(ray.direction);

  // The geometric normal on the viewer's side.
  glm::dvec3 normal = glm::cross(edge1, edge2);
  if (glm::dot(normal, view) < 0.0) normal = -normal;
  if constexpr (Normals) {
    const auto smooth = interpolate<glm::dvec3>(input.triangles->normals[hit.triangle], hit);
    if (glm::dot(smooth, smooth) > 0.0) {
      normal = glm::dot(smooth, normal) < 0.0 ? -smooth : smooth;
    }
  }
  const double squared_length = glm::dot(normal, normal);
  normal = squared_length > 0.0 ? normal * (1.0 / std::sqrt(squared_length)) : view;

  // From barycentrics: exact to the triangle's size, however far the eye is away.
  const glm::dvec3 point =
      corner + edge1 * static_cast<double>(hit.u) + edge2 * static_cast<double>(hit.v);
  const double shininess = std::max(0.0, static_cast<double>(material.shininess));
  const Reflected light = reflect_lights<Specular>(*input.scene, point, normal, view, shininess);

  glm::vec3 diffuse = material.diffuse;
  if constexpr (Colors) {
    diffuse *= interpolate<glm::vec3>(input.triangles->colors[hit.triangle], hit);
  }
  glm::vec3 color = material.emission + kAmbientLight * material.ambient + diffuse * light.diffuse;
  if constexpr (Specular) color += material.specular * light.specular;
  return color;
}

template <bool Normals, bool Colors, bool Specular>
void shade(const ShadingScene& input, std::span<const Ray> rays, std::span<const Hit> hits,
           std::span<glm::vec3> colors) {
  const glm::vec3 background = input.scene->background;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    colors[i] = hits[i].found() ? shade_hit<Normals, Colors, Specular>(input, rays[i], hits[i])
                                : background;
  }
}

}  // namespace

ShadingNeeds shading_needs(const scene::Scene& scene, const scene::TriangleList& triangles) {
  const auto shines = [](const Material& m) { return m.specular != glm::vec3(0.0F); };
  const bool lit = !scene.lights.empty();
  return {.normals = lit && !triangles.normals.empty(),
          .colors = lit && !triangles.colors.empty(),
          .specular = lit && std::any_of(scene.materials.begin(), scene.materials.end(), shines)};
}

ShadeFunction choose_shading(const ShadingNeeds& needs) {
  static constexpr std::array<ShadeFunction, 8> kVariants = {
      shade<false, false, false>, shade<false, false, true>, shade<false, true, false>,
      shade<false, true, true>,   shade<true, false, false>, shade<true, false, true>,
      shade<true, true, false>,   shade<true, true, true>};
  return kVariants[(needs.normals ? 4U : 0U) + (needs.colors ? 2U : 0U) +
                   (needs.specular ? 1U : 0U)];
}

}  // namespace encore::renderer
