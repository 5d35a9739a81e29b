#include "accel/stability_cases.h"

#include "accel/stability_shapes.h"
#include "accel/test_rays.h"
#include "scene/basic_shapes.h"
#include "scene/scene.h"
#include "scene/triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace encore::accel {

namespace {

using stability::Random;
using stability::Triangles;
using Rays = StabilityCase::Rays;

Triangles scaled_ball(std::size_t count, float factor) {
  return stability::ball(count, glm::vec3(0.25F, -0.5F, 0.125F) * factor, factor);
}
Triangles moved_ball(std::size_t count, float distance) {
  return stability::ball(count, glm::vec3(distance, -0.7F * distance, 0.9F * distance), 1.0F);
}

Triangles two_to_24(std::size_t count, std::uint64_t seed) {
  return stability::soup(count, seed);
}

/// A ball that a deformer with an endless amplitude blows up, and one that stands still: what comes
/// out of scene::update_triangles.
Triangles not_finite(std::size_t count, std::uint64_t /*seed*/) {
  scene::Scene scene;
  const int side = std::max(3, static_cast<int>(std::sqrt(static_cast<double>(count) / 4.0)));
  const auto model = std::make_shared<const scene::Model>(scene::sphere_model(side, side));
  scene.instances.push_back({.name = "still", .model = model, .motion = {}});
  for (const float amplitude :
       {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1e4F}) {
    scene.instances.push_back(
        {.name = "blown up",
         .model = model,
         .motion = scene::Deformer{.kind = scene::Deformer::Kind::wave, .amplitude = amplitude}});
  }
  scene::TriangleList list;
  scene::update_triangles(scene, 0.3, list);
  return std::move(list.triangles);
}

/// So many triangles by StabilitySize.
constexpr std::size_t kMillion = 1'000'000;

#define ENCORE_USUAL \
  { 400, 8'000, 200'000 }
#define ENCORE_MILLION \
  { 400, 50'000, kMillion }

const std::array kCases{
    StabilityCase{"scale-1e-18", "a closed ball of radius 1e-18", ENCORE_USUAL,
                  [](std::size_t n, std::uint64_t) { return scaled_ball(n, 1e-18F); }},
    StabilityCase{"scale-1e18", "a closed ball of radius 1e18", ENCORE_USUAL,
                  [](std::size_t n, std::uint64_t) { return scaled_ball(n, 1e18F); }},
    StabilityCase{"offset-1e3", "a ball 10^3 times its size from the origin", ENCORE_USUAL,
                  [](std::size_t n, std::uint64_t) { return moved_ball(n, 1e3F); }},
    StabilityCase{"offset-1e5", "a ball 10^5 times its size from the origin", ENCORE_USUAL,
                  [](std::size_t n, std::uint64_t) { return moved_ball(n, 1e5F); }},
    StabilityCase{"offset-1e7",
                  "a ball 10^7 times its size from the origin, which leaves it flat "
                  "steps and few distinct vertices",
                  ENCORE_USUAL, [](std::size_t n, std::uint64_t) { return moved_ball(n, 1e7F); }},
    StabilityCase{"needles",
                  "triangles 10^8 times as long as wide",
                  {300, 4'000, 200'000},
                  stability::needles},
    StabilityCase{"corner-to-corner",
                  "needles whose boxes all touch every cell of a grid",
                  {300, 4'000, kMillion},
                  stability::corner_to_corner},
    StabilityCase{"spanning",
                  "every triangle as large as the scene",
                  {300, 4'000, 200'000},
                  stability::spanning},
    StabilityCase{"without-area", "points and lines among ordinary triangles", ENCORE_USUAL,
                  stability::without_area},
    StabilityCase{"repeated",
                  "one triangle again and again",
                  {300, 10'000, kMillion},
                  [](std::size_t n, std::uint64_t) { return stability::repeated(n); }},
    StabilityCase{"same-centroid",
                  "all triangles around one centroid",
                  {300, 4'000, kMillion},
                  stability::same_centroid},
    StabilityCase{"coplanar", "all triangles in one plane", ENCORE_MILLION, stability::coplanar},
    StabilityCase{"diagonal", "small triangles along one diagonal", ENCORE_MILLION,
                  stability::diagonal},
    StabilityCase{"one-a-level",
                  "each split at the median takes away a single triangle",
                  {300, 4'000, kMillion},
                  [](std::size_t n, std::uint64_t) { return stability::one_a_level(n); }},
    StabilityCase{"hall-1e6", "a dense ball in a hall 10^6 times as large", ENCORE_USUAL,
                  [](std::size_t n, std::uint64_t) { return stability::ball_in_hall(n); }},
    StabilityCase{"in-planes",
                  "rays along axes and in the structure's own planes, through a "
                  "lattice of powers of two",
                  ENCORE_USUAL, [](std::size_t n, std::uint64_t) { return stability::lattice(n); },
                  Rays::in_planes},
    StabilityCase{"denormal-directions",
                  "directions of length 2^-120 to 2^-135",
                  {300, 4'000, 100'000},
                  stability::soup,
                  Rays::denormal},
    StabilityCase{"enormous-directions", "directions of length 2^100 to 2^127", ENCORE_USUAL,
                  stability::soup, Rays::enormous},
    StabilityCase{"not-finite",
                  "what is left of meshes whose deformers make NaN and infinity",
                  {600, 20'000, 200'000},
                  not_finite},
    StabilityCase{"exploding",
                  "a mesh that grows 10^30 times in 1,000 frames, refitted",
                  {200, 2'000, 20'000},
                  stability::soup,
                  Rays::all,
                  1000},
    StabilityCase{"empty", "no triangle", {0, 0, 0}, stability::soup},
    StabilityCase{"one", "one triangle", {1, 1, 1}, stability::soup},
    StabilityCase{
        "two-to-24", "2^24 triangles with --full", {1 << 10, 1 << 16, 1 << 24}, two_to_24},
};

#undef ENCORE_USUAL
#undef ENCORE_MILLION

void stretch(Ray& ray, int low, int high, Random& random) {
  const int exponent = low + static_cast<int>(random.unit() * static_cast<float>(high - low + 1));
  for (int axis = 0; axis < 3; ++axis) {
    ray.direction[axis] = std::ldexp(ray.direction[axis], exponent);
  }
  if (ray.direction == glm::vec3(0.0F)) ray.direction.x = std::numeric_limits<float>::min();
}

std::vector<Ray> rays_through_nothing() {
  return {{{0, 0, 5}, 0.0F, {0, 0, -1}},
          {{0, 0, 0}, 0.0F, {1, 0, 0}, 2.5F},
          {{1e30F, 0, 0}, 0.0F, {-1, 1e-30F, -0.0F}}};
}

}  // namespace

std::span<const StabilityCase> stability_cases() {
  return kCases;
}

const StabilityCase* find_stability_case(std::string_view name) {
  const auto found = std::find_if(kCases.begin(), kCases.end(),
                                  [&](const StabilityCase& c) { return c.name == name; });
  return found == kCases.end() ? nullptr : &*found;
}

std::vector<Triangle> stability_triangles(const StabilityCase& which, StabilitySize size,
                                          std::uint64_t seed) {
  return which.make(which.triangles[static_cast<int>(size)], seed);
}

std::vector<Ray> stability_rays(const StabilityCase& which, std::size_t each, std::uint64_t seed,
                                std::span<const Triangle> triangles,
                                const AccelerationStructure& structure) {
  if (triangles.empty()) return rays_through_nothing();
  std::vector<Ray> rays;
  Random random(seed);
  for (const RayKind kind : all_ray_kinds()) {
    const bool in_planes = kind == RayKind::plane || kind == RayKind::axis;
    if (which.rays == Rays::in_planes && !in_planes) continue;
    const bool stretched = which.rays == Rays::denormal || which.rays == Rays::enormous;
    if (stretched && kind == RayKind::limited) continue;  // its limits would have to shrink, too
    // From far away the reference's filter in single precision throws nothing out; with denormal
    // numbers it does not either, and processors take many times as long over them.
    const bool dear = kind == RayKind::far || which.rays == Rays::denormal;
    const std::size_t count = dear ? (each + 9) / 10 : each;
    std::vector<Ray> some = test_rays(kind, count, seed, triangles, structure);
    for (Ray& ray : some) {
      if (which.rays == Rays::denormal) stretch(ray, -135, -120, random);
      if (which.rays == Rays::enormous) stretch(ray, 100, 127, random);
    }
    rays.insert(rays.end(), some.begin(), some.end());
  }
  // Only rays that the contract allows: at the ends of the floats an aim may overflow.
  std::erase_if(rays, [](const Ray& ray) {
    return !scene::is_finite(ray.origin) || !scene::is_finite(ray.direction) ||
           ray.direction == glm::vec3(0.0F);
  });
  return rays;
}

void frame_of(std::span<const Triangle> start, int frame, std::uint64_t seed,
              std::span<Triangle> out) {
  Random random(seed);
  const float distance =
      std::ldexp(1.0F + 0.1F * static_cast<float>(frame % 10), frame / 10) - 1.0F;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const glm::vec3 offset = random.point(1.0F) * distance;
    out[i] = start[i];
    out[i].v0 += offset;
    out[i].v1 += offset;
    out[i].v2 += offset;
  }
}

}  // namespace encore::accel
