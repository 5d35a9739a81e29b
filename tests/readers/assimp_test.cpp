// Formats that go through Assimp, the guard around it, and which reader a file gets.
#include "scene/model_child_process.h"
#include "tests/readers/reader_test.h"

#include <csignal>
#include <span>

namespace encore::scene {
namespace {

TEST(AssimpReader, Reads3dsStlAndOff) {
  const Model square = read_model(fixture("square.3ds"));
  EXPECT_EQ(square.mesh.triangles.size(), 2U);
  EXPECT_EQ(square.mesh.positions.size(), 4U);
  EXPECT_EQ(square.name, "square");
  EXPECT_EQ(read_model(fixture("triangle.stl")).mesh.triangles.size(), 1U);
  const Model arrow = read_model(fixture("arrow.off"));
  ASSERT_EQ(arrow.mesh.triangles.size(), 2U);
  for (const glm::uvec3& t : arrow.mesh.triangles) EXPECT_GT(doubled_area(arrow.mesh, t), 0.0);
}

TEST(AssimpReader, AppliesNodeTransformsAndKeepsFacingUnderMirrors) {
  const Model model = read_model(fixture("mirrored.gltf"));
  ASSERT_EQ(model.mesh.triangles.size(), 2U);
  ASSERT_EQ(model.mesh.positions.size(), 6U);
  EXPECT_EQ(model.mesh.positions[1], glm::vec3(9.0F, 0.0F, 0.0F));
  EXPECT_EQ(model.mesh.positions[4], glm::vec3(9.0F, 0.0F, 5.0F));
  for (const glm::uvec3& t : model.mesh.triangles) EXPECT_EQ(doubled_area(model.mesh, t), 1.0);
  const auto material = model.mesh.material_of.empty() ? 0 : model.mesh.material_of[0];
  EXPECT_EQ(model.materials[material].diffuse, glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST(AssimpReader, ReadsTheSameFromMemory) {
  const std::string bytes = contents_of(fixture("square.3ds"));
  const Model model = read_with_assimp(std::as_bytes(std::span(bytes)), ".3DS", "memory");
  EXPECT_EQ(model.mesh.triangles.size(), 2U);
}

TEST(AssimpReader, EveryTruncationLoadsOrIsAnInputError) {
  for (const char* name : {"square.3ds", "triangle.stl", "arrow.off", "mirrored.gltf"}) {
    const std::string bytes = contents_of(fixture(name));
    const std::string extension = std::filesystem::path(name).extension();
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
      try {
        const auto part = std::as_bytes(std::span(bytes).first(size));
        EXPECT_LE(read_with_assimp(part, extension, name).mesh.triangles.size(), 2U);
      } catch (const InputError& error) {
        EXPECT_TRUE(contains(error.what(), name));
      }
    }
  }
}

TEST(AssimpReader, HugeCountsAndGarbageAreInputErrors) {
  const auto read = [](const std::string& text, const char* extension) {
    return error_of([&] { read_with_assimp(std::as_bytes(std::span(text)), extension, "bad"); });
  };
  EXPECT_TRUE(contains(read("OFF\n4000000000 4000000000 0\n0 0 0\n", ".off"), "bad: "));
  std::string garbage;
  std::uint32_t state = 7;
  for (int i = 0; i < 4096; ++i) {
    state = state * 1664525U + 1013904223U;
    garbage += static_cast<char>(state >> 24U);
  }
  for (const char* extension : {".3ds", ".glb", ".fbx", ".x", ".blend", ".ply", ".obj"}) {
    EXPECT_TRUE(contains(read(garbage, extension), "bad")) << extension;
  }
  EXPECT_TRUE(contains(read(garbage, ".doc"), "not a model format that is known"));
  EXPECT_TRUE(contains(read("", ".3ds"), "empty"));
}

TEST(ReadModel, ContentDecidesOverTheExtension) {
  for (const auto& [good, wrong] :
       {std::pair{"tetrahedron.obj", "a.ply"}, std::pair{"square.ply", "a.obj"},
        std::pair{"square.3ds", "a.ply"}, std::pair{"triangle.stl", "a.3ds"},
        std::pair{"arrow.off", "a.obj"}, std::pair{"mirrored.gltf", "a.stl"},
        std::pair{"tetrahedron.obj", "a.model"}}) {
    const TemporaryFolder folder;
    const Model model = read_model(folder.write(wrong, contents_of(fixture(good))));
    EXPECT_FALSE(model.mesh.triangles.empty()) << good;
    EXPECT_TRUE(warns(model, "but holds")) << good;
  }
}

TEST(ReadModel, FilesThatCannotBeReadSayWhy) {
  EXPECT_TRUE(contains(error_of([] { read_model("no/such.obj"); }), "no/such.obj: no such file"));
  EXPECT_TRUE(contains(error_of([] { read_model(fixture("")); }), "is a folder"));
  EXPECT_TRUE(contains(error_of([] { read_model("/dev/zero"); }), "is no regular file"));
  const TemporaryFolder folder;
  const auto empty = folder.write("empty.ply", "");
  EXPECT_TRUE(contains(error_of([&] { read_model(empty); }), "empty.ply: the file is empty"));
  const auto text = folder.write("notes.txt", "v is the third last letter but four\n");
  EXPECT_TRUE(contains(error_of([&] { read_model(text); }), "known are .obj .ply .3ds"));
  const auto gz = folder.write("a.obj.gz", "\x1F\x8B whatever");
  EXPECT_TRUE(contains(error_of([&] { read_model(gz); }), "unpack it first"));
}

using Outcome = ChildResult::Outcome;
constexpr ChildLimits kLimits{256U << 20U, 2, 60};

TEST(ChildProcess, HandsBackWhatTheWorkReturns) {
  const std::string large(3'000'000, 'x');
  const ChildResult result = run_in_child([&] { return large; }, kLimits);
  EXPECT_EQ(result.outcome, Outcome::finished);
  EXPECT_EQ(result.bytes, large);
}

TEST(ChildProcess, ACrashEndsThereOnly) {
  const auto signal = [](int number) {
    return run_in_child(
        [number] {
          std::raise(number);
          return std::string();
        },
        kLimits);
  };
  EXPECT_EQ(signal(SIGSEGV).outcome, Outcome::crashed);
  EXPECT_EQ(signal(SIGABRT).outcome, Outcome::crashed);
  const ChildResult thrown = run_in_child([]() -> std::string { throw 1; }, kLimits);
  EXPECT_EQ(thrown.outcome, Outcome::crashed);
}

TEST(ChildProcess, EndlessWorkIsEnded) {
  const auto spin = []() -> std::string {
    volatile bool forever = true;
    while (forever) {
    }
    return {};
  };
  EXPECT_EQ(run_in_child(spin, {256U << 20U, 1, 60}).outcome, Outcome::out_of_time);
  const auto wait = []() -> std::string {
    while (true) raise(SIGSTOP);
  };
  EXPECT_EQ(run_in_child(wait, {256U << 20U, 10, 1}).outcome, Outcome::out_of_time);
}

TEST(ChildProcess, SwellingWorkIsEnded) {
#if ENCORE_SANITIZED
  GTEST_SKIP() << "a sanitizer ends the process instead of failing the allocation";
#endif
  const auto swell = []() -> std::string {
    std::string all;
    while (true) all.append(1U << 20U, 'x');
  };
  EXPECT_EQ(run_in_child(swell, kLimits).outcome, Outcome::out_of_memory);
}

}  // namespace
}  // namespace encore::scene
