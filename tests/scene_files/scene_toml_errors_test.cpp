#include "support.h"

#include <string>

namespace encore::scene::test {
namespace {

TEST(SceneTomlWarnings, AnUnknownKeyIsNamedWithItsPlaceAndTheNearestName) {
  const Scene scene = parse("name = \"x\"\n[camera]\n  fvo = 60\n");
  ASSERT_EQ(scene.warnings.messages.size(), 1U);
  EXPECT_EQ(scene.warnings.messages[0],
            "scene.toml:3:3: unknown key 'fvo' in [camera] is ignored; did you mean 'fov'?");
}

TEST(SceneTomlWarnings, EveryTableReportsItsUnknownKeys) {
  const Scene scene = parse(R"(lihgt = []
[[light]]
position = [0, 0, 0]
colour = 1
[[material]]
name = "m"
difuse = 0.5
[[model]]
generator = "box"
transalte = [1, 2, 3]
rotate = { axis = [0, 1, 0], degrees = 5, degres = 6 }
material = { shinines = 1 }
[[model.key]]
time = 0
tim = 1
[[model]]
generator = "box"
deform = { kind = "wave", wave_length = 3 }
)");
  const std::string all = joined(scene.warnings);
  EXPECT_EQ(scene.warnings.messages.size(), 8U) << all;
  EXPECT_TRUE(contains(all,
                       "scene.toml:1:1: unknown key 'lihgt' in the scene is ignored; did you "
                       "mean 'light'?"))
      << all;
  EXPECT_TRUE(contains(all,
                       "4:1: unknown key 'colour' in [light] is ignored; did you mean "
                       "'color'?"))
      << all;
  EXPECT_TRUE(contains(all, "7:1: unknown key 'difuse' in [material]")) << all;
  EXPECT_TRUE(contains(all,
                       "10:1: unknown key 'transalte' in [model] is ignored; did you mean "
                       "'translate'?"))
      << all;
  EXPECT_TRUE(contains(all, "11:43: unknown key 'degres' in [model.rotate]")) << all;
  EXPECT_TRUE(contains(all, "12:14: unknown key 'shinines' in [model.material]")) << all;
  EXPECT_TRUE(contains(all, "15:1: unknown key 'tim' in [model.key]")) << all;
  EXPECT_TRUE(contains(all,
                       "18:27: unknown key 'wave_length' in [model.deform] is ignored; did "
                       "you mean 'wavelength'?"))
      << all;
}

TEST(SceneTomlErrors, SyntaxErrorsHaveTheSameForm) {
  const std::string error = error_in("name = \"x\"\n[camera\nfov = 3\n");
  EXPECT_TRUE(error.starts_with("scene.toml:2:")) << error;
  EXPECT_TRUE(error_in("a = 1\na = 2\n").starts_with("scene.toml:2:"));
  EXPECT_TRUE(error_in("a = \"\xff\xfe\"\n").starts_with("scene.toml:1:"));
}

struct Case {
  const char* text;
  const char* error;
};

class WrongType : public ::testing::TestWithParam<Case> {};

TEST_P(WrongType, IsAnErrorWithLineAndColumn) {
  const TemporaryFolder folder;
  folder.write("a.obj", kTriangleObj);
  EXPECT_EQ(error_in(GetParam().text, folder.path()), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Types, WrongType,
    ::testing::Values(
        Case{"name = 3\n", "scene.toml:1:8: 'name' must be a string, not an integer"},
        Case{"camera = 3\n", "scene.toml:1:10: 'camera' must be a table, not an integer"},
        Case{"[camera]\nfov = \"wide\"\n", "scene.toml:2:7: 'fov' must be a number, not a string"},
        Case{"[camera]\neye = 3\n",
             "scene.toml:2:7: 'eye' must be an array of 3 numbers, not an integer"},
        Case{"[camera]\neye = [1, 2]\n",
             "scene.toml:2:7: 'eye' must be an array of 3 numbers, not of 2"},
        Case{"[camera]\neye = [1, 2, true]\n",
             "scene.toml:2:14: 'eye' must be a number, not a boolean"},
        Case{"[light]\nposition = [0, 0, 0]\n",
             "scene.toml:1:1: 'light' must be an array of tables ([[light]]), not a table"},
        Case{"light = [3]\n",
             "scene.toml:1:10: 'light' must be an array of tables ([[light]]), not an integer"},
        Case{"background = \"black\"\n",
             "scene.toml:1:14: 'background' must be a number or an "
             "array of 3 numbers, not a string"},
        Case{"[[model]]\nfile = [1]\n", "scene.toml:2:8: 'file' must be a string, not an array"},
        Case{"[[model]]\nfile = \"a.obj\"\nmaterial = 3\n",
             "scene.toml:3:12: 'material' must be a table, not an integer"},
        Case{"[[model]]\nframes = { files = \"a.obj\" }\n",
             "scene.toml:2:20: 'files' must be an array of strings, not a string"},
        Case{"[[model]]\nframes = { files = [1] }\n",
             "scene.toml:2:21: 'files' must be an array of strings, not an integer"},
        Case{"[settings]\nthreads = [1]\n",
             "scene.toml:2:11: a setting must be a string, a number "
             "or a boolean, not an array"},
        Case{"[settings]\nsince = 1979-05-27\n",
             "scene.toml:2:9: a setting must be a string, a "
             "number or a boolean, not a date or time"},
        Case{"[settings.grid.deep]\na = 1\n",
             "scene.toml:1:1: settings are nested once at most, "
             "as in grid.density"}));

class BadValue : public ::testing::TestWithParam<Case> {};

TEST_P(BadValue, IsAnErrorWithLineAndColumn) {
  const TemporaryFolder folder;
  folder.write("a.obj", kTriangleObj);
  EXPECT_EQ(error_in(GetParam().text, folder.path()), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    Values, BadValue,
    ::testing::Values(
        Case{"[camera]\nfov = 180\n",
             "scene.toml:2:7: 'fov' must be greater than 0 and less than 180, not 180"},
        Case{"[camera]\nfov = 0\n",
             "scene.toml:2:7: 'fov' must be greater than 0 and less than 180, not 0"},
        Case{"[camera]\nfov = nan\n",
             "scene.toml:2:7: 'fov' must be a finite number of at most 1e37, not nan"},
        Case{"[camera]\northographic_height = 0\n",
             "scene.toml:2:23: 'orthographic_height' must be at least 1e-37, not 0"},
        Case{"[camera]\northographic_height = -3\n",
             "scene.toml:2:23: 'orthographic_height' must be at least 1e-37, not -3"},
        Case{"[camera]\northographic_height = inf\n",
             "scene.toml:2:23: 'orthographic_height' must be a finite number of at most 1e37, not "
             "inf"},
        Case{"[camera]\nfov = 60\northographic_height = 5\n",
             "scene.toml:3:23: a camera has either 'fov' (perspective) or 'orthographic_height'; "
             "remove one"},
        Case{"[camera]\neye = [0, inf, 0]\n",
             "scene.toml:2:11: 'eye' must be a finite number of at most 1e37, not inf"},
        Case{"[camera]\neye = [0, 1e300, 0]\n",
             "scene.toml:2:11: 'eye' must be a finite number of at most 1e37, not 1e+300"},
        Case{"[camera]\ntarget = [0, 0, 25]\n",
             "scene.toml:2:10: 'eye' and 'target' of the camera must differ"},
        Case{"[camera]\nup = [0, 0, 2]\n",
             "scene.toml:2:6: 'up' of the camera must not be zero or along its view"},
        Case{"[[light]]\n", "scene.toml:1:1: a light needs a 'position'"},
        Case{"[[light]]\nposition = [0, 0, 0]\ncolor = -1\n",
             "scene.toml:3:9: 'color' must be at least 0, not -1"},
        Case{"[[material]]\ndiffuse = 1\n", "scene.toml:1:1: a material needs a 'name'"},
        Case{"[[material]]\nname = \"m\"\nopacity = 1.5\n",
             "scene.toml:3:11: 'opacity' must be between 0 and 1, not 1.5"},
        Case{"[[material]]\nname = \"m\"\n[[material]]\nname = \"m\"\n",
             "scene.toml:4:8: there are two materials 'm'"},
        Case{"[[model]]\n",
             "scene.toml:1:1: a model needs exactly one of 'file', 'generator' and 'frames'"},
        Case{"[[model]]\nfile = \"a.obj\"\ngenerator = \"box\"\n",
             "scene.toml:1:1: a model needs exactly one of 'file', 'generator' and 'frames'"},
        Case{"[[material]]\nname = \"brass\"\n[[model]]\nfile = \"a.obj\"\nmaterial = \"bras\"\n",
             "scene.toml:5:12: there is no material 'bras'; did you mean 'brass'?"},
        Case{"[[model]]\nfile = \"a.obj\"\nfit = 0\n",
             "scene.toml:3:7: 'fit' must be greater than 0, not 0"},
        Case{"[[model]]\nfile = \"a.obj\"\nrotate = { axis = [0, 0, 0], degrees = 1 }\n",
             "scene.toml:3:19: 'axis' must not be all zero"},
        Case{"[[model]]\nfile = \"a.obj\"\nrotate = { axis = [0, 0, 1] }\n",
             "scene.toml:3:10: 'rotate' needs 'degrees'"},
        Case{"[[model]]\ngenerator = \"spheer\"\n",
             "scene.toml:2:13: no generator is called 'spheer'; did you mean 'sphere'?"},
        Case{"[[model]]\nfile = \"a.obj\"\n[[model.key]]\nscale = 2\n",
             "scene.toml:3:1: a key needs 'time' (seconds)"},
        Case{"[[model]]\nfile = \"a.obj\"\n[[model.key]]\ntime = 1\n[[model.key]]\ntime = 1\n",
             "scene.toml:6:8: 'time' must grow from key to key; 1 follows 1"},
        Case{"[[model]]\nfile = \"a.obj\"\ndeform = { kind = \"wav\" }\n",
             "scene.toml:3:19: 'kind' must be wave, twist or explode, not 'wav'; did you mean "
             "'wave'?"},
        Case{"[[model]]\nfile = \"a.obj\"\ndeform = { kind = \"wave\", wavelength = 0 }\n",
             "scene.toml:3:40: 'wavelength' must be greater than 0, not 0"},
        Case{"[[model]]\nfile = \"a.obj\"\ndeform = { kind = \"wave\" }\n[[model.key]]\ntime = 0\n",
             "scene.toml:3:10: a model cannot have keys and a deformer"},
        Case{"[[model]]\nframes = { fps = 3 }\n",
             "scene.toml:2:10: a frame sequence needs either 'folder' or 'files'"},
        Case{"[[model]]\nframes = { files = [] }\n",
             "scene.toml:2:20: 'files' must name at least one file"},
        Case{"[[model]]\nframes = { files = [\"a.obj\"], fps = 0 }\n",
             "scene.toml:2:37: 'fps' must be greater than 0, not 0"},
        Case{"[[model]]\nframes = { files = [\"a.obj\"] }\ndeform = { kind = \"wave\" }\n",
             "scene.toml:2:10: a frame sequence cannot also have keys or a deformer"},
        Case{"[[model]]\nfile = \"\"\n", "scene.toml:2:8: the name of the model file is empty"}));

TEST(SceneTomlErrors, AMissingModelNamesItsLineAndThePathsTried) {
  const TemporaryFolder here;
  const TemporaryFolder there;
  const std::string error = error_of([&] {
    parse_scene_toml("\n[[model]]\nfile = \"sub/gone.ply\"\n", "s.toml", here.path(),
                     {there.path()});
  });
  EXPECT_TRUE(error.starts_with("s.toml:3:8: cannot find the model file 'sub/gone.ply'")) << error;
  EXPECT_TRUE(contains(error, (here.path() / "sub/gone.ply").string())) << error;
  EXPECT_TRUE(contains(error, (there.path() / "sub/gone.ply").string())) << error;
  EXPECT_TRUE(contains(error, (there.path() / "gone.ply").string())) << error;
}

TEST(SceneTomlErrors, ABrokenModelNamesItsLineToo) {
  const TemporaryFolder folder;
  folder.write("empty.ply", "");
  const std::string error = error_in("[[model]]\nfile = \"empty.ply\"\n", folder.path());
  EXPECT_TRUE(error.starts_with("scene.toml:2:8: ")) << error;
  EXPECT_TRUE(contains(error, "empty.ply")) << error;
}

TEST(SceneTomlErrors, FoldersAndDevicesAreNoModels) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "d.obj");
  EXPECT_TRUE(contains(error_in("[[model]]\nfile = \"d.obj\"\n", folder.path()), "cannot find"));
  EXPECT_TRUE(
      contains(error_in("[[model]]\nfile = \"/dev/zero\"\n", folder.path()), "cannot find"));
}

TEST(SceneTomlErrors, AnEmptyFolderMeansNoFilesAtAll) {
  const TemporaryFolder folder;
  const fs::path model = folder.write("a.obj", kTriangleObj);
  const std::string text = "[[model]]\nfile = \"" + model.string() + "\"\n";
  EXPECT_EQ(parse(text, folder.path()).instances.size(), 1U);
  EXPECT_TRUE(contains(error_in(text), "no files are looked up here"));
}

TEST(SceneTomlErrors, AFolderOfFramesMustHoldModels) {
  const TemporaryFolder folder;
  folder.write("f/readme.txt", "nothing");
  const std::string text = "[[model]]\nframes = { folder = \"f\" }\n";
  EXPECT_TRUE(contains(error_in(text, folder.path()), "scene.toml:2:21: the folder"));
  EXPECT_TRUE(contains(error_in(text, folder.path()), "holds no model files"));
}

TEST(SceneTomlErrors, AMovingGeneratorTakesNoSecondMotion) {
  // A sphere does not move, so it may; a sample scene that moves may not.
  parse("[[model]]\ngenerator = \"sphere\"\ndeform = { kind = \"wave\" }\n");
  EXPECT_EQ(error_in("[[model]]\ngenerator = \"toys\"\ndeform = { kind = \"wave\" }\n"),
            "scene.toml:2:13: 'toys' moves by itself; it cannot be given another motion");
}

TEST(SceneTomlLimits, DeepNestingIsRefusedBeforeItOverflowsTheStack) {
  std::string dotted = "a";
  for (int i = 0; i < 200000; ++i) dotted += ".a";
  EXPECT_TRUE(contains(error_in(dotted + " = 1\n"), "a key of more than 16 parts"));
  EXPECT_TRUE(contains(error_in("[" + dotted + "]\n"), "scene.toml:1:33: a key of more than"));
  const std::string arrays = "a = " + std::string(100000, '[') + "\n";
  EXPECT_TRUE(error_in(arrays).starts_with("scene.toml:1:"));
  // The deepest that is let through: inline tables of 16 parts in one another.
  std::string inner = "1";
  for (int i = 0; i < 250; ++i) inner = "{ a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = " + inner + " }";
  EXPECT_EQ(parse("a = " + inner + "\n").warnings.messages.size(), 1U);
}

TEST(SceneTomlLimits, DotsInsideStringsAndCommentsAreNoNesting) {
  const std::string dots(300, '.');
  const Scene scene =
      parse("# " + dots + "\nname = \"" + dots + "\" # " + dots + "\n[settings]\na = '" + dots +
            "'\nb = \"\"\"" + dots + "\n\"x\" " + dots + "\"\"\"\nc = \"\\\"" + dots + "\"\n");
  EXPECT_EQ(scene.name, dots);
  EXPECT_EQ(scene.preferences.size(), 3U);
}

TEST(SceneTomlLimits, AFewLinesCannotAskForBillionsOfTriangles) {
  std::string text;
  for (int i = 0; i < 60000; ++i) text += "[[model]]\ngenerator = \"sphere\"\n";
  EXPECT_TRUE(contains(error_in(text), "triangles; the limit is 200000000"));
}

}  // namespace
}  // namespace encore::scene::test
