// What a scene does without is named, with why and how many bytes that saves.
#include "scene/left_out.h"

#include "scene/sample_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

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
  // The device's has a table of sRGB values and four words a texture besides its texels.
  EXPECT_EQ(find(all, "textures")->bytes, 400U + 1024U + 16U);
  EXPECT_EQ(find(all, "textures")->host_bytes, 0U);
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

TEST(LeftOut, TheHostKeepsWhatTheListHasThoughNothingAsksForIt) {
  Case one;
  EXPECT_EQ(find(one.out(), "shading normals")->host_bytes, 360U);
  EXPECT_EQ(find(one.out(), "highlights")->host_bytes, std::nullopt);
  one.list.normals.resize(10);
  one.world.lights.clear();
  EXPECT_EQ(find(one.out(), "shading normals")->host_bytes, 0U);
  EXPECT_EQ(find(one.out(), "shading normals")->bytes, 360U);
}

TEST(LeftOut, SaysWhereCoordinatesAreOfNoUse) {
  Case one;
  EXPECT_EQ(find(one.out(), "texture coordinates")->reason, "no material has a texture");
  auto model = std::make_shared<scene::Model>();
  model->mesh.texcoords.resize(3);
  one.world.instances.resize(1);
  one.world.instances[0].model = model;
  EXPECT_EQ(find(one.out(), "texture coordinates")->reason,
            "no material has a texture, though a mesh has coordinates");
}

TEST(LeftOut, MirrorsAndGlassShareABuffer) {
  Case one;
  EXPECT_EQ(find(one.out(), "reflected rays")->bytes, 64U);  // one material and one more
  EXPECT_EQ(find(one.out(), "refracted rays")->bytes, std::nullopt);
  one.world.materials[0].opacity = 0.5F;
  one.rays.refractions = true;
  EXPECT_EQ(find(one.out(), "reflected rays")->bytes, std::nullopt);
}

/// A scene of one part that moves by itself.
struct MovingCase : Case {
  explicit MovingCase(scene::Motion motion) {
    world.instances.resize(1);
    world.instances[0].motion = std::move(motion);
  }
  [[nodiscard]] std::vector<scene::LeftOut> run(const scene::RunParts& parts) const {
    return scene::left_out(world, list, rays, parts);
  }
};

scene::RigidMotion two_keys() {
  scene::RigidMotion motion;
  motion.keys.resize(2);
  motion.keys[1].time_s = 1.0F;
  return motion;
}

TEST(LeftOutOfARun, WithoutADeviceItsCopyIsLeftOutAndNoPartOfIt) {
  const MovingCase one{std::monostate{}};
  const auto cpu = one.run({});
  ASSERT_NE(find(cpu, "device copies"), nullptr);
  // Ten triangles, a material and the one for those that do not exist, a light.
  EXPECT_EQ(find(cpu, "device copies")->bytes, 10U * 48 + 2U * 48 + 32U);
  EXPECT_EQ(find(cpu, "shading normals")->bytes, std::nullopt);
  EXPECT_EQ(find(cpu, "shading normals")->host_bytes, 360U);
  const auto gpu = one.run({.cpu = false, .gpu = true});
  EXPECT_EQ(find(gpu, "device copies"), nullptr);
  EXPECT_EQ(find(gpu, "shading normals")->bytes, 360U);
  EXPECT_EQ(find(gpu, "structures"), nullptr);
  EXPECT_NE(find(one.run({.cpu = false, .raster = true}), "structures"), nullptr);
}

TEST(LeftOutOfARun, WhatStandsStillHasNoPhasesOfMotion) {
  const MovingCase still{std::monostate{}};
  ASSERT_NE(find(still.run({}), "animation"), nullptr);
  EXPECT_TRUE(find(still.run({}), "animation")->reason.starts_with("nothing moves"));
  const MovingCase moving{two_keys()};
  EXPECT_EQ(find(moving.run({}), "animation"), nullptr);
  EXPECT_NE(find(moving.run({}), "new triangles"), nullptr);
  const auto rested = moving.run({.moves = false});
  ASSERT_NE(find(rested, "animation"), nullptr);
  EXPECT_TRUE(find(rested, "animation")->reason.starts_with("time stands still"));
  EXPECT_EQ(find(rested, "new triangles"), nullptr);
}

TEST(LeftOutOfARun, CountingIsThereOnlyForHeatMaps) {
  const MovingCase one{std::monostate{}};
  EXPECT_NE(find(one.run({}), "counting"), nullptr);
  EXPECT_EQ(find(one.run({.counting = true}), "counting"), nullptr);
}

TEST(RunNeeds, TheKindOfMotionIsThatOfWhatMovesMost) {
  using scene::MotionKind;
  EXPECT_EQ(scene::motion_of(MovingCase(std::monostate{}).world), MotionKind::none);
  EXPECT_EQ(scene::motion_of(MovingCase(two_keys()).world), MotionKind::rigid);
  EXPECT_EQ(scene::motion_of(*scene::make_sample_scene("wave")), MotionKind::deforms);
  scene::Scene mixed = *scene::make_sample_scene("metaballs");
  mixed.instances.emplace_back().motion = two_keys();
  EXPECT_EQ(scene::motion_of(mixed), MotionKind::frames);
}

}  // namespace
