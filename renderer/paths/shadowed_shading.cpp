#include "renderer/paths/shadowed_shading.h"

#include <array>
#include <cstdint>
#include <utility>

namespace encore::renderer {

namespace {

using scene::RayKind;

/// The pixels of a whole tile of 16 x 16, square by square of 8 x 8 and of 4 x 4 within: rays that
/// follow each other then run side by side, however many of them are left out.
constexpr std::array<std::uint8_t, kBatchRays> kSquareBySquare = [] {
  static_assert(kBatchRays == 256);
  std::array<std::uint8_t, kBatchRays> order{};
  for (unsigned i = 0; i < kBatchRays; ++i) {
    const unsigned x = (i >> 6U & 1U) * 8 + (i >> 4U & 1U) * 4 + (i & 3U);
    const unsigned y = (i >> 7U) * 8 + (i >> 5U & 1U) * 4 + (i >> 2U & 3U);
    order[i] = static_cast<std::uint8_t>(y * 16 + x);
  }
  return order;
}();

/// Makes the batch's shadow rays towards one light; returns their number.
std::size_t aim_at(const scene::Light& light, const ShadedBatch& batch, ShadowSpace& space) {
  const bool whole = batch.rays.size() == kBatchRays;
  std::size_t count = 0;
  for (std::size_t k = 0; k < batch.rays.size(); ++k) {
    const std::size_t i = whole ? kSquareBySquare[k] : k;
    if (!batch.hits[i].found()) continue;
    if (const auto ray = shadow_ray(batch.points[i], light.position)) {
      space.rays[count] = *ray;
      space.asked_by[count++] = static_cast<std::uint32_t>(i);
    }
  }
  return count;
}

template <ShadingNeeds kNeeds>
void shade(const ShadingScene& input, const accel::AccelerationStructure& structure,
           const ShadedBatch& batch, ShadowSpace& space, RayClock& clock,
           std::span<glm::vec3> colors) {
  for (std::size_t i = 0; i < batch.rays.size(); ++i) {
    if (!batch.hits[i].found()) continue;
    space.surfaces[i] = lit_surface<kNeeds>(input, batch.rays[i], batch.hits[i]);
    space.light[i] = {};
  }
  for (const scene::Light& light : input.scene->lights) {
    clock.charge(batch.kind);
    const std::size_t count = aim_at(light, batch, space);
    const auto blocked = std::span(space.blocked).first(count);
    if (count > 0) {
      structure.occluded_tile(std::span<const scene::Ray>(space.rays).first(count), count, blocked);
    }
    clock.count(RayKind::shadow, count);
    clock.charge(RayKind::shadow);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t i = space.asked_by[k];
      if (blocked[k] == 0) add_light<kNeeds>(space.surfaces[i], light, space.light[i]);
    }
  }
  for (std::size_t i = 0; i < batch.rays.size(); ++i) {
    colors[i] = batch.hits[i].found()
                    ? surface_color<kNeeds>(input, space.surfaces[i], batch.hits[i], space.light[i])
                    : input.scene->background;
  }
}

template <std::size_t... kVariants>
constexpr std::array<ShadowedShadeFunction, kShadingVariants> variants(
    std::index_sequence<kVariants...> /*all*/) {
  return {shade<variant_needs(kVariants)>...};
}

}  // namespace

ShadowedShadeFunction choose_shadowed_shading(const ShadingNeeds& needs) {
  static constexpr auto kVariants = variants(std::make_index_sequence<kShadingVariants>());
  return kVariants[variant_of(needs)];
}

}  // namespace encore::renderer
