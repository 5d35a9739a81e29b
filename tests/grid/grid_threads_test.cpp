// Several threads build the same grid; several rays at once find the same hits.
#include "accel/grid/grid.h"
#include "tests/grid/random_scenes.h"
#include "tests/support/thread_counts.h"
#include "tests/support/tile_hits.h"

#include <gtest/gtest.h>

namespace encore::accel::test {
namespace {

class GridThreads : public testing::TestWithParam<StructureKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, GridThreads,
                         testing::Values(StructureKind::grid_box, StructureKind::grid_exact));

TEST_P(GridThreads, BuildTheSame) {
  const auto make = [](MemoryMode memory) { return Grid(GetParam(), GridSettings{}, memory); };
  expect_same_for_any_threads(make, soup(70'000, 0.03F, 1));
  expect_same_for_any_threads(make, terrain(190, 0.1F, 2));
  // Large ones, for which the grid has to be made coarser.
  expect_same_for_any_threads(make, soup(66'000, 1.5F, 3));
}

TEST_P(GridThreads, CanBeCancelled) {
  Grid grid(GetParam(), GridSettings{}, MemoryMode::pool);
  expect_cancelled_builds_end(grid, soup(70'000, 0.03F, 4));
}

TEST_P(GridThreads, TilesFindWhatSingleRaysFind) {
  Grid grid(GetParam(), GridSettings{}, MemoryMode::pool);
  expect_tiles_as_single_rays(grid, soup(1, 1.0F, 5), false);
  expect_tiles_as_single_rays(grid, soup(1500, 0.2F, 6), false);
  expect_tiles_as_single_rays(grid, terrain(24, 0.2F, 7), false);
  expect_tiles_as_single_rays(grid, scaled(soup(800, 0.4F, 8), vec3(1e18F, 1e18F, 1e18F)), true);
  expect_tiles_as_single_rays(grid, scaled(soup(800, 0.4F, 9), vec3(1e-15F, 1e3F, 1.0F)), true);
}

}  // namespace
}  // namespace encore::accel::test
