#include "scene/classic_scene_file.h"
#include "support.h"

#include <sstream>
#include <string>
#include <vector>

namespace encore::scene::test {
namespace {

/// The fenced blocks of a kind in docs/scene-format.md.
std::vector<std::string> blocks(const std::string& kind) {
  std::istringstream lines(
      encore::test::contents_of(fs::path(ENCORE_SOURCE_DIR) / "docs" / "scene-format.md"));
  std::vector<std::string> result;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "```" + kind) {
      inside = true;
      result.emplace_back();
    } else if (line == "```") {
      inside = false;
    } else if (inside) {
      result.back() += line + "\n";
    }
  }
  return result;
}

/// The model files that the examples name.
void write_models(const TemporaryFolder& folder) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
      "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  folder.write("bunny.ply", ply);
  folder.write("models/ply/teapot.ply", ply);
  for (const char* name : {"open.obj", "closed.obj", "walk/1.obj", "walk/2.obj"}) {
    folder.write(name, kTriangleObj);
  }
}

TEST(Documentation, EveryTomlExampleIsReadWithoutAWarning) {
  const TemporaryFolder folder;
  write_models(folder);
  const auto examples = blocks("toml");
  EXPECT_GE(examples.size(), 6U);
  for (const std::string& example : examples) {
    SCOPED_TRACE(example);
    const Scene scene = parse(example, folder.path());
    EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
    EXPECT_FALSE(triangles_at(scene).triangles.empty());
  }
}

TEST(Documentation, EveryClassicExampleIsReadWithoutAWarning) {
  const TemporaryFolder folder;
  write_models(folder);
  const auto examples = blocks("txt");
  EXPECT_GE(examples.size(), 1U);
  for (const std::string& example : examples) {
    const Scene scene = parse_classic_scene(example, "example.txt", folder.path());
    EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
    EXPECT_EQ(scene.instances.size(), 2U);
  }
}

TEST(Documentation, EverySceneThatShipsLoadsWithoutAWarning) {
  int count = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(ENCORE_SOURCE_DIR) / "assets" / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path());
    const Scene scene = load_scene(entry.path().string());
    EXPECT_TRUE(scene.warnings.messages.empty()) << joined(scene.warnings);
    EXPECT_FALSE(triangles_at(scene, 0.5).triangles.empty());
    ++count;
  }
  EXPECT_GE(count, 4);
}

}  // namespace
}  // namespace encore::scene::test
