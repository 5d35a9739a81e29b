#pragma once

#include "accel/settings.h"
#include "scene/ray_settings.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace encore::test {

enum class SoakDevice { cpu, gpu, raster };
std::string_view to_string(SoakDevice device);

/// What is drawn for a few frames before something else is: one cell of the product of everything
/// that a user can choose.
struct Leg {
  std::string scene;
  accel::StructureKind structure = accel::StructureKind::bvh_median;
  accel::Policy policy = accel::Policy::rebuild;
  SoakDevice device = SoakDevice::cpu;
  accel::IntersectionMode mode = accel::IntersectionMode::precise;
  std::size_t rays = 0;  ///< place in soak_rays()
  accel::MemoryMode memory = accel::MemoryMode::pool;
};
/// "toys, bvh-median, refit, cpu, precise, none".
std::string describe(const Leg& leg);

/// The thesis' rays; shadows and bounces; four samples a pixel.
const std::vector<scene::RaySettings>& soak_rays();

/// The sample scenes that move, and the one that has a use for every kind of ray.
std::vector<std::string> soak_scenes();

/// The whole product, each cell once, in an order that follows from the seed: all structures but
/// brute force, all policies, modes and rays on the tracing devices; on the rasteriser, which has
/// no use for those, the rays alone. Memory modes alternate.
std::vector<Leg> all_legs(bool with_opengl, std::uint64_t seed);

}  // namespace encore::test
