// What drawing a scene takes: each feature is needed exactly if the scene has it, it was asked for,
// and what it builds on is there.
#include "scene/needs.h"

#include "scene/basic_shapes.h"
#include "scene/checker_texture.h"
#include "support.h"

namespace encore::scene::test {
namespace {

RaySettings everything() {
  RaySettings rays;
  EXPECT_EQ(apply_ray_setting(rays, "rays", "all"), "");
  rays.samples = 4;
  return rays;
}

/// A sphere with everything: light, normals, colours, texture, highlight, mirror and glass.
Scene whole() {
  Scene scene;
  Model sphere = sphere_model(6, 4);
  sphere.mesh.colors.assign(sphere.mesh.positions.size(), glm::vec3(0.5F));
  Instance instance;
  instance.model = std::make_shared<const Model>(std::move(sphere));
  scene.instances = {instance};
  scene.materials.resize(1);
  Material& m = scene.materials[0];
  m.specular = glm::vec3(0.5F);
  m.reflectivity = 0.25F;
  m.opacity = 0.5F;
  m.diffuse_texture =
      std::make_shared<const Texture>(checker_texture({glm::vec3(1.0F), glm::vec3(0.0F)}, 2));
  scene.lights.resize(1);
  return scene;
}

Needs needs(const Scene& scene, const RaySettings& rays) {
  return needs_of(scene, triangles_at(scene), rays);
}

TEST(Needs, ASceneWithEverythingNeedsEverythingThatIsAskedFor) {
  const Needs all = needs(whole(), everything());
  EXPECT_EQ(all, (Needs{true, true, true, true, true, true, true, true, true}));
  EXPECT_TRUE(all.paths());
}

TEST(Needs, NothingIsNeededOfAnEmptyScene) {
  EXPECT_EQ(needs(Scene(), RaySettings{}), Needs{});
  RaySettings rays = everything();
  rays.samples = 1;
  EXPECT_EQ(needs(Scene(), rays), Needs{});
}

TEST(Needs, TheDefaultRaysTakeNoPaths) {
  const Needs plain = needs(whole(), RaySettings{});
  EXPECT_FALSE(plain.paths());
  EXPECT_TRUE(plain.lights && plain.normals && plain.colors && plain.textures && plain.highlights);
}

TEST(Needs, EachKindOfRayIsNeededOnlyIfItIsWanted) {
  Needs expected = needs(whole(), everything());
  for (const auto& [word, flag] : {std::pair{&RaySettings::shadows, &Needs::shadows},
                                   std::pair{&RaySettings::reflections, &Needs::reflections},
                                   std::pair{&RaySettings::refractions, &Needs::refractions},
                                   std::pair{&RaySettings::textures, &Needs::textures}}) {
    RaySettings rays = everything();
    rays.*word = false;
    Needs without = expected;
    without.*flag = false;
    EXPECT_EQ(needs(whole(), rays), without);
  }
  RaySettings rays = everything();
  rays.samples = 1;
  expected.samples = false;
  EXPECT_EQ(needs(whole(), rays), expected);
}

TEST(Needs, WithoutADepthNothingBounces) {
  RaySettings rays = everything();
  rays.depth = 0;
  const Needs n = needs(whole(), rays);
  EXPECT_FALSE(n.reflections);
  EXPECT_FALSE(n.refractions);
  EXPECT_TRUE(n.shadows);
}

TEST(Needs, WithoutALightOnlyBouncesAndTheirNormalsRemain) {
  Scene scene = whole();
  scene.lights.clear();
  Needs expected;
  expected.normals = expected.reflections = expected.refractions = expected.samples = true;
  EXPECT_EQ(needs(scene, everything()), expected);
  EXPECT_EQ(needs(scene, RaySettings{}), Needs{});
}

TEST(Needs, GlassMirrorsToo) {
  Scene scene = whole();
  scene.materials[0].reflectivity = 0.0F;
  EXPECT_TRUE(needs(scene, everything()).reflections);
  scene.materials[0].opacity = 1.0F;
  EXPECT_FALSE(needs(scene, everything()).reflections);
  EXPECT_FALSE(needs(scene, everything()).refractions);
  scene.materials[0].reflectivity = 0.1F;
  EXPECT_TRUE(needs(scene, everything()).reflections);
  EXPECT_FALSE(needs(scene, everything()).refractions);
}

TEST(Needs, WhatNoMeshOrMaterialHasIsNotNeeded) {
  Scene scene = whole();
  scene.materials[0].specular = glm::vec3(0.0F);
  scene.materials[0].diffuse_texture = nullptr;
  scene.instances[0].model = std::make_shared<const Model>(square_model());
  scene.mark_changed();
  const Needs n = needs(scene, everything());
  EXPECT_FALSE(n.normals || n.colors || n.textures || n.highlights);
  EXPECT_TRUE(n.lights && n.shadows && n.reflections);
}

}  // namespace
}  // namespace encore::scene::test
