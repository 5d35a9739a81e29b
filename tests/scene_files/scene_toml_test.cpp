#include "support.h"

#include <algorithm>
#include <map>

namespace encore::scene::test {
namespace {

TEST(SceneToml, AnEmptyFileIsAnEmptySceneWithTheDefaults) {
  const Scene scene = parse("");
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.source, "scene.toml");
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(scene.warnings.messages.empty());
  EXPECT_EQ(scene.camera.eye, glm::vec3(0.0F, 0.0F, 25.0F));
  EXPECT_EQ(scene.camera.vertical_fov_degrees, 90.0F);
  // One white light at the camera.
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].position, scene.camera.eye);
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1.0F));
}

TEST(SceneToml, ReadsTheWholeScenesKeys) {
  const Scene scene = parse(R"(
name = "hall"
background = [0.1, 0.2, 0.3]
[camera]
eye = [1, 2, 3]
target = [4, 5, 6.5]
up = [0, 0, 1]
fov = 45
[[light]]
position = [7, 8, 9]
color = [0.5, 1, 2]
[[light]]
position = [0, 0, 0]
color = 0.25
)");
  EXPECT_EQ(scene.name, "hall");
  EXPECT_EQ(scene.background, glm::vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(scene.camera.eye, glm::vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(scene.camera.target, glm::vec3(4.0F, 5.0F, 6.5F));
  EXPECT_EQ(scene.camera.up, glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(scene.camera.vertical_fov_degrees, 45.0F);
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.lights[0].position, glm::vec3(7.0F, 8.0F, 9.0F));
  EXPECT_EQ(scene.lights[0].color, glm::vec3(0.5F, 1.0F, 2.0F));
  EXPECT_EQ(scene.lights[1].color, glm::vec3(0.25F));
  EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
}

TEST(SceneToml, AnOrthographicHeightTakesThePlaceOfTheFieldOfView) {
  EXPECT_FALSE(parse("[camera]\nfov = 45\n").camera.orthographic());
  const Scene scene = parse("[camera]\neye = [1, 2, 3]\northographic_height = 12.5\n");
  EXPECT_TRUE(scene.camera.orthographic());
  EXPECT_EQ(scene.camera.orthographic_height, 12.5F);
  EXPECT_EQ(scene.camera.eye, glm::vec3(1.0F, 2.0F, 3.0F));
  EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
  EXPECT_GT(parse("[camera]\northographic_height = 1e-37\n").camera.orthographic_height, 0.0F);
}

TEST(SceneToml, ReadsEveryKeyOfAMaterialByNameAndInPlace) {
  const std::string keys = R"(diffuse = [0.1, 0.2, 0.3]
specular = 0.4
ambient = [0, 0, 1]
emission = 3
shininess = 77
opacity = 0.5
index_of_refraction = 1.3
reflectivity = 0.25
)";
  const Scene by_name = parse(
      "[[model]]\ngenerator = \"box\"\nmaterial = \"a\"\n"
      "[[material]]\nname = \"a\"\n" +
      keys);
  const Scene in_place = parse("[[model]]\ngenerator = \"box\"\n[model.material]\n" + keys);
  for (const Scene* scene : {&by_name, &in_place}) {
    const Material& m = scene->materials.at(scene->instances.at(0).first_material);
    EXPECT_EQ(m.diffuse, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(m.specular, glm::vec3(0.4F));
    EXPECT_EQ(m.ambient, glm::vec3(0.0F, 0.0F, 1.0F));
    EXPECT_EQ(m.emission, glm::vec3(3.0F));
    EXPECT_EQ(m.shininess, 77.0F);
    EXPECT_EQ(m.opacity, 0.5F);
    EXPECT_EQ(m.index_of_refraction, 1.3F);
    EXPECT_EQ(m.reflectivity, 0.25F);
    EXPECT_TRUE(scene->warnings.messages.empty()) << joined(scene->warnings);
  }
  EXPECT_EQ(by_name.materials[0].name, "a");
}

TEST(SceneToml, OneMaterialCoversAllOfAModelsOwn) {
  const TemporaryFolder folder;
  folder.write("two.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
  folder.write("two.obj",
               "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
               "usemtl a\nf 1 2 3\nusemtl b\nf 2 4 3\n");
  const auto colors = [&](const std::string& material) {
    const Scene scene = parse("[[model]]\nfile = \"two.obj\"\n" + material, folder.path());
    std::vector<glm::vec3> result;
    for (const Triangle& t : triangles_at(scene).triangles) {
      result.push_back(scene.materials.at(t.material).diffuse);
    }
    return result;
  };
  EXPECT_EQ(colors(""), (std::vector<glm::vec3>{{1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(colors("material = { diffuse = 0.5 }\n"),
            (std::vector<glm::vec3>{glm::vec3(0.5F), glm::vec3(0.5F)}));
}

TEST(SceneToml, FitComesBeforeScaleRotateAndTranslate) {
  const TemporaryFolder folder;
  folder.write("t.obj", kTriangleObj);  // from (0,0,0) to (2,1,0)
  const Scene scene = parse(R"([[model]]
file = "t.obj"
name = "part"
fit = 10
scale = [1, 2, 1]
rotate = { axis = [0, 0, 2], degrees = 90 }
translate = [100, 0, 0]
)",
                            folder.path());
  EXPECT_EQ(scene.instances.at(0).name, "part");
  // Fitted to 10 x 5, scaled to 10 x 10, turned and moved.
  const Bounds b = triangles_at(scene).bounds();
  EXPECT_TRUE(near(b.min, {95.0F, -5.0F, 0.0F}, 1e-4F));
  EXPECT_TRUE(near(b.max, {105.0F, 5.0F, 0.0F}, 1e-4F));
  EXPECT_TRUE(near(triangles_at(scene).triangles[0].v1, {105.0F, 5.0F, 0.0F}, 1e-4F));
}

TEST(SceneToml, ScaleMayBeOneNumberAndTheAxisIsYIfLeftOut) {
  const Scene scene = parse(
      "[[model]]\ngenerator = \"box\"\nscale = 4\n"
      "[[model]]\ngenerator = \"box\"\nscale = [2, 1, 1]\n"
      "rotate = { degrees = 90 }\n");
  EXPECT_EQ(triangles_at(scene).bounds().size(), glm::vec3(4.0F));
  Scene second;
  second.instances = {scene.instances[1]};
  EXPECT_TRUE(near(triangles_at(second).bounds().size(), {1.0F, 1.0F, 2.0F}));
}

TEST(SceneToml, KeysMakeARigidMotion) {
  const Scene scene = parse(R"([[model]]
generator = "box"
translate = [1, 0, 0]
[[model.key]]
time = 0.5
[[model.key]]
time = 2
translate = [0, 3, 0]
scale = 2
rotate = { axis = [0, 0, 1], degrees = 90 }
)");
  EXPECT_EQ(scene.duration_s(), 2.0);
  EXPECT_TRUE(scene.animated());
  EXPECT_TRUE(near(triangles_at(scene, 0.25).bounds().center(), {1.0F, 0.0F, 0.0F}));
  // The key's pose is applied after the model's own: (1,0,0) is doubled, turned, moved.
  const auto& motion = std::get<RigidMotion>(scene.instances[0].motion);
  EXPECT_EQ(motion.keys.size(), 2U);
  EXPECT_TRUE(near(triangles_at(scene, 1.9999999).bounds().center(), {0.0F, 5.0F, 0.0F}, 1e-4F));
  // And it loops.
  EXPECT_TRUE(near(triangles_at(scene, 2.25).bounds().center(), {1.0F, 0.0F, 0.0F}));
}

TEST(SceneToml, ReadsEveryKeyOfADeformer) {
  const Scene scene = parse(R"([[model]]
generator = "sphere"
[model.deform]
kind = "twist"
axis = [1, 0, 0]
amplitude = 2
wavelength = 3
frequency = 0.25
)");
  const auto& d = std::get<Deformer>(scene.instances.at(0).motion);
  EXPECT_EQ(d.kind, Deformer::Kind::twist);
  EXPECT_EQ(d.axis, glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(d.amplitude, 2.0F);
  EXPECT_EQ(d.wavelength, 3.0F);
  EXPECT_EQ(d.frequency_hz, 0.25F);
  EXPECT_EQ(scene.duration_s(), 4.0);
  EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
}

TEST(SceneToml, FramesOfAFolderComeInTheOrderOfTheirNumbers) {
  const TemporaryFolder folder;
  for (const int i : {1, 2, 9, 10, 11}) {
    const std::string text = "v 0 0 0\nv " + std::to_string(i) + " 0 0\nv 0 1 0\nf 1 2 3\n";
    folder.write("walk/frame" + std::to_string(i) + ".obj", text);
  }
  folder.write("walk/readme.txt", "not a model");
  const Scene scene =
      parse("[[model]]\n[model.frames]\nfolder = \"walk\"\nfps = 4\n", folder.path());
  EXPECT_EQ(scene.duration_s(), 1.25);
  std::vector<float> widths;
  for (int i = 0; i < 5; ++i) widths.push_back(triangles_at(scene, i / 4.0).bounds().size().x);
  EXPECT_EQ(widths, (std::vector<float>{1, 2, 9, 10, 11}));
}

TEST(SceneToml, FramesMayBeNamedOneByOneAndAreReadOnce) {
  const TemporaryFolder folder;
  folder.write("a.obj", kTriangleObj);
  folder.write("b.obj", kSquareObj);
  const Scene scene =
      parse("[[model]]\nfit = 4\nframes = { files = [\"b.obj\", \"a.obj\", \"b.obj\"], fps = 1 }\n",
            folder.path());
  const auto& frames = std::get<FrameSequence>(scene.instances.at(0).motion).frames;
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0], frames[2]);
  // All at the first frame's scale: the square of side 1 becomes 4, the triangle of width 2 then 8.
  EXPECT_TRUE(near(triangles_at(scene, 0.0).bounds().size(), {4.0F, 4.0F, 0.0F}));
  EXPECT_TRUE(near(triangles_at(scene, 1.0).bounds().size(), {8.0F, 4.0F, 0.0F}));
}

TEST(SceneToml, GeneratorsBringSampleScenes) {
  const Scene scene = parse("[[model]]\ngenerator = \"toys\"\nfit = 10\ntranslate = [50, 0, 0]\n");
  const TriangleList list = triangles_at(scene);
  EXPECT_EQ(list.triangles.size(), 11141U);
  const Bounds b = list.bounds();
  EXPECT_NEAR(std::max({b.size().x, b.size().y, b.size().z}), 10.0, 1e-3);
  EXPECT_TRUE(near(b.center(), {50.0F, 0.0F, 0.0F}, 1e-3F));
  for (const Triangle& t : list.triangles) ASSERT_LT(t.material, scene.materials.size());
}

TEST(SceneToml, AGeneratedSceneLooksAsOnItsOwn) {
  const Scene alone = load_scene("toys");
  const Scene placed = parse("[[model]]\ngenerator = \"toys\"\n");
  for (const double time : {0.0, 0.7}) {
    const TriangleList a = triangles_at(alone, time);
    const TriangleList b = triangles_at(placed, time);
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    for (std::size_t i = 0; i < a.triangles.size(); ++i) {
      ASSERT_TRUE(near(a.triangles[i].v0, b.triangles[i].v0, 1e-4F));
      ASSERT_EQ(alone.materials.at(a.triangles[i].material).diffuse,
                placed.materials.at(b.triangles[i].material).diffuse);
    }
  }
}

TEST(SceneToml, SettingsAreKeptWithTheirPlace) {
  const Scene scene = parse(R"([settings]
structure = "kd-sah"
threads = 3
grid.density = 1.5
fast = true
[settings.kd]
leaf_triangles = 4
)");
  std::map<std::string, std::pair<std::string, std::string>> settings;
  for (const Preference& p : scene.preferences) settings[p.key] = {p.value, p.place};
  EXPECT_EQ(settings.size(), 5U);
  EXPECT_EQ(settings["structure"],
            std::pair(std::string("kd-sah"), std::string("scene.toml:2:13")));
  EXPECT_EQ(settings["threads"].first, "3");
  EXPECT_EQ(settings["grid.density"].first, "1.5");
  EXPECT_EQ(settings["fast"].first, "true");
  EXPECT_EQ(settings["kd.leaf_triangles"],
            std::pair(std::string("4"), std::string("scene.toml:7:18")));
  EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
}

TEST(SceneToml, FilesAreFoundInTheFolderThenInTheSearchPath) {
  const TemporaryFolder here;
  const TemporaryFolder elsewhere;
  here.write("a.obj", kTriangleObj);
  elsewhere.write("a.obj", kSquareObj);
  elsewhere.write("sub/b.obj", kSquareObj);
  elsewhere.write("c.obj", kSquareObj);
  const auto count = [&](const std::string& file) {
    return triangles_at(parse_scene_toml("[[model]]\nfile = \"" + file + "\"\n", "s.toml",
                                         here.path(), {elsewhere.path()}))
        .triangles.size();
  };
  EXPECT_EQ(count("a.obj"), 1U);             // the folder's own comes first
  EXPECT_EQ(count("sub/b.obj"), 2U);         // then the path below an entry
  EXPECT_EQ(count("models/old/c.obj"), 2U);  // then the bare name
  EXPECT_EQ(count((elsewhere.path() / "c.obj").string()), 2U);
}

TEST(SceneToml, NamesMayHoldAnyUtf8) {
  const TemporaryFolder folder;
  folder.write("Häschen/模型 α.obj", kTriangleObj);
  const Scene scene =
      parse("[[model]]\nfile = \"Häschen/模型 α.obj\"\nname = \"ünï\"\n", folder.path());
  EXPECT_EQ(triangles_at(scene).triangles.size(), 1U);
  EXPECT_EQ(scene.instances[0].name, "ünï");
}

TEST(SceneToml, AModelNamedTwiceIsReadOnce) {
  const TemporaryFolder folder;
  folder.write("a.obj", kTriangleObj);
  const Scene scene =
      parse("[[model]]\nfile = \"a.obj\"\n[[model]]\nfile = \"a.obj\"\nscale = 2\n", folder.path());
  EXPECT_EQ(scene.instances[0].model, scene.instances[1].model);
}

}  // namespace
}  // namespace encore::scene::test
