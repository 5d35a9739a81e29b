// The loading of whole scenes can be followed and ended: scene files, sequences, generators.
#include "scene/load_watch.h"

#include "scene/sample_scenes.h"
#include "tests/scene_files/support.h"

#include <functional>
#include <string>
#include <vector>

namespace encore::scene::test {
namespace {

/// Looks of a whole loading; at most `most` of them are then cancelled in turn, evenly chosen.
std::uint64_t cancel_everywhere(const std::function<void()>& load, std::uint64_t most) {
  LoadWatch watch;
  {
    const LoadScope scope(&watch);
    load();
  }
  EXPECT_EQ(watch.progress, 1.0F);
  const std::uint64_t looks = watch.looks;
  const std::uint64_t step = looks / most + 1;
  float last = 0.0F;
  for (std::uint64_t look = 1; look <= looks; look += step) {
    watch.last_look = look;
    const LoadScope scope(&watch);
    EXPECT_THROW(load(), LoadCancelled) << look;
    EXPECT_GE(watch.progress, last) << look;
    EXPECT_LT(watch.progress, 1.0F);
    last = watch.progress;
  }
  return looks;
}

TEST(LoadWatch, SequencesShowTheirFrames) {
  const TemporaryFolder folder;
  for (int i = 0; i < 10; ++i) {
    folder.write("walk/f" + std::to_string(i) + ".obj", kTriangleObj);
  }
  const fs::path file = folder.write(
      "walk.toml",
      "[[model]]\nframes = {folder = \"walk\", fps = 10}\n[[model]]\ngenerator = \"box\"\n");
  const auto load = [&] { load_scene(file.string()); };
  EXPECT_GE(cancel_everywhere(load, 100), 10U);

  // Somewhere in the middle it is at the frame that it says.
  LoadWatch watch;
  bool seen = false;
  for (watch.last_look = 1;; ++watch.last_look) {
    try {
      const LoadScope scope(&watch);
      load();
      break;
    } catch (const LoadCancelled&) {
      if (watch.doing() != "frame 5 of 10, f4.obj") continue;
      seen = true;
      EXPECT_GE(watch.progress, 0.5F * 0.4F);
      EXPECT_LE(watch.progress, 0.5F * 0.5F + 1e-6F);
    }
  }
  EXPECT_TRUE(seen);
}

TEST(LoadWatch, ClassicScenesAreFollowedLineByLine) {
  const TemporaryFolder folder;
  folder.write("a.obj", kTriangleObj);
  std::string text = "CAMERA 0 0 9 0 0 0 0 1 0 60\n";
  for (int i = 0; i < 5; ++i) text += "MODEL a.obj 0 0 0 1 0 0 1 0\n";
  const fs::path file = folder.write("old.txt", text);
  EXPECT_GE(cancel_everywhere([&] { load_scene(file.string()); }, 100), 2U);
}

TEST(LoadWatch, LargeGeneratedScenesCanBeCancelled) {
  for (const char* name : {"dragon", "metaballs", "still-life"}) {
    EXPECT_GE(cancel_everywhere([&] { load_scene(name); }, 4), 20U) << name;
    LoadWatch watch;
    const LoadScope scope(&watch);
    load_scene(name);
    EXPECT_TRUE(contains(watch.doing(), name)) << watch.doing();
  }
}

TEST(LoadWatch, AFlagEndsTheLargestSampleSceneAtOnce) {
  std::atomic<bool> cancel{true};
  for (const SampleScene& sample : sample_scenes()) {
    LoadWatch watch;
    watch.cancel = &cancel;
    const LoadScope scope(&watch);
    EXPECT_THROW(make_sample_scene(sample.name), LoadCancelled) << sample.name;
    EXPECT_EQ(watch.looks, 1U);
  }
}

}  // namespace
}  // namespace encore::scene::test
