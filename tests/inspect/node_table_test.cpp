// The table holds exactly what visit() shows, its subtrees are what the depths say, and the
// triangles of every leaf can be had.
#include "accel/inspect/node_table.h"

#include "built.h"

#include <algorithm>
#include <atomic>

namespace encore::accel::test {
namespace {

TEST(NodeTable, HoldsWhatVisitShows) {
  for_all_structures(inspected_scenes(), [](const Built& built) {
    std::uint32_t i = 0;
    built.structure->visit([&](const NodeView& view) {
      if (i >= built.table.size()) {
        ADD_FAILURE() << "too few nodes";
        return false;
      }
      const NodeRecord& node = built.table[i];
      EXPECT_EQ(node.bounds, view.bounds);
      EXPECT_EQ(node.depth, view.depth);
      EXPECT_EQ(node.leaf, view.leaf);
      EXPECT_EQ(int{node.split_axis}, view.split_axis);
      EXPECT_EQ(node.split_position, view.split_position);
      EXPECT_EQ(built.table.index_of(view.place), i);
      const auto triangles = built.table.triangles_of(*built.structure, i);
      EXPECT_TRUE(triangles && std::ranges::equal(*triangles, view.triangles)) << "node " << i;
      ++i;
      return true;
    });
    EXPECT_EQ(i, built.table.size());
  });
}

TEST(NodeTable, SubtreesAreContiguousAndSumTheirTriangles) {
  for_all_structures(inspected_scenes(), [](const Built& built) {
    const NodeTable& table = built.table;
    std::uint64_t references = 0;
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      const NodeRecord& node = table[i];
      // By hand: all that follows deeper than this one, up to the first that is not.
      std::uint32_t end = i + 1;
      std::uint64_t below = node.leaf ? node.triangles : 0;
      while (!node.leaf && end < table.size() && table[end].depth > node.depth) {
        below += table[end].leaf ? table[end].triangles : 0;
        ++end;
        if (end - i > 5000) break;  // large ones are covered by what is below them
      }
      if (end - i <= 5000) {
        EXPECT_EQ(node.subtree_end, end);
        EXPECT_EQ(node.triangles, below);
      }
      references += node.leaf ? node.triangles : 0;
      EXPECT_EQ(node.parent == kNoNode, node.depth == 0);
      if (node.parent == kNoNode) continue;
      EXPECT_EQ(table[node.parent].depth + 1, int{node.depth});
      EXPECT_LT(node.parent, i);
      EXPECT_LE(node.subtree_end, table[node.parent].subtree_end);
    }
    const BuildStats stats = built.structure->stats();
    EXPECT_EQ(references, stats.references);
    EXPECT_EQ(table.max_depth(), stats.max_depth);
    EXPECT_EQ(table.bounds(), encore::test::bounds_of_all(built.triangles));
  });
}

TEST(NodeTable, KnowsWhatItsNodesAre) {
  const Triangles triangles = soup(100, 1.0F, 3);
  EXPECT_EQ(Built(StructureKind::brute, triangles).table.kind(), NodeKind::list);
  EXPECT_EQ(Built(StructureKind::bvh_median, triangles).table.kind(), NodeKind::boxes);
  EXPECT_EQ(Built(StructureKind::kd_median, triangles).table.kind(), NodeKind::split_planes);
  EXPECT_EQ(Built(StructureKind::kd_sah, triangles).table.kind(), NodeKind::split_planes);
  EXPECT_EQ(Built(StructureKind::grid_box, triangles).table.kind(), NodeKind::cells);
  const Built grid(StructureKind::grid_exact, triangles);
  EXPECT_EQ(grid.table.kind(), NodeKind::cells);
  EXPECT_EQ(grid.table.cells(), grid.structure->stats().grid_size);
}

TEST(NodeTable, EmptyCellsHaveNoNode) {
  const Built grid(StructureKind::grid_exact, soup(100, 0.2F, 4));
  const auto cells = grid.table.cells()[0] * grid.table.cells()[1] * grid.table.cells()[2];
  std::uint32_t found = 0;
  for (std::uint32_t place = 0; place < cells; ++place) {
    found += grid.table.index_of(place) != kNoNode ? 1 : 0;
  }
  EXPECT_EQ(found, grid.table.size());
  EXPECT_LT(found, cells);
  EXPECT_EQ(grid.table.index_of(cells), kNoNode);
}

TEST(NodeTable, TakesAtMost64BytesANode) {
  for (const StructureKind kind : all_structure_kinds()) {
    if (kind == StructureKind::brute) continue;
    const Built built(kind, sample("toys"));
    EXPECT_GE(built.table.bytes(), std::uint64_t{48} * built.table.size()) << to_string(kind);
    EXPECT_LE(built.table.bytes(), std::uint64_t{64} * built.table.size()) << to_string(kind);
  }
}

TEST(NodeTable, EndsWhenCancelled) {
  const Built built(StructureKind::bvh_median, soup(100, 1.0F, 5));
  const std::atomic<bool> yes = true;
  const NodeTable none = NodeTable::make(*built.structure, &yes);
  EXPECT_TRUE(none.cancelled());
  EXPECT_TRUE(none.empty());
  const std::atomic<bool> no = false;
  const NodeTable all = NodeTable::make(*built.structure, &no);
  EXPECT_FALSE(all.cancelled());
  EXPECT_EQ(all.size(), built.table.size());
}

TEST(NodeTable, RefusesTheReferencesOfAnotherBuild) {
  for (const StructureKind kind : {StructureKind::kd_sah, StructureKind::grid_box}) {
    Built built(kind, soup(200, 1.0F, 6));
    std::uint32_t leaf = 0;
    while (!built.table[leaf].leaf || built.table[leaf].triangles == 0) ++leaf;
    EXPECT_TRUE(built.table.triangles_of(*built.structure, leaf));
    EXPECT_TRUE(built.table.triangles_below(*built.structure, 0));
    built.triangles = soup(200, 1.0F, 7);
    built.structure->build(built.triangles);
    EXPECT_FALSE(built.table.triangles_of(*built.structure, leaf));
    EXPECT_FALSE(built.table.triangles_below(*built.structure, 0));
  }
}

TEST(NodeTable, FindsAllTrianglesBelowANodeOnce) {
  for_all_structures({{"soup", soup(300, 2.0F, 8)}, {"toys", sample("toys")}},
                     [](const Built& built) {
                       if (built.table.kind() == NodeKind::cells) return;
                       const auto below = built.table.triangles_below(*built.structure, 0);
                       ASSERT_TRUE(below);
                       ASSERT_EQ(below->size(), built.triangles.size());
                       for (std::uint32_t i = 0; i < below->size(); ++i) EXPECT_EQ((*below)[i], i);
                       const auto few = built.table.triangles_below(*built.structure, 0, 10);
                       EXPECT_LE(few->size(), 10U);
                     });
}

TEST(NodeTable, PathsLeadFromTheRoot) {
  const Built built(StructureKind::kd_sah, sample("toys"));
  for (const std::uint32_t node : {0U, 1U, built.table.size() / 2, built.table.size() - 1}) {
    const auto path = path_to_root(built.table, node);
    ASSERT_EQ(path.size(), std::size_t{built.table[node].depth} + 1);
    EXPECT_EQ(path.front(), 0U);
    EXPECT_EQ(path.back(), node);
    for (std::size_t i = 1; i < path.size(); ++i) {
      EXPECT_EQ(built.table[path[i]].parent, path[i - 1]);
    }
  }
}

TEST(NodeTable, AStructureThatWasNeverBuiltHasAnEmptyTable) {
  for (const StructureKind kind : all_structure_kinds()) {
    if (kind == StructureKind::brute) continue;  // always one leaf
    const auto structure = make_structure(default_spec(kind));
    EXPECT_TRUE(NodeTable::make(*structure).empty()) << to_string(kind);
  }
  EXPECT_TRUE(NodeTable().empty());
}

}  // namespace
}  // namespace encore::accel::test
