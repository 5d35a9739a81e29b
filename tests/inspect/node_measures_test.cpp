// What nodes are coloured by is what the formulas say: shares of the SAH cost sum to the whole and
// the whole is that of the statistics; overlap and growth are those of boxes made by hand.
#include "accel/inspect/node_measures.h"

#include "built.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace encore::accel::test {
namespace {

double sum_of(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(NodeMeasures, TheCostIsThatOfTheStatisticsAndSharesSumToIt) {
  for_all_structures(inspected_scenes(), [](const Built& built) {
    const double cost = built.structure->stats().sah_cost;
    EXPECT_NEAR(sah_cost(built.table), cost, 1e-9 * (1.0 + cost));
    const NodeValues shares = measure_nodes(built.table, NodeMeasure::sah_share);
    if (cost > 0) {
      ASSERT_EQ(shares.count, built.table.size());
      EXPECT_NEAR(sum_of(shares.values) + sah_share_of_empty_cells(built.table), 1.0, 1e-5);
    } else {
      EXPECT_EQ(shares.count, 0U);
    }
  });
}

TEST(NodeMeasures, EmptyCellsCostTheirStepsOnly) {
  const Built grid(StructureKind::grid_exact, soup(200, 0.1F, 3));
  EXPECT_GT(sah_share_of_empty_cells(grid.table), 0.1);
  EXPECT_EQ(sah_share_of_empty_cells(Built(StructureKind::kd_sah, soup(200, 0.1F, 3)).table), 0.0);
}

TEST(NodeMeasures, CountsDepthsAndReferences) {
  const Built built(StructureKind::kd_sah, sample("toys"));
  const NodeValues depth = measure_nodes(built.table, NodeMeasure::depth);
  const NodeValues leaf = measure_nodes(built.table, NodeMeasure::leaf_size);
  const NodeValues all = measure_nodes(built.table, NodeMeasure::references);
  const BuildStats stats = built.structure->stats();
  EXPECT_EQ(depth.max, static_cast<float>(stats.max_depth));
  EXPECT_EQ(depth.min, 0.0F);
  EXPECT_EQ(leaf.count, stats.leaves);
  EXPECT_EQ(leaf.max, static_cast<float>(stats.largest_leaf));
  EXPECT_TRUE(std::isnan(leaf.values[0])) << "the root is no leaf";
  EXPECT_EQ(all.values[0], static_cast<float>(stats.references));
  EXPECT_EQ(all.count, stats.nodes);
}

TEST(NodeMeasures, ThePercentilesLeaveOneInAHundredOut) {
  // 201 cells in a row, of 1 to 201 triangles, each a point in its cell.
  Triangles triangles;
  for (int cell = 0; cell < 201; ++cell) {
    const vec3 at(static_cast<float>(cell), 0, 0);
    triangles.insert(triangles.end(), static_cast<std::size_t>(cell) + 1,
                     make_triangle(at, at, at));
  }
  StructureSpec spec = default_spec(StructureKind::grid_box);
  spec.settings = GridSettings{.cells_per_axis = 201};
  const auto grid = make_structure(spec);
  grid->build(triangles);
  const NodeValues sizes = measure_nodes(NodeTable::make(*grid), NodeMeasure::leaf_size);
  EXPECT_EQ(sizes.min, 1.0F);
  EXPECT_EQ(sizes.max, 201.0F);
  EXPECT_GE(sizes.percentile_1, 2.0F);
  EXPECT_LE(sizes.percentile_1, 4.0F);
  EXPECT_GE(sizes.percentile_99, 198.0F);
  EXPECT_LE(sizes.percentile_99, 200.0F);
}

TEST(NodeMeasures, OverlapIsTheSharedAreaOverTheParents) {
  const Bounds parent{{0, 0, 0}, {3, 2, 2}};
  const Bounds left{{0, 0, 0}, {2, 2, 2}};
  EXPECT_FLOAT_EQ(node_overlap(parent, left, {{1, 0, 0}, {3, 2, 2}}), 16.0F / 32.0F);
  EXPECT_EQ(node_overlap(parent, left, {{2, 0, 0}, {3, 2, 2}}), 0.0F) << "they touch";
  EXPECT_EQ(node_overlap(parent, left, {{2.5F, 0, 0}, {3, 2, 2}}), 0.0F);
  EXPECT_FLOAT_EQ(node_overlap(parent, left, left), 24.0F / 32.0F);
  // A flat box: inside the other, on its face, and on its twin.
  const Bounds flat{{0, 1, 0}, {2, 1, 2}};
  EXPECT_FLOAT_EQ(node_overlap(parent, left, flat), 8.0F / 32.0F);
  EXPECT_EQ(node_overlap(parent, {{0, 1, 0}, {2, 2, 2}}, flat), 0.0F);
  EXPECT_FLOAT_EQ(node_overlap(parent, flat, flat), 8.0F / 32.0F);
  EXPECT_TRUE(std::isnan(node_overlap({{1, 1, 1}, {1, 1, 1}}, left, left)));
}

TEST(NodeMeasures, OnlyBoxesOverlap) {
  // Two triangles whose boxes share a cube of side 1: x from 1 to 2.
  const Triangles two{make_triangle({0, 0, 0}, {2, 1, 1}, {0, 1, 0}),
                      make_triangle({1, 0, 0}, {3, 1, 1}, {1, 1, 0})};
  const NodeValues bvh =
      measure_nodes(Built(StructureKind::bvh_median, two).table, NodeMeasure::overlap);
  ASSERT_EQ(bvh.values.size(), 3U);
  EXPECT_FLOAT_EQ(bvh.values[0], 6.0F / 14.0F);
  EXPECT_TRUE(std::isnan(bvh.values[1]) && std::isnan(bvh.values[2]));
  EXPECT_EQ(bvh.count, 1U);
  const Triangles toys = sample("toys");
  const NodeValues kd =
      measure_nodes(Built(StructureKind::kd_median, toys).table, NodeMeasure::overlap);
  EXPECT_GT(kd.count, 0U);
  EXPECT_EQ(kd.max, 0.0F);
  const NodeValues grid =
      measure_nodes(Built(StructureKind::grid_box, toys).table, NodeMeasure::overlap);
  EXPECT_EQ(grid.count, 0U);
}

TEST(NodeMeasures, NothingHasDecayedRightAfterTheBuild) {
  for_all_structures({{"toys", sample("toys")}, {"floor", floor_tiles(8)}}, [](const Built& built) {
    const auto areas = node_areas(built.table);
    const NodeValues decay = measure_nodes(built.table, NodeMeasure::refit_decay, areas);
    EXPECT_EQ(decay.count, built.table.size());
    EXPECT_EQ(decay.min, 1.0F);
    EXPECT_EQ(decay.max, 1.0F);
    const auto whole = sah_decay(built.table, areas);
    if (built.table.kind() == NodeKind::cells) {
      EXPECT_FALSE(whole);
    } else {
      EXPECT_DOUBLE_EQ(whole.value(), 1.0);
    }
  });
}

TEST(NodeMeasures, ADeformedSceneDecaysARefittedTree) {
  Built built(StructureKind::bvh_median, soup(2000, 0.3F, 12));
  const auto areas = node_areas(built.table);
  Random random(13);
  for (Triangle& t : built.triangles) {
    const vec3 move = random.point(3.0F);
    for (vec3* v : {&t.v0, &t.v1, &t.v2}) *v += move;
  }
  built.structure->update(built.triangles);
  const NodeTable after = NodeTable::make(*built.structure);
  const NodeValues decay = measure_nodes(after, NodeMeasure::refit_decay, areas);
  EXPECT_GT(sah_decay(after, areas).value(), 1.2);
  EXPECT_GT(decay.max, 2.0F);
  // Leaves only moved.
  for (std::uint32_t i = 0; i < after.size(); ++i) {
    if (after[i].leaf) {
      EXPECT_NEAR(decay.values[i], 1.0F, 1e-3F);
    }
  }
  // The table names nodes as before, so what was selected stays selected.
  ASSERT_EQ(after.size(), built.table.size());
  built.structure->visit([&, i = 0U](const NodeView& view) mutable {
    EXPECT_EQ(built.table.index_of(view.place), i++);
    return true;
  });
  built.structure->build(built.triangles);
  const NodeTable fresh = NodeTable::make(*built.structure);
  EXPECT_LT(sah_cost(fresh), sah_cost(after));
}

TEST(NodeMeasures, GrowthWithoutAreasOfTheSameNodesIsUnknown) {
  const Built built(StructureKind::bvh_median, soup(20, 1.0F, 14));
  const std::vector<double> other(7, 1.0);
  EXPECT_EQ(measure_nodes(built.table, NodeMeasure::refit_decay).count, 0U);
  EXPECT_EQ(measure_nodes(built.table, NodeMeasure::refit_decay, other).count, 0U);
  EXPECT_FALSE(sah_decay(built.table, other));
  EXPECT_FALSE(sah_decay(NodeTable(), {}));
}

TEST(StructureProfile, SumsToTheStatistics) {
  for_all_structures(inspected_scenes(), [](const Built& built) {
    const StructureProfile profile = profile_of(built.table);
    const BuildStats stats = built.structure->stats();
    DepthProfile sum;
    for (const DepthProfile& depth : profile.depths) {
      sum.inner += depth.inner;
      sum.leaves += depth.leaves;
      sum.empty_leaves += depth.empty_leaves;
      sum.references += depth.references;
      sum.largest_leaf = std::max(sum.largest_leaf, depth.largest_leaf);
    }
    if (built.table.empty()) return;
    EXPECT_EQ(sum.leaves, stats.leaves);
    EXPECT_EQ(sum.references, stats.references);
    EXPECT_EQ(sum.largest_leaf, stats.largest_leaf);
    if (built.table.kind() != NodeKind::cells) {
      EXPECT_EQ(sum.empty_leaves, stats.empty_leaves);
      EXPECT_EQ(profile.depths.size(), stats.max_depth + 1);
      if (built.table.bounds().area() > 0) {
        EXPECT_NEAR(profile.depths[0].area_share, 1.0, 1e-12);
      }
    }
    const auto leaves =
        std::accumulate(profile.leaf_sizes.begin(), profile.leaf_sizes.end(), std::uint64_t{0});
    EXPECT_EQ(leaves, stats.leaves);
    EXPECT_GT(profile.leaf_sizes.back(), 0U);
    const auto largest = leaf_size_range(profile.leaf_sizes.size() - 1);
    EXPECT_LE(largest[0], stats.largest_leaf);
    EXPECT_GE(largest[1], stats.largest_leaf);
  });
}

TEST(StructureProfile, SizesDoubleFromClassToClass) {
  using Range = std::array<std::uint64_t, 2>;
  EXPECT_EQ(leaf_size_range(0), (Range{0, 0}));
  EXPECT_EQ(leaf_size_range(1), (Range{1, 1}));
  EXPECT_EQ(leaf_size_range(2), (Range{2, 2}));
  EXPECT_EQ(leaf_size_range(3), (Range{3, 4}));
  EXPECT_EQ(leaf_size_range(4), (Range{5, 8}));
  for (const std::size_t size : {1, 2, 3, 4, 5, 8, 9, 300}) {
    const StructureProfile profile = profile_of(Built(StructureKind::kd_sah, stacked(size)).table);
    const std::size_t last = profile.leaf_sizes.size() - 1;
    EXPECT_LE(leaf_size_range(last)[0], size);
    EXPECT_GE(leaf_size_range(last)[1], size);
    EXPECT_EQ(profile.leaf_sizes[last], 1U);
  }
}

}  // namespace
}  // namespace encore::accel::test
