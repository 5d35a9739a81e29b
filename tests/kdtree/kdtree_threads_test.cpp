// Several threads build the same tree; several rays at once find the same hits.
#include "accel/kdtree/kdtree.h"
#include "kd_scenes.h"
#include "tests/support/thread_counts.h"
#include "tests/support/tile_hits.h"

#include <gtest/gtest.h>

namespace encore::accel {
namespace {

class KdTreeThreads : public testing::TestWithParam<StructureKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, KdTreeThreads, kd_test::kKinds, kd_test::kind_name);

TEST_P(KdTreeThreads, BuildTheSame) {
  const auto make = [](MemoryMode memory) { return KdTree(GetParam(), {}, memory); };
  test::expect_same_for_any_threads(make, kd_test::soup(70'000, 0.03F, 1));
  test::expect_same_for_any_threads(make, kd_test::terrain(185, 0.1F));
}

TEST_P(KdTreeThreads, KeepTheLimitsOfOneThread) {
  // Where references run out, and at every limit around the one where they begin to.
  const std::vector<Triangle> triangles = kd_test::soup(66'000, 0.1F, 3);
  bool seen[2] = {false, false};
  for (const int most : {2, 3, 4, 6, 32}) {
    KdTreeSettings settings;
    settings.most_references = most;
    settings.depth_offset = 6.0F;
    KdTree alone(GetParam(), settings, MemoryMode::pool);
    KdTree together(GetParam(), settings, MemoryMode::pool);
    alone.set_build_threads(1);
    together.set_build_threads(2);
    alone.build(triangles);
    together.build(triangles);
    EXPECT_EQ(together.stats().limited, alone.stats().limited) << most;
    EXPECT_TRUE(test::content_of(together) == test::content_of(alone)) << most;
    EXPECT_EQ(together.build_operations(), alone.build_operations()) << most;
    seen[alone.stats().limited ? 1 : 0] = true;
  }
  EXPECT_TRUE(seen[0] && seen[1]);
}

TEST_P(KdTreeThreads, CanBeCancelled) {
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  test::expect_cancelled_builds_end(tree, kd_test::soup(70'000, 0.03F, 4));
}

TEST_P(KdTreeThreads, TilesFindWhatSingleRaysFind) {
  KdTree tree(GetParam(), {}, MemoryMode::pool);
  test::expect_tiles_as_single_rays(tree, kd_test::soup(1500, 0.2F, 6), false);
  test::expect_tiles_as_single_rays(tree, kd_test::terrain(20, 0.2F), false);
  test::expect_tiles_as_single_rays(tree, kd_test::boxes(4), false);
  for (const kd_test::NamedScene& scene : kd_test::hostile_scenes()) {
    SCOPED_TRACE(scene.name);
    if (scene.triangles.size() < 700)
      test::expect_tiles_as_single_rays(tree, scene.triangles, true);
  }
}

}  // namespace
}  // namespace encore::accel
