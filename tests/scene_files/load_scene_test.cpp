#include "scene/sample_scenes.h"
#include "support.h"

namespace encore::scene::test {
namespace {

TEST(LoadScene, TakesASampleSceneByName) {
  const Scene scene = load_scene(std::string(kDefaultSceneName));
  EXPECT_EQ(triangles_at(scene).triangles.size(), 11141U);
}

TEST(LoadScene, TakesFilesByTheirExtension) {
  const TemporaryFolder folder;
  folder.write("m.obj", kTriangleObj);
  const fs::path toml = folder.write("a.toml", "[[model]]\nfile = \"m.obj\"\n");
  const fs::path upper = folder.write("b.TOML", "[[model]]\nfile = \"m.obj\"\n");
  const fs::path text = folder.write("c.txt", "MODEL m.obj 0 0 0 1 0 0 1 0\n");
  for (const fs::path& path : {toml, upper, text, folder.path() / "m.obj"}) {
    const Scene scene = load_scene(path.string());
    EXPECT_EQ(triangles_at(scene).triangles.size(), 1U) << path;
    EXPECT_EQ(scene.source, path.string());
  }
}

TEST(LoadScene, FindsModelsBesideASceneInTheWorkingFolder) {
  const TemporaryFolder folder;
  folder.write("m.obj", kTriangleObj);
  folder.write("a.toml", "[[model]]\nfile = \"m.obj\"\n");
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  EXPECT_EQ(load_scene("a.toml").instances.size(), 1U);
  fs::current_path(before);
}

TEST(LoadScene, ABareModelIsPlacedAsTheThesisDid) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("ein Dreieck – 三角.obj", kTriangleObj);
  const Scene scene = load_scene(path.string());
  const Bounds b = triangles_at(scene).bounds();
  EXPECT_TRUE(near(b.min, {-13.5F, -6.75F, 0.0F}));
  EXPECT_TRUE(near(b.max, {13.5F, 6.75F, 0.0F}));
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].position, scene.camera.eye);
}

TEST(LoadScene, ModelsOfNoSizeAndNoTrianglesArePlacedToo) {
  EXPECT_TRUE(triangles_at(place_model(Model{})).triangles.empty());
  Model point;
  point.mesh.positions.assign(3, glm::vec3(5.0F));
  point.mesh.triangles = {{0, 1, 2}};
  const TriangleList list = triangles_at(place_model(point));
  ASSERT_EQ(list.triangles.size(), 1U);
  EXPECT_EQ(list.triangles[0].v0, glm::vec3(0.0F));
  // As large as floats go, and as small as a float can scale up.
  for (const float size : {3e38F, 1e-37F}) {
    Model model;
    model.mesh.positions = {{-size, 0, 0}, {size, 0, 0}, {0, size, 0}};
    model.mesh.triangles = {{0, 1, 2}};
    const Bounds b = triangles_at(place_model(model)).bounds();
    EXPECT_NEAR(b.size().x, 27.0F, 1e-4F);
  }
}

TEST(LoadScene, AnUnknownNameIsAnErrorWithSuggestionAndHint) {
  EXPECT_EQ(error_of([] { load_scene("toyz"); }),
            "toyz: there is no such file or sample scene; did you mean 'toys'? (the sample scenes: "
            "encore scenes)");
  EXPECT_EQ(error_of([] { load_scene("some/where/elephant.obj"); }),
            "some/where/elephant.obj: there is no such file or sample scene (the sample scenes: "
            "encore scenes)");
}

TEST(LoadScene, AFolderIsAnErrorThatSaysSo) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(error_of([&] { load_scene(folder.path().string()); }), "is a folder"));
}

TEST(LoadScene, AHugeTextIsRefused) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("huge.toml", std::string((16U << 20U) + 100, '#'));
  EXPECT_TRUE(contains(error_of([&] { load_scene(path.string()); }), "larger than 16 MiB"));
}

TEST(LoadScene, TheSearchPathServesSceneFilesToo) {
  const TemporaryFolder folder;
  folder.write("m.obj", kTriangleObj);
  folder.write("a.toml", "[[model]]\nfile = \"m.obj\"\n");
  EXPECT_EQ(load_scene("a.toml", {folder.path()}).instances.size(), 1U);
  EXPECT_EQ(load_scene("m.obj", {folder.path()}).instances.size(), 1U);
}

}  // namespace
}  // namespace encore::scene::test
