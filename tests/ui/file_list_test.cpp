// What the file browser lists: sorted, filtered, bounded, without blocking, and errors in words.
#include "ui/file_list.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <thread>

namespace {

namespace fs = std::filesystem;
using namespace encore::ui;

class FileBrowserFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("encore_browser_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "session");
    fs::create_directories(folder_ / "Models");
    for (const char* name : {"b.obj", "A.toml", "c.OBJ", ".hidden.obj", "notes.md"}) touch(name);
    touch("session/session.toml");
  }
  void TearDown() override { fs::remove_all(folder_); }
  void touch(const std::string& name) const { std::ofstream(folder_ / name) << "x"; }

  std::vector<std::string> names(const FileFilter& filter) const {
    const FileList list = read_folder(folder_);
    std::vector<std::string> shown;
    for (const std::size_t i : shown_entries(list, filter)) shown.push_back(list.entries[i].name);
    return shown;
  }

  fs::path folder_;
};

using Names = std::vector<std::string>;

TEST_F(FileBrowserFolder, ListsFoldersFirstAndSorted) {
  EXPECT_EQ(names({}), (Names{"Models", "session", "A.toml", "b.obj", "c.OBJ", "notes.md"}));
}

TEST_F(FileBrowserFolder, FiltersByExtensionPartAndKind) {
  EXPECT_EQ(names({.extensions = {".obj"}}), (Names{"Models", "session", "b.obj", "c.OBJ"}));
  EXPECT_EQ(names({.extensions = {".obj"}, .hidden = true}),
            (Names{"Models", "session", ".hidden.obj", "b.obj", "c.OBJ"}));
  EXPECT_EQ(names({.folders_only = true}), (Names{"Models", "session"}));
  EXPECT_EQ(names({.part = "OB"}), (Names{"b.obj", "c.OBJ"}));
}

TEST_F(FileBrowserFolder, MarksSessions) {
  const FileList list = read_folder(folder_);
  for (const FileEntry& entry : list.entries) EXPECT_EQ(entry.session, entry.name == "session");
  EXPECT_FALSE(list.session);
  EXPECT_TRUE(read_folder(folder_ / "session").session);
}

TEST_F(FileBrowserFolder, TellsWhatCannotBeRead) {
  const FileList list = read_folder(folder_ / "absent");
  EXPECT_TRUE(list.entries.empty());
  EXPECT_NE(list.problem.find("absent"), std::string::npos);
  EXPECT_EQ(list.problem.find('\n'), std::string::npos);
}

TEST_F(FileBrowserFolder, StopsAtItsLimit) {
  const FileList list = read_folder(folder_, 3);
  EXPECT_EQ(list.entries.size(), 3U);
  EXPECT_TRUE(list.cut);
  EXPECT_FALSE(read_folder(folder_).cut);
}

TEST_F(FileBrowserFolder, ReadsInTheBackground) {
  FolderReader reader;
  EXPECT_EQ(reader.list(), nullptr);
  reader.want(folder_);
  std::shared_ptr<const FileList> list;
  while ((list = reader.list()) == nullptr) std::this_thread::yield();
  EXPECT_EQ(list->entries.size(), 7U);
  touch("new.obj");
  reader.want(folder_);
  EXPECT_EQ(reader.list(), list);
  reader.want(folder_, true);
  while ((list = reader.list()) == nullptr) std::this_thread::yield();
  EXPECT_EQ(list->entries.size(), 8U);
}

TEST_F(FileBrowserFolder, RefusesNamesThatAreTaken) {
  const FileList list = read_folder(folder_);
  EXPECT_EQ(name_obstacle(list, "fresh"), "");
  EXPECT_NE(name_obstacle(list, "session").find("overwritten"), std::string::npos);
  EXPECT_NE(name_obstacle(list, ""), "");
  EXPECT_NE(name_obstacle(list, "../up"), "");
  EXPECT_NE(name_obstacle(list, ".."), "");
}

TEST(TypedPath, StartsWhereItSays) {
  EXPECT_EQ(typed_path("b/../c.obj", "/a"), "/a/c.obj");
  EXPECT_EQ(typed_path("/x/y", "/a"), "/x/y");
  EXPECT_EQ(typed_path("~/m", "/a"), home_folder() / "m");
}

}  // namespace
