// What a grid holds: every true reference, no false one in grid-exact, bounded memory.
#include "accel/grid/grid.h"
#include "accel/triangle_box.h"
#include "shaders/shared/bindings.h"
#include "tests/grid/random_scenes.h"
#include "tests/grid/triangle_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace encore::accel::test {
namespace {

using Visitor = std::function<void(const scene::Bounds&, std::span<const std::uint32_t> box,
                                   std::span<const std::uint32_t> exact)>;

// Builds both kinds and shows all cells of both, side by side.
void compare_kinds(const std::vector<Triangle>& triangles, GridSettings settings,
                   const Visitor& visitor) {
  Grid by_box(StructureKind::grid_box, settings, MemoryMode::pool);
  Grid exact(StructureKind::grid_exact, settings, MemoryMode::pool);
  by_box.build(triangles);
  exact.build(triangles);
  ASSERT_EQ(by_box.stats().grid_size, exact.stats().grid_size);
  const GridLayout& layout = exact.layout();
  for (std::uint32_t z = 0; z < layout.size(2); ++z) {
    for (std::uint32_t y = 0; y < layout.size(1); ++y) {
      for (std::uint32_t x = 0; x < layout.size(0); ++x) {
        visitor(layout.cell_bounds(x, y, z), by_box.cell(x, y, z), exact.cell(x, y, z));
      }
    }
  }
}

void expect_exact_references(const std::vector<Triangle>& triangles, GridSettings settings = {}) {
  std::size_t lost = 0, superfluous = 0, foreign = 0, kept = 0, dropped = 0, unsorted = 0;
  const auto visitor = [&](const scene::Bounds& cell, std::span<const std::uint32_t> by_box,
                           std::span<const std::uint32_t> exact) {
    const std::set<std::uint32_t> kept_here(exact.begin(), exact.end());
    if (!std::is_sorted(exact.begin(), exact.end()) || kept_here.size() != exact.size()) {
      ++unsorted;
    }
    if (!std::includes(by_box.begin(), by_box.end(), exact.begin(), exact.end())) ++foreign;
    for (const std::uint32_t i : by_box) {
      const bool in = kept_here.count(i) != 0;
      ++(in ? kept : dropped);
      // By clipping: what reaches well into the cell must be there, what stays clear must not.
      if (!in && clip_leaves_something(triangles[i], cell, -1e-9)) ++lost;
      if (in && !clip_leaves_something(triangles[i], cell, 1e-4)) ++superfluous;
      if (!in && overlaps(triangles[i], cell) && clip_leaves_something(triangles[i], cell, 0.0)) {
        ++lost;
      }
    }
  };
  compare_kinds(triangles, settings, visitor);
  EXPECT_EQ(lost, 0U);
  EXPECT_EQ(superfluous, 0U);
  EXPECT_EQ(foreign, 0U);
  EXPECT_EQ(unsorted, 0U);
  EXPECT_GE(kept, triangles.size());
  EXPECT_GT(dropped, 0U);
}

TEST(GridBuild, ExactHoldsWhatClippingFindsAndNothingElse) {
  expect_exact_references(soup(2000, 0.1F, 1));
  expect_exact_references(soup(300, 0.6F, 2));
  expect_exact_references(soup(60, 1.0F, 3), {.cells_per_axis = 40});
  expect_exact_references(terrain(24, 0.3F, 4), {.cells_per_axis = 24});
  expect_exact_references(scaled(soup(500, 0.4F, 5), vec3(1e-15F, 1e3F, 1.0F)));
}

TEST(GridBuild, ExactIsExactForNeedlesAndForWallsSeenEdgeOn) {
  // Segments through many cells, and slanted walls whose projections have no area.
  auto triangles = soup(150, 1.0F, 6);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Triangle& t = triangles[i];
    if (i % 3 == 0) t.v2 = t.v1;
    if (i % 3 == 1) t.v2 = vec3(t.v1.x, t.v1.y, t.v0.z);
  }
  expect_exact_references(triangles, {.cells_per_axis = 12});
}

TEST(GridBuild, EveryPointOfATriangleLiesInACellThatHoldsIt) {
  const auto triangles = terrain(20, 0.4F, 7);
  Grid grid(StructureKind::grid_exact, {}, MemoryMode::pool);
  grid.build(triangles);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (const vec3& p : {triangles[i].v0, triangles[i].v1, triangles[i].v2}) {
      const auto cell = grid.cell(grid.layout().cell_of(0, p.x), grid.layout().cell_of(1, p.y),
                                  grid.layout().cell_of(2, p.z));
      ASSERT_TRUE(std::binary_search(cell.begin(), cell.end(), i)) << i;
    }
  }
}

TEST(GridBuild, HostileTrianglesCannotSwellMemoryWithoutLimit) {
  // Each triangle's bounds are the whole scene: 27,000 references each in the thesis' grid.
  const std::vector<Triangle> triangles(
      27000, scene::make_triangle(vec3(-1, -1, -1), vec3(1, 1, 0.5F), vec3(0.3F, -0.2F, 1)));
  std::array<std::uint64_t, 2> references{};
  std::array<std::array<std::uint32_t, 3>, 2> sizes{};
  std::size_t i = 0;
  for (const StructureKind kind : {StructureKind::grid_exact, StructureKind::grid_box}) {
    Grid grid(kind, {}, MemoryMode::pool);
    grid.build(triangles);
    references[i] = grid.stats().references;
    sizes[i++] = grid.stats().grid_size;
  }
  EXPECT_LE(references[1], (1U << 22) + 32 * triangles.size());
  EXPECT_LE(references[0], references[1]);
  EXPECT_EQ(sizes[0], sizes[1]);
  EXPECT_LT(sizes[1][0], 30U);
  EXPECT_GT(sizes[1][0], 3U);
}

TEST(GridBuild, CellsSetByHandAreCapped) {
  const auto triangles = soup(10, 0.1F, 8);
  Grid grid(StructureKind::grid_box, {.cells_per_axis = 100000}, MemoryMode::pool);
  grid.build(triangles);
  EXPECT_LE(grid.stats().nodes, (1U << 24) + 64 * triangles.size());
  EXPECT_GE(grid.stats().grid_size[0], 2U);
  Grid wanted(StructureKind::grid_box, {.cells_per_axis = 9}, MemoryMode::pool);
  wanted.build(triangles);
  EXPECT_EQ(wanted.stats().grid_size, (std::array<std::uint32_t, 3>{9, 9, 9}));
  Grid dense(StructureKind::grid_box, {.density = 2.0F}, MemoryMode::pool);
  dense.build(soup(1000, 0.1F, 9));
  EXPECT_EQ(dense.stats().grid_size, (std::array<std::uint32_t, 3>{20, 20, 20}));
}

TEST(GridBuild, PoolAllocatesOnceAndFreshEveryTime) {
  const auto triangles = soup(3000, 0.1F, 10);
  for (const StructureKind kind : {StructureKind::grid_exact, StructureKind::grid_box}) {
    Grid pool(kind, {}, MemoryMode::pool);
    pool.build(triangles);
    EXPECT_GT(pool.stats().allocations, 0U);
    EXPECT_GE(pool.stats().allocated_bytes, pool.stats().bytes);
    pool.build(triangles);
    EXPECT_EQ(pool.stats().allocations, 0U);
    EXPECT_EQ(pool.stats().allocated_bytes, 0U);
    Grid fresh(kind, {}, MemoryMode::fresh);
    fresh.build(triangles);
    const BuildStats first = fresh.stats();
    fresh.build(triangles);
    EXPECT_GT(first.allocations, 0U);
    EXPECT_EQ(fresh.stats().allocations, first.allocations);
    EXPECT_EQ(fresh.stats().allocated_bytes, first.allocated_bytes);
  }
}

TEST(GridBuild, StatisticsAgreeWithTheCells) {
  const auto triangles = soup(2000, 0.2F, 11);
  for (const StructureKind kind : {StructureKind::grid_exact, StructureKind::grid_box}) {
    Grid grid(kind, {}, MemoryMode::fresh);
    grid.build(triangles);
    std::uint64_t leaves = 0, references = 0, largest = 0;
    grid.visit([&](const NodeView& node) {
      EXPECT_TRUE(node.leaf);
      EXPECT_FALSE(node.triangles.empty());
      for (const std::uint32_t t : node.triangles)
        EXPECT_TRUE(overlaps(triangles[t], node.bounds) || kind == StructureKind::grid_box);
      ++leaves;
      references += node.triangles.size();
      largest = std::max<std::uint64_t>(largest, node.triangles.size());
      return true;
    });
    const BuildStats stats = grid.stats();
    EXPECT_EQ(stats.triangles, triangles.size());
    EXPECT_EQ(stats.leaves, leaves);
    EXPECT_EQ(stats.references, references);
    EXPECT_EQ(stats.largest_leaf, largest);
    EXPECT_EQ(stats.nodes, 13U * 13 * 13);
    EXPECT_EQ(stats.triangle_box_tests > 0, kind == StructureKind::grid_exact);
    EXPECT_GT(stats.sah_cost, static_cast<double>(references) / static_cast<double>(stats.nodes));
    std::uint64_t bytes = 0;
    for (const GpuBuffer& buffer : grid.gpu_buffers()) bytes += buffer.bytes.size();
    EXPECT_EQ(stats.bytes, bytes);
  }
}

TEST(GridBuild, TheGpuSeesStartsReferencesAndPlanesOfTheSameCells) {
  const auto triangles = soup(500, 0.2F, 12);
  Grid grid(StructureKind::grid_exact, {}, MemoryMode::pool);
  grid.build(triangles);
  const GpuBuffers buffers = grid.gpu_buffers();
  const auto words = [&](int binding) {
    for (const GpuBuffer& b : buffers) {
      if (b.binding == binding) {
        return std::span(reinterpret_cast<const std::uint32_t*>(b.bytes.data()),
                         b.bytes.size() / 4);
      }
    }
    return std::span<const std::uint32_t>{};
  };
  const auto starts = words(ENCORE_BINDING_CELL_STARTS);
  const auto references = words(ENCORE_BINDING_REFERENCES);
  ASSERT_EQ(starts.size(), 8U * 8 * 8 + 1);
  ASSERT_EQ(words(ENCORE_BINDING_CELL_PLANES).size(), 3U * 9);
  EXPECT_EQ(starts.front(), 0U);
  EXPECT_EQ(starts.back(), references.size());
  EXPECT_TRUE(std::is_sorted(starts.begin(), starts.end()));
  const auto cell = grid.cell(3, 4, 5);
  const std::uint32_t c = 3 + 8 * (4 + 8 * 5);
  EXPECT_TRUE(std::equal(cell.begin(), cell.end(), references.begin() + starts[c],
                         references.begin() + starts[c + 1]));
}

}  // namespace
}  // namespace encore::accel::test
