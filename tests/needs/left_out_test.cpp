// What a scene does without is named, with why and how many bytes that saves.
#include "scene/left_out.h"

#include "scene/sample_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace encore;

const scene::LeftOut* find(const std::vector<scene::LeftOut>& all, std::string_view feature) {
  const auto at = std::find_if(all.begin(), all.end(),
                               [&](const scene::LeftOut& one) { return one.feature == feature; });
  return at == all.end() ? nullptr : &*at;
}

/// One lit triangle.
struct Case {
  Case() {
    world.materials.resize(1);
    world.lights.resize(1);
    list.triangles.resize(10);
  }
  [[nodiscard]] std::vector<scene::LeftOut> out() const {
    return scene::left_out(world, list, rays);
  }
  scene::Scene world;
  scene::TriangleList list;
  scene::RaySettings rays;
};

TEST(LeftOut, WhatNoMeshHasIsLeftOutAtItsSize) {
  Case one;
  const auto all = one.out();
  ASSERT_NE(find(all, "shading normals"), nullptr);
  EXPECT_EQ(find(all, "shading normals")->bytes, 360U);
  ASSERT_NE(find(all, "vertex colours"), nullptr);
  EXPECT_EQ(find(all, "vertex colours")->bytes, 360U);
  ASSERT_NE(find(all, "texture coordinates"), nullptr);
  EXPECT_EQ(find(all, "texture coordinates")->bytes, 240U);
  EXPECT_EQ(find(all, "lights"), nullptr);
  one.list.normals.resize(10);
  EXPECT_EQ(find(one.out(), "shading normals"), nullptr);
}

TEST(LeftOut, WithoutALightNothingIsShaded) {
  Case one;
  one.list.normals.resize(10);
  one.list.colors.resize(10);
  one.world.lights.clear();
  const auto all = one.out();
  for (const char* feature : {"lights", "shading normals", "vertex colours", "shadow rays"}) {
    EXPECT_NE(find(all, feature), nullptr) << feature;
  }
}

TEST(LeftOut, SaysWhetherRaysAreSwitchedOffOrOfNoUse) {
  Case one;
  EXPECT_EQ(find(one.out(), "shadow rays")->reason, "switched off");
  EXPECT_EQ(find(one.out(), "shadow rays")->bytes, std::nullopt);
  EXPECT_EQ(find(one.out(), "reflected rays")->reason, "no material mirrors or is glass");
  one.world.materials[0].reflectivity = 0.5F;
  EXPECT_EQ(find(one.out(), "reflected rays")->reason, "switched off");
  one.rays.reflections = true;
  EXPECT_EQ(find(one.out(), "reflected rays"), nullptr);
  one.rays.depth = 0;
  EXPECT_EQ(find(one.out(), "reflected rays")->reason, "the depth is 0");
}

TEST(LeftOut, TexturesCountOnceEach) {
  Case one;
  auto texture = std::make_shared<scene::Texture>();
  texture->texels.resize(100);
  one.world.materials.resize(2);
  one.world.materials[0].diffuse_texture = one.world.materials[1].diffuse_texture = texture;
  one.list.texcoords.resize(10);
  EXPECT_EQ(scene::texture_bytes(one.world), 400U);
  EXPECT_EQ(find(one.out(), "textures"), nullptr);
  one.rays.textures = false;
  const auto all = one.out();
  ASSERT_NE(find(all, "textures"), nullptr);
  EXPECT_EQ(find(all, "textures")->bytes, 400U);
  EXPECT_EQ(find(all, "textures")->reason, "switched off");
}

TEST(LeftOut, NothingIsLeftOutWhereEverythingIsUsed) {
  Case one;
  scene::Material& material = one.world.materials[0];
  material.specular = glm::vec3(1.0F);
  material.opacity = 0.5F;
  auto texture = std::make_shared<scene::Texture>();
  texture->texels.resize(1);
  material.diffuse_texture = texture;
  one.list.normals.resize(10);
  one.list.colors.resize(10);
  one.list.texcoords.resize(10);
  one.rays = scene::every_ray();
  EXPECT_TRUE(one.out().empty());
}

}  // namespace
