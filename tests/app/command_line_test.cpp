// The program as a user meets it: exit codes, one clear message, data on standard output.
#include "run_program.h"
#include "scene/sample_scenes.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace encore::app {
namespace {

using test::contains;

TEST(CommandLine, HelpExplainsEveryCommand) {
  const ProgramResult all = run_encore({"--help"});
  EXPECT_EQ(all.exit_code, 0);
  for (const char* command : {"profile", "study", "render", "verify", "info", "scenes", "doctor",
                              "battery", "compare", "model"}) {
    EXPECT_TRUE(contains(all.out, command)) << command;
    const ProgramResult one = run_encore({command, "--help"});
    EXPECT_EQ(one.exit_code, 0) << command;
    EXPECT_GT(one.out.size(), 100U) << command;
  }
}

TEST(CommandLine, WrongUsageExitsWithTwoAndSaysWhat) {
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const Case cases[] = {
      {{"profil"}, "profil"},
      {{"verify", "--structure", "kd-sha"}, "did you mean 'kd-sah'"},
      {{"verify", "--set", "kd.leaf_triangle=4"}, "did you mean 'kd.leaf_triangles'"},
      {{"verify", "--set", "kd.leaf_triangles=many"}, "'many'"},
      {{"verify", "--set", "grid.density"}, "key=value"},
      {{"verify", "--memory", "heap"}, "pool and malloc"},
      {{"verify", "--rays", "0"}, "--rays"},
      {{"render", "triangle", "--out", "x.png", "--size", "0x5"}, "--size"},
  };
  for (const Case& c : cases) {
    const ProgramResult result = run_encore(c.arguments);
    EXPECT_EQ(result.exit_code, 2) << c.says << "\n" << result.err;
    EXPECT_TRUE(contains(result.err, c.says)) << result.err;
    EXPECT_TRUE(result.out.empty()) << result.out;
  }
}

TEST(CommandLine, BadInputExitsWithThreeAndNamesThePlace) {
  const ProgramResult unknown = run_encore({"info", "bunnny"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_TRUE(contains(unknown.err, "bunny")) << unknown.err;
  const ProgramResult missing = run_encore({"info", "no/such/file.ply"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_TRUE(contains(missing.err, "no/such/file.ply")) << missing.err;
}

TEST(CommandLine, MisspeltSettingsOfASceneAreWarnedOf) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.write(
      "scene.toml", "[[model]]\ngenerator = \"box\"\n[settings]\nstructre = \"kd-sah\"\n");
  const ProgramResult result = run_encore({"verify", file, "--rays", "20"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "scene.toml:4")) << result.err;
  EXPECT_TRUE(contains(result.err, "did you mean 'structure'")) << result.err;
}

TEST(CommandLine, ScenesListsEverySampleOnceAsTableAndJson) {
  const ProgramResult table = run_encore({"scenes"});
  const ProgramResult json = run_encore({"scenes", "--json"});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_EQ(json.exit_code, 0);
  for (const scene::SampleScene& sample : scene::sample_scenes()) {
    EXPECT_TRUE(contains(table.out, sample.name)) << sample.name;
    EXPECT_TRUE(contains(json.out, "\"name\": \"" + sample.name + "\"")) << sample.name;
  }
}

TEST(CommandLine, InfoDescribesAScene) {
  const ProgramResult result = run_encore({"info"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "11,141")) << result.out;
  const ProgramResult json = run_encore({"info", "triangle", "--json"});
  EXPECT_EQ(json.exit_code, 0) << json.err;
  EXPECT_TRUE(contains(json.out, "\"triangles\": 1")) << json.out;
}

TEST(CommandLine, VerifyFindsNoMismatchOnAnAnimatedScene) {
  const ProgramResult result = run_encore({"verify", "toys", "--rays", "50"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(contains(result.out, " 0 mismatches")) << result.out;
  EXPECT_TRUE(contains(result.out, "refit")) << result.out;
}

TEST(CommandLine, RenderWritesAPictureWhereAskedAndNowhereElse) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "grüße.png";
  const ProgramResult result = run_encore({"render", "mug", "--size", "64", "--out", file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(test::contents_of(file).starts_with("\x89PNG"));
  const ProgramResult nowhere = run_encore({"render", "mug", "--out", "/no/such/folder/x.png"});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_TRUE(contains(nowhere.err, "/no/such/folder")) << nowhere.err;
}

}  // namespace
}  // namespace encore::app
