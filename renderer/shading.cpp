#include "renderer/shading.h"

#include "renderer/surface_light.h"

#include <array>
#include <cstddef>
#include <utility>

namespace encore::renderer {

namespace {

using scene::Hit;
using scene::Ray;

template <ShadingNeeds kNeeds>
glm::vec3 shade_hit(const ShadingScene& input, const Ray& ray, const Hit& hit) {
  const LitSurface surface = lit_surface<kNeeds>(input, ray, hit);
  Reflected light;
  for (const scene::Light& one : input.scene->lights) add_light<kNeeds>(surface, one, light);
  return surface_color<kNeeds>(input, surface, hit, light);
}

template <ShadingNeeds kNeeds>
void shade(const ShadingScene& input, std::span<const Ray> rays, std::span<const Hit> hits,
           std::span<glm::vec3> colors) {
  const glm::vec3 background = input.scene->background;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    colors[i] = hits[i].found() ? shade_hit<kNeeds>(input, rays[i], hits[i]) : background;
  }
}

template <std::size_t... kVariants>
constexpr std::array<ShadeFunction, kShadingVariants> variants(
    std::index_sequence<kVariants...> /*all*/) {
  return {shade<variant_needs(kVariants)>...};
}

}  // namespace

ShadingNeeds shading_needs(const scene::Needs& needs) {
  return {.normals = needs.lights && needs.normals,
          .colors = needs.colors,
          .textures = needs.textures,
          .specular = needs.highlights};
}

ShadeFunction choose_shading(const ShadingNeeds& needs) {
  static constexpr auto kVariants = variants(std::make_index_sequence<kShadingVariants>());
  return kVariants[variant_of(needs)];
}

}  // namespace encore::renderer
