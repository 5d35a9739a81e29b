// Cells and planes: the thesis' example, and agreement on every float between the two ways to ask.
#include "accel/grid/grid.h"
#include "tests/grid/random_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace encore::accel::test {
namespace {

scene::Bounds box(const vec3& min, const vec3& max) {
  return {min, max};
}

TEST(GridLayout, ThesisExampleHasCellsOf5x4x6) {
  // 7,532 triangles in a box of 100 x 80 x 120: cbrt = 19.6, so 20 cells an axis.
  std::vector<Triangle> triangles(
      7532, scene::make_triangle(vec3(13, 55, 30), vec3(24, 60, 50), vec3(20, 57, 40)));
  triangles[0] = scene::make_triangle(vec3(0), vec3(100, 0, 0), vec3(0, 0, 120));
  triangles[1] = scene::make_triangle(vec3(100, 80, 120), vec3(100, 80, 0), vec3(0, 80, 120));
  Grid grid(StructureKind::grid_box, {}, MemoryMode::pool);
  grid.build(triangles);
  EXPECT_EQ(grid.stats().grid_size, (std::array<std::uint32_t, 3>{20, 20, 20}));
  const vec3 size(5, 4, 6);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::uint32_t i = 0; i <= 20; ++i) {
      EXPECT_EQ(grid.layout().planes(axis)[i], size[axis] * static_cast<float>(i));
    }
  }
  const CellRange range = grid.layout().range_of(box(vec3(13, 55, 30), vec3(24, 60, 50)));
  EXPECT_EQ(range.first(0), 2U);
  EXPECT_EQ(range.first(0) + range.span(0), 4U);
  EXPECT_EQ(range.first(1), 13U);
  EXPECT_EQ(range.first(1) + range.span(1), 15U);
  EXPECT_EQ(range.first(2), 5U);
  EXPECT_EQ(range.first(2) + range.span(2), 8U);
  EXPECT_EQ(range.cells(), 36U);
  EXPECT_EQ(grid.cell(2, 13, 5).size(), 7530U);
  EXPECT_TRUE(grid.cell(1, 13, 5).empty());
}

TEST(GridLayout, CellOfAgreesWithTheStoredPlanesOnEveryFloatBesideThem) {
  Random random(1);
  AllocationCount count;
  GridLayout layout;
  const auto check = [&](const scene::Bounds& bounds, std::uint32_t cells) {
    layout.divide(bounds, cells, MemoryMode::pool, count);
    ASSERT_EQ(layout.bounds(), bounds);
    for (int axis = 0; axis < 3; ++axis) {
      const float* planes = layout.planes(axis);
      for (std::uint32_t i = 1; i < layout.size(axis); ++i) {
        ASSERT_LE(planes[i - 1], planes[i]);
        // Planes that coincide belong to the highest cell that starts there.
        ASSERT_GE(layout.cell_of(axis, planes[i]), i);
        ASSERT_LT(layout.cell_of(
                      axis, std::nextafter(planes[i], -std::numeric_limits<float>::infinity())),
                  i);
      }
    }
  };
  for (int i = 0; i < 200; ++i) {
    const float scale = std::ldexp(1.0F, static_cast<int>(random.below(120)) - 60);
    const vec3 low = random.point(scale);
    check(box(low, low + (random.point(0.5F) + vec3(0.5F)) * scale), 1 + random.below(200));
  }
  // Extents of a few floats, astride zero, of the whole range of floats, and of denormals.
  check(box(vec3(1.0F), vec3(1.0F + 0x1p-22F)), 64);
  check(box(vec3(-1e-20F, -1.0F, -1e20F), vec3(1.0F, 1e-30F, 1e-20F)), 1024);
  check(box(vec3(-3e38F), vec3(3e38F)), 100);
  check(box(vec3(0.0F), vec3(std::numeric_limits<float>::denorm_min() * 5)), 10);
}

TEST(GridLayout, AnAxisWithoutExtentHasOneCell) {
  AllocationCount count;
  GridLayout layout;
  layout.divide(box(vec3(1, 2, 3), vec3(2, 2, 5)), 8, MemoryMode::pool, count);
  EXPECT_EQ(layout.sizes(), (std::array<std::uint32_t, 3>{8, 1, 8}));
  layout.divide(scene::Bounds{}, 8, MemoryMode::pool, count);
  EXPECT_EQ(layout.cell_count(), 1U);
}

TEST(GridLayout, CoordinatesOutsideBelongToTheNearestCell) {
  AllocationCount count;
  GridLayout layout;
  layout.divide(box(vec3(0), vec3(1)), 10, MemoryMode::pool, count);
  EXPECT_EQ(layout.cell_of(0, -5.0F), 0U);
  EXPECT_EQ(layout.cell_of(0, 1.0F), 9U);
  EXPECT_EQ(layout.cell_of(0, 1e38F), 9U);
  EXPECT_EQ(layout.cell_of(0, std::numeric_limits<float>::infinity()), 9U);
}

}  // namespace
}  // namespace encore::accel::test
