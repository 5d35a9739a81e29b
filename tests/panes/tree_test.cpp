// The list of nodes: what is open and nothing else, also for millions; clicks select, and what is
// selected elsewhere comes into sight.
#include "ui/panels/tree_rows.h"
#include "window.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <set>

namespace encore::ui::test {
namespace {

/// Rows by the definition: a node shows if all above it are open.
std::vector<std::uint32_t> slow_rows(const accel::NodeTable& table,
                                     const std::set<std::uint32_t>& open) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    bool shows = true;
    for (std::uint32_t up = table[i].parent; up != accel::kNoNode; up = table[up].parent) {
      shows = shows && open.contains(up);
    }
    if (shows) rows.push_back(i);
  }
  return rows;
}

TEST(TreeRows, AreTheNodesWhoseAncestorsAreAllOpen) {
  for (const auto kind : {accel::StructureKind::bvh_median, accel::StructureKind::kd_median}) {
    const Built built(kind);
    std::mt19937 random(7);
    for (int round = 0; round < 5; ++round) {
      std::set<std::uint32_t> open;
      for (std::uint32_t i = 0; i < built.nodes->size(); ++i) {
        if (random() % 4 != 0) open.insert(i);
      }
      EXPECT_EQ(tree_rows(*built.nodes, open), slow_rows(*built.nodes, open));
    }
    EXPECT_EQ(tree_rows(*built.nodes, {}), std::vector<std::uint32_t>{0});
  }
}

TEST(TreeRows, CellsComeByOccupancy) {
  const Built built(accel::StructureKind::grid_exact);
  const auto rows = tree_rows(*built.nodes, {});
  ASSERT_EQ(rows.size(), built.nodes->size());
  EXPECT_EQ(std::set<std::uint32_t>(rows.begin(), rows.end()).size(), rows.size());
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end(), [&](auto a, auto b) {
    const auto left = (*built.nodes)[a].triangles;
    const auto right = (*built.nodes)[b].triangles;
    return left != right ? left > right : a < b;
  }));
}

TEST(TreeRows, SharesOfTheSahCostAreThoseOfTheMeasure) {
  for (const auto kind : accel::all_structure_kinds()) {
    const Built built(kind);
    const auto measure = accel::measure_nodes(*built.nodes, accel::NodeMeasure::sah_share);
    const double cost = built.structure->stats().sah_cost;
    for (std::uint32_t i = 0; i < built.nodes->size(); i += 7) {
      const auto share = sah_share(*built.nodes, i, cost);
      ASSERT_TRUE(share) << accel::to_string(kind);
      EXPECT_NEAR(*share, double(measure.values[i]), 1e-5 * double(measure.values[i]) + 1e-12)
          << accel::to_string(kind) << " node " << i;
    }
  }
}

/// A full binary tree of a given depth, which no triangles are needed for.
class DeepTree final : public accel::AccelerationStructure {
 public:
  explicit DeepTree(std::uint32_t depth) : depth_(depth) {}
  [[nodiscard]] std::string_view name() const override { return "deep"; }
  void build(std::span<const scene::Triangle> /*triangles*/) override {}
  void intersect(std::span<const scene::Ray> /*rays*/,
                 std::span<scene::Hit> /*hits*/) const override {}
  void intersect_counted(std::span<const scene::Ray> /*rays*/, std::span<scene::Hit> /*hits*/,
                         std::span<accel::TraceCounters> /*counters*/) const override {}
  void occluded(std::span<const scene::Ray> /*rays*/,
                std::span<std::uint8_t> /*blocked*/) const override {}
  [[nodiscard]] accel::BuildStats stats() const override {
    accel::BuildStats stats;
    stats.nodes = (std::uint64_t{2} << depth_) - 1;
    return stats;
  }
  [[nodiscard]] accel::GpuBuffers gpu_buffers() const override { return {}; }
  void visit(const std::function<bool(const accel::NodeView&)>& visitor) const override {
    std::uint32_t place = 0;
    visit(visitor, 0, place);
  }

 private:
  void visit(const std::function<bool(const accel::NodeView&)>& visitor, std::uint32_t depth,
             std::uint32_t& place) const {
    accel::NodeView view;
    view.bounds = scene::Bounds{{0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}};
    view.depth = depth;
    view.leaf = depth == depth_;
    view.place = place++;
    if (!visitor(view) || view.leaf) return;
    visit(visitor, depth + 1, place);
    visit(visitor, depth + 1, place);
  }
  std::uint32_t depth_;
};

class TreePanel : public Window {
 protected:
  TreePanel() {
    state_.inspect.tab = StructureTab::tree;
    draw_ = [this] {
      draw_structure_column({0.0F, 0.0F, 420.0F, 860.0F}, view_, state_, commands_);
    };
  }
  void open_tree() {
    frames(2);
    click("structure.tab.tree");
    frames(2);
  }
  static std::size_t rows_in_sight() {
    return static_cast<std::size_t>(std::count_if(
        widget_map().begin(), widget_map().end(),
        [](const MappedWidget& widget) { return widget.name.starts_with("tree.node."); }));
  }
};

TEST_F(TreePanel, MillionsOfNodesCostWhatIsOpenAndInSight) {
  const DeepTree tree(20);
  PaneView& pane = view_.panes[0];
  pane.nodes = std::make_shared<const accel::NodeTable>(accel::NodeTable::make(tree));
  pane.stats = std::make_shared<const accel::BuildStats>(tree.stats());
  ASSERT_GT(pane.nodes->size(), 2'000'000U);
  open_tree();
  EXPECT_EQ(state_.inspect.tree.rows.size(), 3U) << "the root is open, its children are not";
  // The deepest node of all brings its path, and no more.
  state_.selected_node = pane.nodes->size() - 1;
  frames(3);
  EXPECT_EQ(state_.inspect.tree.rows.size(), 1U + 2U * 20U);
  EXPECT_EQ(shown(fmt::format("tree.node.{}", pane.nodes->size() - 1)), "selected");
  // Everything of a thousand nodes opened: the rows in sight stay as many as the column holds.
  for (std::uint32_t i = 0; i < 1000; ++i) state_.inspect.tree.open.insert(i);
  state_.inspect.tree.stale = true;
  frames(3);
  EXPECT_GT(state_.inspect.tree.rows.size(), 900U);
  EXPECT_GT(rows_in_sight(), 10U);
  EXPECT_LT(rows_in_sight(), 80U);
  EXPECT_LT(ImGui::GetDrawData()->TotalVtxCount, 20'000);
}

TEST_F(TreePanel, GridsOfManyCellsAreClipped) {
  const Built built(accel::StructureKind::grid_exact);
  built.fill(view_.panes[0]);
  ASSERT_GT(built.nodes->size(), 1000U);
  open_tree();
  EXPECT_EQ(state_.inspect.tree.rows.size(), built.nodes->size());
  EXPECT_GT(rows_in_sight(), 10U);
  EXPECT_LT(rows_in_sight(), 80U);
}

TEST_F(TreePanel, ClickSelectsAndTheArrowOpens) {
  const Built built(accel::StructureKind::bvh_median);
  built.fill(view_.panes[0]);
  open_tree();
  click("tree.node.1");
  EXPECT_EQ(state_.selected_node, 1U);
  EXPECT_FALSE(find("tree.node.2")) << "below a closed node";
  click("tree.arrow.1");
  frames(2);
  EXPECT_TRUE(find("tree.node.2"));
  EXPECT_EQ(state_.selected_node, 1U) << "the arrow does not select";
  click("tree.arrow.1");
  frames(2);
  EXPECT_FALSE(find("tree.node.2"));
  EXPECT_EQ(shown("structure.tab.tree"), "on");
}

TEST_F(TreePanel, SelectionElsewhereOpensItsPathAndScrolls) {
  const Built built(accel::StructureKind::bvh_median);
  built.fill(view_.panes[0]);
  open_tree();
  std::uint32_t deepest = 0;
  for (std::uint32_t i = 0; i < built.nodes->size(); ++i) {
    if ((*built.nodes)[i].depth > (*built.nodes)[deepest].depth) deepest = i;
  }
  const std::uint32_t last = built.nodes->size() - 1;
  for (const std::uint32_t node : {deepest, last, deepest}) {
    state_.selected_node = node;
    frames(3);
    EXPECT_EQ(shown(fmt::format("tree.node.{}", node)), "selected");
    for (const std::uint32_t above : accel::path_to_root(*built.nodes, node)) {
      EXPECT_TRUE(above == node || state_.inspect.tree.open.contains(above));
    }
  }
}

TEST_F(TreePanel, ARebuildOfAnotherSizeClosesAllButTheRoot) {
  const Built built(accel::StructureKind::bvh_median);
  built.fill(view_.panes[0]);
  state_.selected_node = built.nodes->size() - 1;
  open_tree();
  EXPECT_GT(state_.inspect.tree.rows.size(), 3U);
  state_.selected_node.reset();
  const Built other(accel::StructureKind::kd_median);
  other.fill(view_.panes[0]);
  frames(2);
  EXPECT_EQ(state_.inspect.tree.rows.size(), 3U);
}

}  // namespace
}  // namespace encore::ui::test
