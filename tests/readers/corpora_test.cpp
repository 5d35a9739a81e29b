// Every file of the collections at hand: real models give the triangles they are known to hold,
// broken ones a model or one message, and none of them crashes, hangs or swells the program.
#include "scene/model_child_process.h"
#include "tests/readers/reader_test.h"

#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <vector>

namespace encore::scene {
namespace {

struct Report {
  bool survived = false;
  bool loaded = false;
  std::uint64_t triangles = 0;
  std::uint64_t texture_bytes = 0;
  std::uint64_t grown_bytes = 0;  // peak memory of reading, in the reading process
  std::string error;
};

std::uint64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// Reads the file in a child, so that whatever happens is told by name. Assimp's own guard starts a
// second child in there.
Report examine(const std::filesystem::path& path) {
  const auto work = [&path] {
    std::ostringstream out;
    const std::uint64_t before = peak_bytes();
    try {
      const Model model = read_model(path);
      std::set<const Texture*> textures;
      std::uint64_t bytes = 0;
      for (const Material& material : model.materials) {
        const Texture* texture = material.diffuse_texture.get();
        if (texture != nullptr && textures.insert(texture).second) bytes += texture->bytes();
      }
      out << "1 " << model.mesh.triangles.size() << ' ' << bytes << ' ' << peak_bytes() - before;
    } catch (const InputError& error) {
      out << "0 0 0 " << peak_bytes() - before << ' ' << error.what();
    }
    return out.str();
  };
  const ChildResult result = run_in_child(work, {8ULL << 30U, 120, 600});
  Report report;
  report.survived = result.outcome == ChildResult::Outcome::finished;
  std::istringstream in(result.bytes);
  in >> report.loaded >> report.triangles >> report.texture_bytes >> report.grown_bytes;
  in.ignore();
  std::getline(in, report.error);
  return report;
}

// What must hold for any file at all.
void expect_harmless(const std::filesystem::path& path, const Report& report) {
  ASSERT_TRUE(report.survived) << path;
  EXPECT_TRUE(report.loaded || contains(report.error, path.filename().string())) << path;
#if !ENCORE_SANITIZED
  // Room for the libraries' fixed costs, then a few times the file or what it legitimately becomes.
  const std::uint64_t size = std::filesystem::file_size(path);
  // A texture is here twice while it comes from the process that decoded it.
  EXPECT_LE(report.grown_bytes,
            (16ULL << 20U) + 8 * size + 200 * report.triangles + 3 * report.texture_bytes)
      << path;
#endif
}

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::vector<std::string>> index_rows(const std::filesystem::path& folder) {
  std::ifstream file(folder / "INDEX.tsv");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, '\t');) cells.push_back(cell);
    if (cells.size() >= 10) rows.push_back(cells);
  }
  return rows;
}

TEST(Corpora, RealModelsHoldTheTrianglesTheyAreKnownFor) {
  const auto folder = real_models();
  if (folder.empty()) GTEST_SKIP() << "no real models: set ENCORE_MODELS to their folder";
  int models = 0;
  for (const auto& row : index_rows(folder)) {
    const std::filesystem::path path = folder / row[0];
    const std::string extension = path.extension();
    const bool model =
        extension == ".obj" || extension == ".ply" || extension == ".3ds" || extension == ".3DS";
    if (!model || row[0].starts_with("malformed/")) continue;
    const Report report = examine(path);
    expect_harmless(path, report);
    EXPECT_TRUE(report.loaded) << path << report.error;
    EXPECT_EQ(std::to_string(report.triangles), row[5]) << path;
    ++models;
  }
  EXPECT_GT(models, 50);
}

TEST(Corpora, OddButSoundFilesLoadWhole) {
  const auto folder = real_models();
  if (folder.empty()) GTEST_SKIP() << "no real models: set ENCORE_MODELS to their folder";
  // Files that hold triangles with bad indices (dropped, with a warning), an empty file and UTF-16.
  const std::set<std::string> differ = {"malformed.obj",
                                        "empty.obj",
                                        "box_UTF16BE.obj",
                                        "invalid-relative-texture-index.obj",
                                        "invalid-relative-vertex-index.obj",
                                        "issue-140-zero-face-idx.obj"};
  int models = 0;
  for (const auto& row : index_rows(folder)) {
    const std::filesystem::path path = folder / row[0];
    const std::string extension = path.extension();
    const bool known = (extension == ".obj" || extension == ".ply") && row[5] != "-" &&
                       row[0].starts_with("malformed/") && !contains(row[0], "_fuzz/");
    if (!known || differ.contains(path.filename())) continue;
    const Report report = examine(path);
    EXPECT_TRUE(report.loaded) << path << report.error;
    EXPECT_EQ(std::to_string(report.triangles), row[5]) << path;
    ++models;
  }
  EXPECT_GT(models, 50);
}

TEST(Corpora, MalformedFilesAreHarmless) {
  const auto folder = real_models();
  if (folder.empty()) GTEST_SKIP() << "no real models: set ENCORE_MODELS to their folder";
  const auto files = files_below(folder / "malformed");
  EXPECT_GE(files.size(), 300U);
  for (const auto& path : files) expect_harmless(path, examine(path));
}

TEST(Corpora, AssimpTestModelsAreHarmlessAndEveryAcceptedFormatIsProven) {
  const std::filesystem::path folder = "/usr/share/assimp/models";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no package assimp-testmodels";
  std::map<std::string, int> proven;
  for (const auto& path : files_below(folder)) {
    const Report report = examine(path);
    expect_harmless(path, report);
    if (!report.loaded || report.triangles == 0) continue;
    std::string extension = path.extension();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    ++proven[extension];
  }
  for (const std::string& extension : supported_extensions()) {
    EXPECT_GT(proven[extension], 0) << extension;
  }
}

}  // namespace
}  // namespace encore::scene
