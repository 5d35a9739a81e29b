// Several threads build and refit the same hierarchy; several rays at once find the same hits.
#include "accel/bvh/bvh.h"
#include "test_scenes.h"
#include "tests/support/thread_counts.h"
#include "tests/support/tile_hits.h"

#include <gtest/gtest.h>

namespace encore::accel::test {
namespace {

TEST(BvhThreads, BuildTheSame) {
  const auto make = [](MemoryMode memory) {
    return Bvh(StructureKind::bvh_median, BvhSettings{}, memory);
  };
  expect_same_for_any_threads(make, soup(70'000, 0.03F, 1));
  expect_same_for_any_threads(make, giants_and_dwarfs(66'000, 2));
  expect_same_for_any_threads(make, identical(66'000));
}

TEST(BvhThreads, RefitTheSame) {
  const Triangles before = soup(70'000, 0.03F, 3);
  Triangles after = before;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (i % 3 != 0 || i > 40'000) after[i].v1 += glm::vec3(0.02F * after[i].v0.y, 0.01F, 0.0F);
  }
  for (const UpdateCase update :
       {UpdateCase::real, UpdateCase::best, UpdateCase::average, UpdateCase::worst}) {
    BvhSettings settings;
    settings.update_case = update;
    Bvh alone(StructureKind::bvh_median, settings, MemoryMode::pool);
    Bvh together(StructureKind::bvh_median, settings, MemoryMode::pool);
    alone.set_build_threads(1);
    together.set_build_threads(3);
    alone.build(before);
    together.build(before);
    for (const bool moved : {true, false, false}) {
      alone.update(moved ? after : before);
      together.update(moved ? after : before);
      EXPECT_TRUE(content_of(together) == content_of(alone));
      EXPECT_EQ(together.last_refit().leaves_changed, alone.last_refit().leaves_changed);
      EXPECT_EQ(together.last_refit().leaves_written, alone.last_refit().leaves_written);
      EXPECT_EQ(together.last_refit().inner_written, alone.last_refit().inner_written);
    }
  }
}

TEST(BvhThreads, CanBeCancelled) {
  Bvh bvh(StructureKind::bvh_median, BvhSettings{}, MemoryMode::pool);
  expect_cancelled_builds_end(bvh, soup(70'000, 0.03F, 4));
}

TEST(BvhThreads, TilesFindWhatSingleRaysFind) {
  Bvh bvh(StructureKind::bvh_median, BvhSettings{}, MemoryMode::pool);
  expect_tiles_as_single_rays(bvh, soup(1500, 0.2F, 6), false);
  expect_tiles_as_single_rays(bvh, floor_tiles(20), false);
  for (const auto& [name, triangles] : all_test_scenes()) {
    SCOPED_TRACE(name);
    if (!triangles.empty() && triangles.size() < 700) {
      expect_tiles_as_single_rays(bvh, triangles, true);
    }
  }
}

}  // namespace
}  // namespace encore::accel::test
