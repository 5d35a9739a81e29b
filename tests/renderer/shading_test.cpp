#include "renderer/shading.h"

#include "tests/renderer/test_scenes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace {

using namespace encore;
using renderer::kAmbientLight;
using renderer::test::TestScene;

renderer::ShadingNeeds needs_of(const TestScene& setup) {
  return renderer::shading_needs(scene::needs_of(setup.scene, setup.list, {}));
}

/// The colour of the ray from `eye` towards `target`.
glm::vec3 color_seen(TestScene& setup, const glm::vec3& eye, const glm::vec3& target) {
  setup.structure.build(setup.list.triangles);
  const std::vector<scene::Ray> rays = {
      {.origin = eye,
       .direction = glm::vec3(glm::normalize(glm::dvec3(target) - glm::dvec3(eye)))}};
  std::vector<scene::Hit> hits(1);
  std::vector<glm::vec3> colors(1);
  setup.structure.intersect(rays, hits);
  const auto shade = renderer::choose_shading(needs_of(setup));
  shade({&setup.scene, &setup.list}, rays, hits, colors);
  return colors[0];
}

void expect_near(const glm::vec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
  EXPECT_NEAR(a.r, b.r, tolerance);
  EXPECT_NEAR(a.g, b.g, tolerance);
  EXPECT_NEAR(a.b, b.b, tolerance);
}

/// A square in the plane z = 0 with a full Phong material, and one light at (3, 0, 4).
TestScene lit_square() {
  TestScene setup;
  setup.scene.background = {0.1F, 0.2F, 0.3F};
  setup.scene.materials.resize(1);
  scene::Material& m = setup.scene.materials[0];
  m.diffuse = {0.6F, 0.4F, 0.2F};
  m.specular = {0.3F, 0.5F, 0.7F};
  m.ambient = {0.1F, 0.2F, 0.3F};
  m.emission = {0.01F, 0.02F, 0.03F};
  m.shininess = 3.0F;
  setup.scene.lights = {{.position = {3.0F, 0.0F, 4.0F}, .color = {1.0F, 0.5F, 0.25F}}};
  renderer::test::add_square(setup.list, 10.0F, 0.0F);
  return setup;
}

/// Phong's formula for that square at the origin: N.L = 0.8, R.V as given.
glm::dvec3 expected(const scene::Material& m, const glm::vec3& light, double cosine,
                    double mirrored) {
  return glm::dvec3(m.emission) + double(kAmbientLight) * glm::dvec3(m.ambient) +
         glm::dvec3(light) * (glm::dvec3(m.diffuse) * cosine +
                              glm::dvec3(m.specular) * std::pow(mirrored, double(m.shininess)));
}

TEST(Shading, AFacingTriangleHasTheExactPhongValue) {
  TestScene setup = lit_square();
  const auto& m = setup.scene.materials[0];
  const auto& light = setup.scene.lights[0].color;
  // Seen head-on: L = (0.6, 0, 0.8), V = N, so R.V = N.L = 0.8.
  expect_near(color_seen(setup, {0, 0, 5}, {0, 0, 0}), expected(m, light, 0.8, 0.8));
  // Seen from the mirror direction R = (-0.6, 0, 0.8): the full highlight.
  expect_near(color_seen(setup, {-6, 0, 8}, {0, 0, 0}), expected(m, light, 0.8, 1.0));
  // Seen from the light's side so that R.V = 0.28.
  expect_near(color_seen(setup, {6, 0, 8}, {0, 0, 0}), expected(m, light, 0.8, 0.28));
}

TEST(Shading, SeveralLightsAddUp) {
  TestScene setup = lit_square();
  const glm::vec3 one = color_seen(setup, {0, 0, 5}, {0, 0, 0});
  setup.scene.lights.push_back(setup.scene.lights[0]);
  const glm::vec3 two = color_seen(setup, {0, 0, 5}, {0, 0, 0});
  setup.scene.lights.clear();
  const glm::vec3 none = color_seen(setup, {0, 0, 5}, {0, 0, 0});
  expect_near(two - none, glm::dvec3(2.0F * (one - none)));
  const auto& m = setup.scene.materials[0];
  expect_near(none, glm::dvec3(m.emission) + double(kAmbientLight) * glm::dvec3(m.ambient));
}

TEST(Shading, ALightBehindTheSurfaceAddsNothing) {
  TestScene setup = lit_square();
  setup.scene.lights[0].position = {0.0F, 0.0F, -4.0F};
  const auto& m = setup.scene.materials[0];
  expect_near(color_seen(setup, {0, 0, 5}, {0, 0, 0}),
              glm::dvec3(m.emission) + double(kAmbientLight) * glm::dvec3(m.ambient));
}

TEST(Shading, SurfacesAreTwoSided) {
  TestScene setup = lit_square();
  const glm::vec3 front = color_seen(setup, {0, 0, 5}, {0, 0, 0});
  // Turn the winding round: nothing may change.
  for (scene::Triangle& t : setup.list.triangles) std::swap(t.v1, t.v2);
  EXPECT_EQ(color_seen(setup, {0, 0, 5}, {0, 0, 0}), front);
  // From behind, with the light mirrored along, it looks the same.
  setup.scene.lights[0].position = {3.0F, 0.0F, -4.0F};
  EXPECT_EQ(color_seen(setup, {0, 0, -5}, {0, 0, 0}), front);
}

TEST(Shading, InterpolatedNormalsRule) {
  TestScene setup = lit_square();
  // Two equal normals of other lengths: leaning so that N = L exactly.
  const glm::vec3 n{0.6F, 0.0F, 0.8F};
  setup.list.normals.assign(2, {n, 5.0F * n, 0.5F * n});
  const auto& m = setup.scene.materials[0];
  // R = L, V = (0, 0, 1): R.V = 0.8.
  expect_near(color_seen(setup, {0, 0, 5}, {0, 0, 0}),
              expected(m, setup.scene.lights[0].color, 1.0, 0.8));
  // Normals that point away from the viewer's side are turned round.
  setup.list.normals.assign(2, {-n, -n, -n});
  expect_near(color_seen(setup, {0, 0, 5}, {0, 0, 0}),
              expected(m, setup.scene.lights[0].color, 1.0, 0.8));
  // Zero normals (an instance without any) leave the flat one.
  setup.list.normals.assign(2, {glm::vec3(0), glm::vec3(0), glm::vec3(0)});
  expect_near(color_seen(setup, {0, 0, 5}, {0, 0, 0}),
              expected(m, setup.scene.lights[0].color, 0.8, 0.8));
}

TEST(Shading, VertexColoursMultiplyTheDiffuseColourOnly) {
  TestScene setup = lit_square();
  const auto& m = setup.scene.materials[0];
  const auto& light = setup.scene.lights[0].color;
  const glm::vec3 red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};
  setup.list.colors.assign(2, {red, green, blue});
  // The point at the middle of the edge from vertex 0 to vertex 2 of triangle 0 is the origin: half
  // red, half blue for this triangle, which wins the tie by its lower index.
  const glm::dvec3 with_white = expected(m, light, 0.8, 0.8);
  const glm::dvec3 diffuse = glm::dvec3(light) * glm::dvec3(m.diffuse) * 0.8;
  expect_near(color_seen(setup, {0, 0, 5}, {0, 0, 0}),
              with_white - diffuse + diffuse * glm::dvec3(0.5, 0.0, 0.5));
}

TEST(Shading, TexturesMultiplyTheDiffuseColourWhereTheSurfaceWearsOne) {
  TestScene setup = lit_square();
  const glm::vec3 bare = color_seen(setup, {0, 0, 5}, {0, 0, 0});
  auto texture = std::make_shared<scene::Texture>();
  texture->width = texture->height = 1;
  texture->texels = {0xFF00FF00U};  // green
  setup.list.texcoords.resize(2);
  EXPECT_EQ(color_seen(setup, {0, 0, 5}, {0, 0, 0}), bare) << "no material has it yet";
  setup.scene.materials[0].diffuse_texture = texture;
  EXPECT_TRUE(needs_of(setup).textures);
  const auto& m = setup.scene.materials[0];
  const auto& light = setup.scene.lights[0].color;
  const glm::dvec3 red_blue = glm::dvec3(light) * glm::dvec3(m.diffuse) * 0.8 * glm::dvec3(1, 0, 1);
  expect_near(color_seen(setup, {0, 0, 5}, {0, 0, 0}), glm::dvec3(bare) - red_blue);
  setup.list.colors.assign(2, {glm::vec3(0.5F), glm::vec3(0.5F), glm::vec3(0.5F)});
  const glm::dvec3 half_green =
      glm::dvec3(light) * glm::dvec3(m.diffuse) * 0.8 * glm::dvec3(0, 0.5, 0);
  expect_near(color_seen(setup, {0, 0, 5}, {0, 0, 0}), glm::dvec3(bare) - red_blue - half_green);
}

TEST(Shading, AMissShowsTheBackground) {
  TestScene setup = lit_square();
  EXPECT_EQ(color_seen(setup, {0, 0, 5}, {0, 0, 9}), setup.scene.background);
}

TEST(Shading, WhatTheSceneDoesNotUseIsLeftOut) {
  TestScene setup = lit_square();
  auto needs = needs_of(setup);
  EXPECT_FALSE(needs.normals);
  EXPECT_FALSE(needs.colors);
  EXPECT_TRUE(needs.specular);
  setup.scene.lights.clear();
  EXPECT_FALSE(needs_of(setup).specular);
  setup.scene.lights.resize(1);
  setup.scene.materials[0].specular = glm::vec3(0);
  EXPECT_FALSE(needs_of(setup).specular);
  setup.list.normals.resize(2);
  setup.list.colors.resize(2);
  needs = needs_of(setup);
  EXPECT_TRUE(needs.normals);
  EXPECT_TRUE(needs.colors);
  EXPECT_FALSE(needs.textures);
}

TEST(Shading, SizeOfTheSceneDoesNotMatter) {
  TestScene usual = lit_square();
  const glm::vec3 color = color_seen(usual, {0, 0, 5}, {0, 0, 0});
  for (const float scale : {1e-20F, 1e18F}) {
    TestScene setup = lit_square();
    for (scene::Triangle& t : setup.list.triangles) {
      t.v0 *= scale;
      t.v1 *= scale;
      t.v2 *= scale;
    }
    setup.scene.lights[0].position *= scale;
    expect_near(color_seen(setup, {0, 0, 5 * scale}, {0, 0, 0}), glm::dvec3(color));
  }
}

TEST(Shading, NothingOddGivesNaN) {
  TestScene setup = lit_square();
  setup.scene.lights[0].position = {0.0F, 0.0F, 0.0F};  // at the very point that is lit
  setup.scene.materials[0].shininess = -1.0F;
  setup.list.triangles[0].material = 77;  // there is no such material
  const glm::vec3 color = color_seen(setup, {0, 0, 5}, {0, 0, 0});
  const scene::Material missing;
  expect_near(color, double(kAmbientLight) * glm::dvec3(missing.ambient));
}

}  // namespace
