#include "scene/classic_scene_file.h"
#include "support.h"

#include <map>
#include <string>

namespace encore::scene::test {
namespace {

Scene classic(std::string_view text, const fs::path& folder = {},
              const std::vector<fs::path>& search = {}) {
  return parse_classic_scene(text, "old.txt", folder, search);
}

std::string classic_error(std::string_view text, const fs::path& folder = {}) {
  return error_of([&] { classic(text, folder); });
}

TEST(ClassicScene, ReadsCameraLightsAndBackground) {
  const Scene scene = classic(
      "CAMERA 1 2 3 4 5 6 0 0 1 45\n"
      "BACKGROUND_COLOR 0.4 0.5 .6 1\n"
      "POINT_LIGHT 5 6 7 1 0.5 +0.25\n"
      "LIGHT -1 -2 -3 1 1 1\n");
  EXPECT_EQ(scene.camera.eye, glm::vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(scene.camera.target, glm::vec3(4.0F, 5.0F, 6.0F));
  EXPECT_EQ(scene.camera.up, glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(scene.camera.vertical_fov_degrees, 45.0F);
  EXPECT_EQ(scene.background, glm::vec3(0.4F, 0.5F, 0.6F));
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.lights[0].position, glm::vec3(5.0F, 6.0F, 7.0F));
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1.0F, 0.5F, 0.25F));
  EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
}

TEST(ClassicScene, StarsStartCommentsAnywhere) {
  const Scene scene = classic(
      "\xEF\xBB\xBF* a header *\r\n"
      "*LIGHT 1 1 1 1 1 1\r\n"
      "  \t \r\n"
      "LIGHT 1 2 3 1 1 1 * comment * LIGHT\r\n"
      "*");
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].position, glm::vec3(1.0F, 2.0F, 3.0F));
  EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
}

TEST(ClassicScene, WhatHasNoCounterpartIsAWarningWithItsLine) {
  const Scene scene = classic(
      "CAMERA 0 0 170 0 0 0 0 1 0 45 1.5 0.1 1000\n"
      "BACKGROUND_COLOR 0 0 0 0.5\n"
      "MATERIAL 0 0 0 0 0 0 0 0 0 0 0.8 0.5 0.3\n");
  const std::string all = joined(scene.warnings);
  EXPECT_TRUE(contains(all, "old.txt:1: CAMERA: the aspect ratio is ignored")) << all;
  EXPECT_TRUE(contains(all, "old.txt:1: CAMERA: near and far plane are ignored")) << all;
  EXPECT_TRUE(contains(all, "old.txt:2: BACKGROUND_COLOR: the background's alpha")) << all;
  EXPECT_TRUE(contains(all, "old.txt:3: MATERIAL: transmittance has no counterpart")) << all;
  EXPECT_EQ(scene.warnings.messages.size(), 4U) << all;
}

TEST(ClassicScene, AnUpVectorAlongTheViewIsReplaced) {
  const Scene scene = classic("CAMERA 0 0 170 0 0 0 0 0 1 45\n");
  EXPECT_EQ(scene.camera.up, glm::vec3(0.0F, 1.0F, 0.0F));
  EXPECT_TRUE(contains(joined(scene.warnings), "old.txt:1: CAMERA: up lies along the view"));
  EXPECT_EQ(classic("CAMERA 0 9 0 0 0 0 0 1 0 45\n").camera.up, glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST(ClassicScene, ReadsTheMaterialOfWhatFollows) {
  const Scene scene = classic(
      "SPHERE 0 0 0 1\n"
      "MATERIAL 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 0.25 0.75 1.5 0\n"
      "SPHERE 0 0 0 1\n");
  EXPECT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.instances[0].first_material, 0U);
  const Material& m = scene.materials.at(scene.instances[1].first_material);
  EXPECT_EQ(m.diffuse, glm::vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(m.specular, glm::vec3(0.4F, 0.5F, 0.6F));
  EXPECT_EQ(m.ambient, glm::vec3(0.7F, 0.8F, 0.9F));
  EXPECT_EQ(m.reflectivity, 0.25F);
  EXPECT_EQ(m.opacity, 0.25F);
  EXPECT_EQ(m.index_of_refraction, 1.5F);
  EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
}

TEST(ClassicScene, OddCountsOfMaterialNumbersAreWarnings) {
  const Scene scene = classic(
      "MATERIAL 0.7 0 0 0.7 0 0 0.7 0 0 0 0\n"
      "SPHERE 0 0 0 1\n"
      "MATERIAL 0 2 0 0 0 0 0 0 0 0 0 0 0 0 0\n");
  const std::string all = joined(scene.warnings);
  EXPECT_TRUE(contains(all, "old.txt:1: MATERIAL: 11 numbers instead of 13")) << all;
  EXPECT_TRUE(contains(all, "old.txt:3: MATERIAL: 15 numbers; those after 13 are ignored")) << all;
  EXPECT_TRUE(contains(all, "old.txt:3: MATERIAL: values outside 0 to 1 were clamped")) << all;
  EXPECT_EQ(scene.materials[0].diffuse, glm::vec3(0.7F, 0.0F, 0.0F));
  EXPECT_EQ(scene.materials[0].index_of_refraction, 1.0F);
}

TEST(ClassicScene, SpheresAreTessellated) {
  const Scene scene = classic("SPHERE 1 2 3 4 0.5 0 0 1 0\n");
  const TriangleList list = triangles_at(scene);
  EXPECT_EQ(list.triangles.size(), 3968U);
  EXPECT_TRUE(near(list.bounds().min, {-1.0F, 0.0F, 1.0F}));
  EXPECT_TRUE(near(list.bounds().max, {3.0F, 4.0F, 5.0F}));
}

TEST(ClassicScene, ModelsAreCentredSizedTurnedAndMoved) {
  const TemporaryFolder folder;
  folder.write("m/t.obj", kTriangleObj);
  const Scene scene = classic("MODEL m/t.obj 10 0 0 4 90 0 0 1\n", folder.path());
  const Bounds b = triangles_at(scene).bounds();
  EXPECT_TRUE(near(b.min, {9.0F, -2.0F, 0.0F}));
  EXPECT_TRUE(near(b.max, {11.0F, 2.0F, 0.0F}));
}

TEST(ClassicScene, ModelsAreFoundByBareNameInTheSearchPath) {
  const TemporaryFolder folder;
  const TemporaryFolder models;
  models.write("t.obj", kTriangleObj);
  const Scene scene =
      classic("MODEL models/bwl/t.obj 0 0 0 4 0 0 1 0\n", folder.path(), {models.path()});
  EXPECT_EQ(triangles_at(scene).triangles.size(), 1U);
}

TEST(ClassicScene, DynamicIsAFolderOfFrames) {
  const TemporaryFolder folder;
  for (const int i : {1, 2, 3, 4, 10}) {
    const std::string w = std::to_string(i);
    folder.write("models/T/f" + w + ".obj", "v 0 0 0\nv " + w + " 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  const Scene all = classic("DYNAMIC models/T 1 0 0 0 .5 0 1 0 0\n", folder.path());
  EXPECT_DOUBLE_EQ(all.duration_s(), 0.5);
  EXPECT_FLOAT_EQ(triangles_at(all, 0.4).bounds().size().x, 5.0F);
  const Scene second = classic("DYNAMIC models/T 2 0 0 0 1 0 1 0 0\n", folder.path());
  EXPECT_EQ(std::get<FrameSequence>(second.instances.at(0).motion).frames.size(), 3U);
}

TEST(ClassicScene, ARectLightBecomesALightBelowTheCeiling) {
  const Scene scene = classic(
      "MATERIAL 1 1 1 0 0 0 0 0 0 0 0 0 0\n"
      "RECT_LIGHT 1 0.9 0.8\n"
      "SPHERE 10 0 0 50\n");
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_TRUE(near(scene.lights[0].position, {10.0F, 48.0F, 0.0F}, 1e-3F));
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1.0F, 0.9F, 0.8F));
  EXPECT_TRUE(contains(joined(scene.warnings), "old.txt:2: RECT_LIGHT: area lights have no"));
}

TEST(ClassicScene, WithoutALightThereIsOneAtTheCamera) {
  const Scene scene = classic("CAMERA 0 0 9 0 0 0 0 1 0 45\n");
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].position, glm::vec3(0.0F, 0.0F, 9.0F));
}

TEST(ClassicScene, UnknownCommandsAreWarningsWithTheNearestName) {
  const Scene scene = classic("LIGHT 0 0 0 1 1 1\nMATRIAL 1 1 1\n");
  ASSERT_EQ(scene.warnings.messages.size(), 1U);
  EXPECT_EQ(scene.warnings.messages[0],
            "old.txt:2: unknown command 'MATRIAL' is ignored; did you mean 'MATERIAL'?");
}

TEST(ClassicScene, ManyUnknownCommandsAreSummedUp) {
  std::string text = "LIGHT 0 0 0 1 1 1\n";
  for (int i = 0; i < 5000; ++i) text += "elephant\n";
  const Scene scene = classic(text);
  EXPECT_EQ(scene.warnings.messages.size(), 21U);
  EXPECT_EQ(scene.warnings.messages.back(), "old.txt: 4980 more unknown commands are ignored");
}

TEST(ClassicScene, ATextWithoutAnyCommandIsRefused) {
  EXPECT_TRUE(classic_error("Dear diary,\ntoday\n").starts_with("old.txt: no line is a command"));
  EXPECT_TRUE(classic("").instances.empty());
  EXPECT_TRUE(classic("* nothing *\n").instances.empty());
}

TEST(ClassicScene, ErrorsNameFileLineAndCommand) {
  EXPECT_EQ(classic_error("\nLIGHT 0 0 0 1 1\n"), "old.txt:2: LIGHT: needs 6 numbers, has 5");
  EXPECT_EQ(classic_error("LIGHT 0 0 x 1 1 1\n"), "old.txt:1: LIGHT: 'x' is not a number");
  EXPECT_EQ(classic_error("LIGHT 0 0 1,5 1 1 1\n"), "old.txt:1: LIGHT: '1,5' is not a number");
  EXPECT_EQ(classic_error("LIGHT 0 0 nan 1 1 1\n"),
            "old.txt:1: LIGHT: 'nan' is not a finite number of at most 1e37");
  EXPECT_EQ(classic_error("LIGHT 0 0 1e999 1 1 1\n"),
            "old.txt:1: LIGHT: '1e999' is not a finite number of at most 1e37");
  EXPECT_EQ(classic_error("CAMERA 0 0 9 0 0 0 0 1 0 180\n"),
            "old.txt:1: CAMERA: the field of view must be greater than 0 and less than 180, not "
            "180");
  EXPECT_EQ(classic_error("CAMERA 0 0 0 0 0 0 0 1 0 90\n"),
            "old.txt:1: CAMERA: eye and look-at point must differ");
  EXPECT_EQ(classic_error("SPHERE 0 0 0 0\n"),
            "old.txt:1: SPHERE: radius times scale must be greater than 0");
  EXPECT_EQ(classic_error("MODEL\n"), "old.txt:1: MODEL: needs a file");
  const TemporaryFolder folder;
  folder.write("t.obj", kTriangleObj);
  EXPECT_EQ(classic_error("MODEL t.obj 0 0 0 -1 0 0 1 0\n", folder.path()),
            "old.txt:1: MODEL: the size must be greater than 0, not -1");
  EXPECT_EQ(classic_error("DYNAMIC . 0.5 0 0 0 1 0 1 0 0\n", folder.path()),
            "old.txt:1: DYNAMIC: the frame step must be a whole number from 1 on, not 0.5");
  EXPECT_EQ(classic_error("DYNAMIC . 1 0 0 0 0 0 1 0 0\n", folder.path()),
            "old.txt:1: DYNAMIC: the scale must be greater than 0, not 0");
}

TEST(ClassicScene, AMissingModelNamesItsLineAndThePathsTried) {
  const TemporaryFolder folder;
  const TemporaryFolder search;
  const std::string error = error_of([&] {
    classic("*\nMODEL models/gone.ply 0 0 0 1 0 0 1 0\n", folder.path(), {search.path()});
  });
  EXPECT_TRUE(error.starts_with("old.txt:2: cannot find the model file 'models/gone.ply'"))
      << error;
  EXPECT_TRUE(contains(error, (folder.path() / "models/gone.ply").string())) << error;
  EXPECT_TRUE(contains(error, (search.path() / "gone.ply").string())) << error;
}

TEST(ClassicScene, AllThirteenOfTheOriginalLoadWithTheirTriangles) {
  const fs::path models = real_models();
  if (models.empty()) GTEST_SKIP() << "no real models: set ENCORE_MODELS to their folder";
  // The original's names for the scanned models; its one triangle is not among them.
  const TemporaryFolder links;
  const std::map<std::string, std::string> names = {{"dragon3.ply", "dragon_vrip_res3.ply"},
                                                    {"bunny1.ply", "bun_zipper.ply"},
                                                    {"bunny2.ply", "bun_zipper_res2.ply"},
                                                    {"bunny3.ply", "bun_zipper_res3.ply"}};
  for (const auto& [old_name, name] : names) {
    fs::create_symlink(fs::canonical(models / "thesis" / name), links.path() / old_name);
  }
  links.write("singleTri.ply",
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
              "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  constexpr std::uint64_t kSphere = 3968;
  const std::map<std::string, std::uint64_t> triangles = {
      {"ballSurface.txt", 6 + kSphere},
      {"bunny.txt", 948},
      {"cornell.txt", 10 + 2 * kSphere},
      {"cornell2.txt", 10},
      {"diffuseBunny3Cornell.txt", 10 + 3851},
      {"diffuseDragon3Cornell.txt", 10 + 47794},
      {"emptyCornell.txt", 10},
      {"glassBunnyCornell.txt", 10 + 16301},
      {"reflectanceCornell.txt", 10 + 2 * kSphere},
      {"refractionCornell.txt", 10 + 2 * kSphere},
      {"scene1.txt", 1},
      {"specularCornell.txt", 10 + 2 * kSphere},
      {"sphere.txt", kSphere}};
  const std::vector<fs::path> search = {links.path(), models / "thesis",
                                        models / "thesis" / "encore_cornell"};
  for (const auto& [name, count] : triangles) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene((models / "encore_scenes" / name).string(), search);
    EXPECT_EQ(triangles_at(scene).triangles.size(), count);
    EXPECT_FALSE(scene.lights.empty());
  }
}

TEST(ClassicScene, TheCornellBoxEnclosesItsBunny) {
  const fs::path models = real_models();
  if (models.empty()) GTEST_SKIP() << "no real models: set ENCORE_MODELS to their folder";
  const Scene scene = load_scene((models / "encore_scenes" / "glassBunnyCornell.txt").string(),
                                 {models / "thesis", models / "thesis" / "encore_cornell"});
  const Bounds box = triangles_at(scene).bounds();
  EXPECT_TRUE(near(box.min, glm::vec3(-50.0F), 1e-3F));
  EXPECT_TRUE(near(box.max, glm::vec3(50.0F), 1e-3F));
  EXPECT_TRUE(near(scene.lights.at(0).position, {0.0F, 48.0F, 0.0F}, 1e-3F));
}

}  // namespace
}  // namespace encore::scene::test
