// A build can be followed and ended at any point; afterwards the structure is empty and valid, and
// the next build is what it would have been.
#include "accel/build_watch.h"

#include "accel/make_structure.h"
#include "scene/sample_scenes.h"
#include "scene/triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace encore::accel {
namespace {

/// Bytes of all that tracing needs, one after the other.
std::vector<std::byte> content(const AccelerationStructure& structure) {
  std::vector<std::byte> bytes;
  for (const GpuBuffer& buffer : structure.gpu_buffers()) {
    bytes.insert(bytes.end(), buffer.bytes.begin(), buffer.bytes.end());
  }
  return bytes;
}

scene::TriangleList triangles_of(const std::string& name) {
  const scene::Scene scene = scene::make_sample_scene(name).value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  return list;
}

/// A row of rays through the scene.
std::vector<Ray> rays_at(const Bounds& bounds) {
  std::vector<Ray> rays;
  for (int i = 0; i <= 8; ++i) {
    const float share = static_cast<float>(i) / 8.0F;
    const glm::vec3 at = bounds.min + share * (bounds.max - bounds.min);
    rays.push_back(Ray{{at.x, at.y, bounds.max.z + 1.0F}, 0, {0, 0, -1}});
  }
  return rays;
}

class WatchedBuild : public testing::TestWithParam<std::tuple<StructureKind, MemoryMode>> {
 protected:
  WatchedBuild() {
    StructureSpec spec = default_spec(std::get<0>(GetParam()));
    spec.memory = std::get<1>(GetParam());
    structure = make_structure(spec);
    const auto untouched = make_structure(spec);
    untouched->build(list.triangles);
    expected = content(*untouched);
    hits.resize(rays.size());
    untouched->intersect(rays, hits);
  }

  /// Builds with a watch that cancels at that look; whether it was cancelled.
  bool cancelled_at(std::uint64_t look) {
    watch.last_look = look;
    structure->set_build_watch(&watch);
    bool cancelled = false;
    try {
      structure->build(list.triangles);
    } catch (const BuildCancelled&) {
      cancelled = true;
    }
    structure->set_build_watch(nullptr);
    return cancelled;
  }
  void expect_empty() const {
    std::vector<Hit> found(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    structure->intersect(rays, found);
    structure->occluded(rays, blocked);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_FALSE(found[i].found());
      EXPECT_EQ(blocked[i], 0);
    }
    const BuildStats stats = structure->stats();
    EXPECT_EQ(stats.triangles, 0U);
    EXPECT_EQ(stats.references, 0U);
    structure->visit([](const NodeView& node) {
      EXPECT_TRUE(node.triangles.empty());
      return true;
    });
    EXPECT_EQ(structure->gpu_parameters().references, 0U);
  }
  void expect_whole() const {
    EXPECT_EQ(content(*structure), expected);
    std::vector<Hit> found(rays.size());
    structure->intersect(rays, found);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(found[i].triangle, hits[i].triangle);
      EXPECT_EQ(found[i].t, hits[i].t);
    }
  }

  scene::TriangleList list = triangles_of("toys");
  std::vector<Ray> rays = rays_at(list.bounds());
  std::vector<Hit> hits;
  std::vector<std::byte> expected;
  std::unique_ptr<AccelerationStructure> structure;
  BuildWatch watch;
};

TEST_P(WatchedBuild, CanBeCancelledAtEveryLookAndThenBuiltAsEver) {
  ASSERT_FALSE(cancelled_at(~std::uint64_t{0}));
  expect_whole();
  const std::uint64_t looks = watch.looks;
  ASSERT_GE(looks, 1U);
  float last = 0.0F;
  for (std::uint64_t look = 1; look <= looks; ++look) {
    ASSERT_TRUE(cancelled_at(look)) << look;
    EXPECT_GE(watch.progress, last) << "at look " << look;
    last = watch.progress;
    expect_empty();
    if (look % 7 == 1) {
      structure->build(list.triangles);
      expect_whole();
    }
  }
  EXPECT_LT(last, 1.0F) << "not before the end";
  structure->build(list.triangles);
  expect_whole();
}

TEST_P(WatchedBuild, AFlagThatIsSetEndsItAtOnce) {
  std::atomic<bool> cancel{true};
  watch.cancel = &cancel;
  structure->build(list.triangles);
  EXPECT_TRUE(cancelled_at(~std::uint64_t{0}));
  EXPECT_EQ(watch.looks, 1U);
  EXPECT_EQ(watch.progress, 0.0F);
  expect_empty();
  cancel = false;
  EXPECT_FALSE(cancelled_at(~std::uint64_t{0}));
  EXPECT_EQ(watch.progress, 1.0F);
  expect_whole();
}

TEST_P(WatchedBuild, AnUpdateAfterACancelledBuildBuilds) {
  ASSERT_TRUE(cancelled_at(1));
  structure->update(list.triangles);
  expect_whole();
}

TEST_P(WatchedBuild, ProgressIsAboutTheShareOfLooks) {
  // Looks come at even steps of work, so progress must not run far ahead of them or behind.
  if (std::get<0>(GetParam()) == StructureKind::brute) return;
  list = triangles_of("dragon");
  ASSERT_FALSE(cancelled_at(~std::uint64_t{0}));
  const std::uint64_t looks = watch.looks;
  ASSERT_GT(looks, 10U);
  ASSERT_TRUE(cancelled_at(looks));
  EXPECT_GT(watch.progress, 0.5F);
  ASSERT_TRUE(cancelled_at(looks / 2));
  EXPECT_GT(watch.progress, 0.05F);
  EXPECT_LT(watch.progress, 0.95F);
}

TEST_P(WatchedBuild, AnEmptySceneIsDoneAtOnce) {
  structure->set_build_watch(&watch);
  structure->build({});
  EXPECT_EQ(watch.progress, 1.0F);
}

std::string name_of(const testing::TestParamInfo<std::tuple<StructureKind, MemoryMode>>& test) {
  std::string name(to_string(std::get<0>(test.param)));
  name += std::string("_") + std::string(to_string(std::get<1>(test.param)));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Structures, WatchedBuild,
                         testing::Combine(testing::ValuesIn(all_structure_kinds()),
                                          testing::Values(MemoryMode::pool, MemoryMode::fresh)),
                         name_of);

TEST(BuildWatch, AnotherThreadMayReadProgressAndCancel) {
  const scene::TriangleList list = triangles_of("bunny");
  for (const StructureKind kind : all_structure_kinds()) {
    std::atomic<bool> cancel{false};
    std::atomic<bool> over{false};
    BuildWatch watch;
    watch.cancel = &cancel;
    std::thread reader([&] {
      float last = 0.0F;
      while (!over) {
        const float now = watch.progress.load();
        EXPECT_GE(now, last);
        EXPECT_LE(now, 1.0F);
        last = now;
        if (now > 0.4F) cancel = true;
      }
    });
    const auto structure = make_structure(default_spec(kind));
    structure->set_build_watch(&watch);
    bool cancelled = false;
    try {
      structure->build(list.triangles);
    } catch (const BuildCancelled&) {
      cancelled = true;
    }
    over = true;
    reader.join();
    // Whether the reader was in time is the system's affair; both ends are good ones.
    EXPECT_EQ(structure->stats().triangles, cancelled ? 0U : list.triangles.size());
  }
}

}  // namespace
}  // namespace encore::accel
