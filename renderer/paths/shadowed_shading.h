#pragma once

#include "accel/acceleration_structure.h"
#include "renderer/paths/ray_clock.h"
#include "renderer/paths/scatter.h"
#include "renderer/shading.h"
#include "renderer/surface_light.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace encore::renderer {

/// Rays of one batch at most: the pixels of one of the CPU tracer's tiles.
inline constexpr std::size_t kBatchRays = 256;

/// What shading with shadows keeps of a batch while the lights are gone through.
struct ShadowSpace {
  std::array<LitSurface, kBatchRays> surfaces;
  std::array<Reflected, kBatchRays> light;
  std::array<scene::Ray, kBatchRays> rays;
  std::array<std::uint8_t, kBatchRays> blocked{};
  std::array<std::uint32_t, kBatchRays> asked_by{};  ///< whose ray this is
};

/// One batch to be shaded: what its rays of kind `kind` have hit, or not.
struct ShadedBatch {
  std::span<const scene::Ray> rays;
  std::span<const scene::Hit> hits;
  std::span<const SurfacePoint> points;  ///< looked at only where there is a hit
  scene::RayKind kind = scene::RayKind::camera;
};

/// As ShadeFunction (shading.h), except that a light adds nothing where shadow_ray() gives no ray
/// or something is in its way: for each light one batch of shadow rays, any-hit. Where no light is
/// hidden the colours are those of ShadeFunction, bit for bit. The time that shadow rays take is
/// charged to them, what was done before to `kind`.
using ShadowedShadeFunction = void (*)(const ShadingScene& input,
                                       const accel::AccelerationStructure& structure,
                                       const ShadedBatch& batch, ShadowSpace& space,
                                       RayClock& clock, std::span<glm::vec3> colors);

ShadowedShadeFunction choose_shadowed_shading(const ShadingNeeds& needs);

}  // namespace encore::renderer
