// What a Whitted ray tracer makes of the illumination models of MTL files.
#include "scene/obj_reader.h"
#include "scene/obj_reader_mtl.h"
#include "tests/readers/reader_test.h"

namespace encore::scene {
namespace {

Material material(const std::string& statements) {
  MaterialsByName materials;
  Warnings warnings;
  read_mtl("newmtl a\n" + statements, "m.mtl", materials, warnings);
  EXPECT_TRUE(warnings.messages.empty());
  return materials.at("a");
}

TEST(MtlReader, MirrorsMirrorTheMeanOfKs) {
  for (const char* illum : {"3", "5", "8"}) {
    const Material m = material("Ks 0.9 0.6 0.3\nillum " + std::string(illum) + "\n");
    EXPECT_NEAR(m.reflectivity, 0.6F, 1e-6F) << illum;
    EXPECT_EQ(m.opacity, 1.0F) << illum;
  }
  for (const char* illum : {"0", "1", "2"}) {
    EXPECT_EQ(material("Ks 1\nillum " + std::string(illum) + "\n").reflectivity, 0.0F) << illum;
  }
  EXPECT_EQ(material("Ks 4\nillum 3\n").reflectivity, 1.0F);
}

TEST(MtlReader, GlassIsClearUnlessItSaysHowOpaqueItIs) {
  for (const char* illum : {"4", "6", "7", "9"}) {
    const std::string glass = "Ks 0.3\nNi 1.33\nillum " + std::string(illum) + "\n";
    for (const char* opaque : {"", "d 1\n", "Tr 0\n", "Tf 0.1 0.1 0.1\n", "d 1\nTf 1 1 1\n"}) {
      const Material m = material(glass + opaque);
      EXPECT_EQ(m.opacity, 0.0F) << illum << ' ' << opaque;
      EXPECT_EQ(m.reflectivity, 0.0F) << illum << ' ' << opaque;
      EXPECT_EQ(m.index_of_refraction, 1.33F);
      EXPECT_EQ(m.specular, glm::vec3(0.3F));
    }
    EXPECT_EQ(material(glass + "d 0.25\n").opacity, 0.25F);
    EXPECT_EQ(material(glass + "Tr 0.25\n").opacity, 0.75F);
    EXPECT_EQ(material(glass + "Tf 0 0 0\n").opacity, 1.0F);
  }
}

TEST(MtlReader, WhatIsNoGlassKeepsItsOpacity) {
  for (const char* illum : {"0", "1", "2", "3", "5", "8"}) {
    const std::string plain = "Tf 1 1 1\nNi 1.5\nillum " + std::string(illum) + "\n";
    EXPECT_EQ(material(plain).opacity, 1.0F) << illum;
    EXPECT_EQ(material(plain + "d 0.5\n").opacity, 0.5F) << illum;
  }
}

TEST(MtlReader, TheCornellBoxesMirrorAndRefract) {
  const auto folder = real_models();
  if (folder.empty()) GTEST_SKIP() << "no real models: set ENCORE_MODELS to their folder";
  const auto named = [&folder](const std::string& file, const std::string& name) {
    for (const Material& m : read_model(folder / "extra/cornell" / file).materials) {
      if (m.name == name) return m;
    }
    ADD_FAILURE() << file << " has no " << name;
    return Material();
  };
  EXPECT_NEAR(named("CornellBox-Mirror.obj", "tallBox").reflectivity, 0.95F, 1e-6F);
  EXPECT_NEAR(named("CornellBox-Sphere.obj", "leftSphere").reflectivity, 0.95F, 1e-6F);
  EXPECT_EQ(named("CornellBox-Sphere.obj", "rightSphere").opacity, 0.0F);
  EXPECT_EQ(named("CornellBox-Sphere.obj", "rightSphere").index_of_refraction, 2.5F);
  const Material water = named("CornellBox-Water.obj", "water");
  EXPECT_EQ(water.opacity, 0.0F);
  EXPECT_EQ(water.index_of_refraction, 1.33F);
  EXPECT_EQ(water.reflectivity, 0.0F);
  EXPECT_EQ(named("CornellBox-Water.obj", "floor").opacity, 1.0F);
}

}  // namespace
}  // namespace encore::scene
