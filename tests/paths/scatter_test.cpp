#include "renderer/paths/scatter.h"

#include "tests/paths/paths_support.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace encore;
using renderer::Scattering;
using renderer::SurfacePoint;
using renderer::test::glass;

constexpr renderer::Bounces kBoth{.reflections = true, .refractions = true};

/// A ray that comes down at this angle upon the triangle z = 0, met at the origin.
scene::Ray falling(double degrees) {
  const double angle = degrees * M_PI / 180.0;
  return {.origin = {0.0F, 0.0F, 1.0F},
          .direction = {static_cast<float>(std::sin(angle)), 0.0F,
                        static_cast<float>(-std::cos(angle))}};
}

SurfacePoint facing_up() {
  return {.point = glm::dvec3(0.0),
          .geometric = {0.0, 0.0, 1.0},
          .normal = {0.0, 0.0, 1.0},
          .reach = 1.0,
          .entering = true};
}

Scattering scattered(const scene::Ray& ray, const SurfacePoint& at, const scene::Material& material,
                     const renderer::Bounces& wanted = kBoth) {
  return renderer::scatter(ray, at, material, wanted, false, glm::vec3(1.0F));
}

TEST(Fresnel, HasTheKnownValues) {
  EXPECT_NEAR(renderer::fresnel(1.0, 1.0 / 1.5), 0.04, 1e-12);
  EXPECT_NEAR(renderer::fresnel(1.0, 1.5), 0.04, 1e-12);
  EXPECT_NEAR(renderer::fresnel(1.0, 1.0 / 1.33), std::pow(0.33 / 2.33, 2.0), 1e-12);
  EXPECT_EQ(renderer::fresnel(0.0, 1.0 / 1.5), 1.0);
  EXPECT_EQ(renderer::fresnel(0.3, 1.0), 0.0);
  // At Brewster's angle only the light polarised across is mirrored: ((1 - n^2) / (1 + n^2))^2 / 2.
  const double brewster = std::cos(std::atan(1.5));
  EXPECT_NEAR(renderer::fresnel(brewster, 1.0 / 1.5), 0.5 * std::pow(1.25 / 3.25, 2.0), 1e-12);
  // Beyond the critical angle, asin(1 / 1.5), everything is mirrored.
  EXPECT_EQ(renderer::fresnel(std::cos(0.7298), 1.5), 1.0);
  EXPECT_LT(renderer::fresnel(std::cos(0.7296), 1.5), 1.0);
}

TEST(Fresnel, IsTheSameFromBothSides) {
  for (double degrees = 1.0; degrees < 90.0; degrees += 1.0) {
    const double outside = std::cos(degrees * M_PI / 180.0);
    const double inside = std::sqrt(1.0 - (1.0 - outside * outside) / (1.5 * 1.5));
    const double share = renderer::fresnel(outside, 1.0 / 1.5);
    EXPECT_NEAR(share, renderer::fresnel(inside, 1.5), 1e-12);
    EXPECT_TRUE(share >= 0.04 - 1e-4 && share <= 1.0);
  }
}

TEST(Scatter, GlassObeysSnellsLawAndLosesNothing) {
  for (double degrees = 0.0; degrees < 89.5; degrees += 3.7) {
    const scene::Ray ray = falling(degrees);
    const Scattering on = scattered(ray, facing_up(), glass(1.5F));
    ASSERT_TRUE(on.reflection && on.refraction);
    EXPECT_EQ(on.own, 0.0F);
    const glm::dvec3 down(on.refraction->ray.direction);
    EXPECT_NEAR(down.x, ray.direction.x / 1.5, 1e-7);
    EXPECT_NEAR(glm::length(down), 1.0, 1e-7);
    EXPECT_LT(down.z, 0.0);
    EXPECT_LT(on.refraction->ray.origin.z, 0.0F);
    const glm::dvec3 up(on.reflection->ray.direction);
    EXPECT_NEAR(up.x, ray.direction.x, 1e-7);
    EXPECT_NEAR(up.z, -ray.direction.z, 1e-7);
    EXPECT_GT(on.reflection->ray.origin.z, 0.0F);
    EXPECT_NEAR(on.reflection->weight.r + on.refraction->weight.r, 1.0, 1e-7);
    const double cosine = -static_cast<double>(ray.direction.z);
    EXPECT_NEAR(on.reflection->weight.g, renderer::fresnel(cosine, 1.0 / 1.5), 1e-6);
  }
}

TEST(Scatter, SharesOfLightAddUpToOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  for (int i = 0; i < 2000; ++i) {
    scene::Material material = glass(1.0F + uniform(random));
    material.opacity = uniform(random);
    material.reflectivity = uniform(random);
    SurfacePoint at = facing_up();
    at.entering = i % 2 == 0;
    const Scattering on = scattered(falling(88.0 * uniform(random)), at, material);
    float sum = on.own;
    if (on.reflection) sum += on.reflection->weight.g;
    if (on.refraction) sum += on.refraction->weight.g;
    // What counts less than kLeastWeight is left out.
    EXPECT_NEAR(sum, 1.0F, 2.1F * renderer::kLeastWeight);
  }
}

TEST(Scatter, TotalReflectionIsRefractionsRay) {
  SurfacePoint at = facing_up();
  at.entering = false;  // from inside the glass
  const Scattering on = scattered(falling(50.0), at, glass(1.5F), {.refractions = true});
  ASSERT_TRUE(on.refraction);
  EXPECT_FALSE(on.reflection);
  EXPECT_EQ(on.refraction->weight, glm::vec3(1.0F));
  EXPECT_GT(on.refraction->ray.direction.z, 0.0F);
  EXPECT_GT(on.refraction->ray.origin.z, 0.0F);
  const Scattering both = scattered(falling(50.0), at, glass(1.5F));
  EXPECT_TRUE(both.refraction && !both.reflection);
}

TEST(Scatter, AnIndexOfOneChangesNothing) {
  const scene::Ray ray = falling(63.0);
  for (const float index : {1.0F, 0.0F, -2.0F}) {
    const Scattering on = scattered(ray, facing_up(), glass(index));
    ASSERT_TRUE(on.refraction);
    EXPECT_FALSE(on.reflection);
    EXPECT_LT(glm::length(on.refraction->ray.direction - ray.direction), 1e-7F);
  }
}

TEST(Scatter, WhatIsNotWantedIsTheSurfacesOwn) {
  scene::Material material = glass(1.5F);
  material.opacity = 0.25F;
  material.reflectivity = 0.5F;
  const Scattering none = scattered(falling(20.0), facing_up(), material, {});
  EXPECT_TRUE(none.own == 1.0F && !none.reflection && !none.refraction);
  const Scattering mirrored =
      scattered(falling(20.0), facing_up(), material, {.reflections = true});
  EXPECT_EQ(mirrored.own, 0.5F);
  ASSERT_TRUE(mirrored.reflection && !mirrored.refraction);
  EXPECT_EQ(mirrored.reflection->weight, glm::vec3(0.5F));
  const Scattering seen = scattered(falling(0.0), facing_up(), material, {.refractions = true});
  EXPECT_EQ(seen.own, 0.25F);
  ASSERT_TRUE(seen.refraction && !seen.reflection);
  EXPECT_NEAR(seen.refraction->weight.r, 0.75F * 0.96F, 1e-6F);
  const Scattering limit =
      renderer::scatter(falling(20.0), facing_up(), material, kBoth, true, glm::vec3(1.0F));
  EXPECT_EQ(limit.own, 0.125F);
  EXPECT_TRUE(!limit.reflection && !limit.refraction);
}

TEST(Scatter, MirrorsAreTintedAsTheirHighlights) {
  scene::Material material = renderer::test::mirror();
  material.specular = {0.2F, 0.1F, 0.0F};
  const Scattering on = scattered(falling(20.0), facing_up(), material);
  ASSERT_TRUE(on.reflection);
  EXPECT_LT(glm::length(on.reflection->weight - glm::vec3(2.0F, 1.0F, 0.0F)), 1e-6F);
}

TEST(Scatter, WhatHardlyCountsIsLeftOut) {
  const scene::Material material = renderer::test::mirror();
  const auto at_weight = [&](float weight) {
    return renderer::scatter(falling(20.0), facing_up(), material, kBoth, false, glm::vec3(weight));
  };
  EXPECT_TRUE(at_weight(renderer::kLeastWeight).reflection);
  EXPECT_FALSE(at_weight(0.99F * renderer::kLeastWeight).reflection);
}

TEST(Scatter, NoShadingNormalLeadsThroughTheSurface) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 5000; ++i) {
    SurfacePoint at = facing_up();
    at.normal = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    if (at.normal.z < 0.0) at.normal = -at.normal;
    at.entering = i % 2 == 0;
    scene::Material material = glass(1.5F);
    material.reflectivity = 0.5F;
    const Scattering on = scattered(falling(89.0 * (i % 100) / 100.0), at, material);
    ASSERT_TRUE(on.reflection && on.refraction);
    EXPECT_GT(on.reflection->ray.direction.z, 0.0F);
    EXPECT_EQ(on.refraction->ray.direction.z > 0.0F, on.refraction->ray.origin.z > 0.0F);
    EXPECT_NEAR(glm::length(on.reflection->ray.direction), 1.0F, 1e-6F);
    EXPECT_NEAR(glm::length(on.refraction->ray.direction), 1.0F, 1e-6F);
  }
}

TEST(SurfacePoint, LiesOnTheTriangleWithNormalsTowardsTheViewer) {
  const scene::Triangle triangle = scene::make_triangle({0, 0, 2}, {4, 0, 2}, {0, 4, 2});
  const scene::Hit hit{.t = 1.0F, .triangle = 0, .u = 0.25F, .v = 0.5F};
  const scene::Ray front{.origin = {1, 2, 3}, .direction = {0, 0, -1}};
  const scene::Ray back{.origin = {1, 2, 1}, .direction = {0, 0, 1}};
  const std::array<glm::vec3, 3> smooth{glm::vec3(0, 0, 3), glm::vec3(0, 0, 3), glm::vec3(3, 0, 3)};
  const SurfacePoint seen = renderer::surface_point(front, hit, triangle, nullptr);
  EXPECT_EQ(seen.point, glm::dvec3(1.0, 2.0, 2.0));
  EXPECT_EQ(seen.geometric, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(seen.normal, seen.geometric);
  EXPECT_EQ(seen.reach, 4.0);
  EXPECT_TRUE(seen.entering);
  const SurfacePoint behind = renderer::surface_point(back, hit, triangle, &smooth);
  EXPECT_EQ(behind.geometric, glm::dvec3(0.0, 0.0, -1.0));
  EXPECT_FALSE(behind.entering);
  EXPECT_NEAR(glm::length(behind.normal - -glm::normalize(glm::dvec3(1.5, 0.0, 3.0))), 0.0, 1e-12);
  const scene::Triangle flat = scene::make_triangle({0, 0, 2}, {4, 0, 2}, {8, 0, 2});
  EXPECT_EQ(renderer::surface_point(front, hit, flat, &smooth).normal, glm::dvec3(0.0, 0.0, 1.0));
}

TEST(ShadowRay, EndsJustShortOfTheLight) {
  const auto ray = renderer::shadow_ray(facing_up(), {3.0F, 0.0F, 4.0F});
  ASSERT_TRUE(ray);
  EXPECT_NEAR(glm::length(ray->direction), 1.0F, 1e-6F);
  EXPECT_LT(ray->t_max, 5.0F);
  EXPECT_NEAR(ray->t_max, 5.0F, 1e-4F);
  EXPECT_GT(ray->origin.z, 0.0F);
  EXPECT_FALSE(renderer::shadow_ray(facing_up(), {3.0F, 0.0F, -4.0F}));
  EXPECT_FALSE(renderer::shadow_ray(facing_up(), {0.0F, 0.0F, 0.0F}));
}

}  // namespace
