// Where the program looks for what ships with it.
#include "scene/shipped_files.h"

#include "scene/scene_file.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace encore::scene {
namespace {

namespace fs = std::filesystem;

TEST(ShippedFiles, LieBesideTheProgramOrElseWhereItIsToBeInstalled) {
  const std::vector<fs::path> candidates = shipped_folder_candidates("/some/where/bin/encore");
  ASSERT_GE(candidates.size(), 2U);
  EXPECT_NE(std::find(candidates.begin(), candidates.end(), "/some/where/share/encore"),
            candidates.end());
  EXPECT_EQ(candidates.back(), ENCORE_SHARE_FOLDER);
  EXPECT_EQ(shipped_folder_candidates({}), std::vector<fs::path>{ENCORE_SHARE_FOLDER});
}

TEST(ShippedFiles, TheFirstFolderThatIsThereIsTaken) {
  const test::TemporaryFolder folder;
  const fs::path missing = folder.path() / "missing";
  const fs::path file = folder.write("file", "x");
  const fs::path second = folder.path() / "second";
  fs::create_directories(second);
  const std::vector<fs::path> all{missing, file, second, folder.path()};
  EXPECT_EQ(first_folder(all), second);
  EXPECT_EQ(first_folder(std::vector<fs::path>{missing, file}), fs::path());
}

TEST(ShippedFiles, OfABuildFolderAreTheSourcesOwn) {
  ASSERT_FALSE(shipped_folder().empty()) << shipped_files_missing();
  EXPECT_TRUE(fs::equivalent(shipped_folder(), fs::path(ENCORE_SOURCE_DIR) / "assets"));
  EXPECT_EQ(shipped_names("studies"), (std::vector<std::string>{"quick", "thesis"}));
}

TEST(ShippedFiles, AreFoundByBareNamesOnly) {
  EXPECT_FALSE(shipped_file("scenes", "jelly").empty());
  for (const char* name : {"", "jelly.toml", "../scenes/jelly", "/jelly", "no-such-scene"}) {
    EXPECT_TRUE(shipped_file("scenes", name).empty()) << name;
  }
}

TEST(ShippedFiles, EveryShippedSceneLoadsByName) {
  const std::vector<std::string> names = shipped_names("scenes");
  ASSERT_GE(names.size(), 4U);
  for (const std::string& name : names) {
    EXPECT_FALSE(load_scene(name).instances.empty()) << name;
  }
}

}  // namespace
}  // namespace encore::scene
