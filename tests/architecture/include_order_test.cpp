// The folders' one-way order: a file includes only from its own folder and from those to its left.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kSource = ENCORE_SOURCE_DIR;

// What each folder may include of the others, from docs/architecture.md.
const std::map<std::string, std::set<std::string>> kAllowed{
    {"shaders", {}},
    {"scene", {"shaders"}},
    {"accel", {"shaders", "scene"}},
    {"renderer", {"shaders", "scene", "accel"}},
    {"energy", {}},
    {"ui", {"shaders", "scene", "accel", "renderer", "energy"}},
    {"app", {"shaders", "scene", "accel", "renderer", "energy", "ui"}},
};

struct Include {
  fs::path file;
  int line;
  std::string folder;  // first part of the included path, empty for a library header
  std::string text;
};

std::vector<Include> includes_of(const fs::path& folder) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  if (!fs::exists(folder)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      std::smatch match;
      if (!std::regex_search(line, match, pattern)) continue;
      const std::string path = match[2];
      const bool own = match[1] == "\"";
      found.push_back({entry.path(), number, own ? path.substr(0, path.find('/')) : "", path});
    }
  }
  return found;
}

TEST(IncludeOrder, EachFolderIncludesOnlyThoseToItsLeft) {
  for (const auto& [folder, allowed] : kAllowed) {
    for (const Include& include : includes_of(kSource / folder)) {
      if (include.folder.empty() || include.folder == folder) continue;
      EXPECT_TRUE(allowed.contains(include.folder))
          << include.file.string() << ":" << include.line << " includes " << include.text;
    }
  }
}

TEST(IncludeOrder, OwnHeadersAreNamedFromTheProjectRoot) {
  for (const auto& [folder, allowed] : kAllowed) {
    for (const Include& include : includes_of(kSource / folder)) {
      if (include.folder.empty()) continue;
      EXPECT_TRUE(kAllowed.contains(include.folder))
          << include.file.string() << ":" << include.line << " includes \"" << include.text << '"';
    }
  }
}

TEST(IncludeOrder, LibrariesStayInTheirFolders) {
  // Only these folders may see these libraries.
  const std::vector<std::pair<std::regex, std::set<std::string>>> rules{
      {std::regex("^(epoxy|GL|EGL|GLFW)/"), {"renderer", "ui", "app"}},
      {std::regex("^imgui"), {"ui", "app"}},
      {std::regex("^(assimp/|tiny_obj_loader)"), {"scene"}},
      {std::regex("^glm/"), {"shaders", "scene", "accel", "renderer", "ui", "app"}},
      {std::regex("^CLI/"), {"app"}},
  };
  for (const auto& [folder, allowed] : kAllowed) {
    for (const Include& include : includes_of(kSource / folder)) {
      for (const auto& [library, folders] : rules) {
        if (!std::regex_search(include.text, library)) continue;
        EXPECT_TRUE(folders.contains(folder))
            << include.file.string() << ":" << include.line << " includes " << include.text;
      }
    }
  }
}

TEST(IncludeOrder, FilesAreShort) {
  for (const auto& [folder, allowed] : kAllowed) {
    if (!fs::exists(kSource / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
      EXPECT_LE(lines, 400) << entry.path().string();
    }
  }
}

TEST(IncludeOrder, TheCheckItselfSeesTheSources) {
  // A wrong path would make every test above pass on nothing.
  EXPECT_GT(includes_of(kSource / "accel").size(), 20U);
  EXPECT_GT(includes_of(kSource / "scene").size(), 20U);
}

}  // namespace
