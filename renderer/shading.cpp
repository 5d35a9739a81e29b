#include "renderer/shading.h"

#include "renderer/surface_light.h"
#include "renderer/surface_pair.h"

#include <array>
#include <cstddef>
#include <utility>

namespace encore::renderer {

namespace {

using scene::Hit;
using scene::Ray;

#if defined(__SSE2__)

template <ShadingNeeds kNeeds>
void shade_two(const ShadingScene& input, std::span<const Ray> rays, std::span<const Hit> hits,
               const std::size_t (&at)[2], std::span<glm::vec3> colors) {
  const SurfacePair<kNeeds> pair(input, rays[at[0]], hits[at[0]], rays[at[1]], hits[at[1]]);
  Reflected light[2];
  for (const scene::Light& one : input.scene->lights) pair.add(one, light);
  for (int i = 0; i < 2; ++i) {
    colors[at[i]] = surface_color<kNeeds>(input, pair.surface(i), hits[at[i]], light[i]);
  }
}

template <ShadingNeeds kNeeds>
void shade(const ShadingScene& input, std::span<const Ray> rays, std::span<const Hit> hits,
           std::span<glm::vec3> colors) {
  const glm::vec3 background = input.scene->background;
  std::size_t waiting[2];
  std::size_t count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) {
      colors[i] = background;
      continue;
    }
    waiting[count++] = i;
    if (count < 2) continue;
    shade_two<kNeeds>(input, rays, hits, waiting, colors);
    count = 0;
  }
  if (count == 0) return;
  waiting[1] = waiting[0];
  shade_two<kNeeds>(input, rays, hits, waiting, colors);
}

#else

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

#endif

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
