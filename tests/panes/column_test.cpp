// The structure's column follows what is picked and selected elsewhere, and steps along a ray.
#include "accel/inspect/ray_path.h"
#include "scene/camera_motion.h"
#include "window.h"

#include <fmt/format.h>

namespace encore::ui::test {
namespace {

class Column : public Window {
 protected:
  Column() : built_(accel::StructureKind::bvh_median) {
    built_.fill(view_.panes[0]);
    draw_ = [this] {
      draw_structure_column({0.0F, 0.0F, 420.0F, 860.0F}, view_, state_, commands_);
    };
  }

  void pick() {
    scene::Ray ray;
    ray.origin = {0.0F, 0.0F, 25.0F};
    ray.direction = {0.0F, -0.05F, -1.0F};
    scene::Hit hit;
    auto path = std::make_shared<accel::RayPath>();
    built_.structure->trace_path(ray, hit, *path);
    PickView pick;
    pick.pixel.x = 160;
    pick.pixel.y = 120;
    for (const accel::RayStep& step : path->steps) {
      pick.sentences.push_back(accel::describe(step, *built_.nodes));
      const std::uint32_t node =
          step.place == scene::kNoHit ? accel::kNoNode : built_.nodes->index_of(step.place);
      pick.nodes.push_back(node == accel::kNoNode ? std::nullopt : std::optional(node));
    }
    pick.path = std::move(path);
    ASSERT_GT(pick.sentences.size(), 10U);
    view_.pick = std::move(pick);
  }

  Built built_;
};

TEST_F(Column, StatisticsAreThoseOfTheStructure) {
  frames(2);
  const accel::BuildStats stats = built_.structure->stats();
  EXPECT_EQ(shown("structure.tab.statistics"), "on");
  EXPECT_EQ(shown("statistics.triangles.value"), "11,141");
  EXPECT_EQ(shown("statistics.depth.value"), fmt::format("{}", stats.max_depth));
  EXPECT_EQ(shown("statistics.sah_cost.value"), fmt::format("{:.4g}", stats.sah_cost));
  EXPECT_FALSE(find("statistics.cells")) << "a tree has no cells";
  EXPECT_FALSE(find("statistics.sah_decay")) << "not known";
  EXPECT_FALSE(find("statistics.nodes.other")) << "nothing to compare with";
  EXPECT_EQ(shown("statistics.depths"), fmt::format("{}", stats.max_depth + 1));
}

TEST_F(Column, TwoStructuresStandSideBySide) {
  const Built other(accel::StructureKind::grid_exact);
  other.fill(view_.panes[1]);
  state_.settings.panes[1].structure = accel::default_spec(accel::StructureKind::grid_exact);
  frames(2);
  const double mine = static_cast<double>(built_.structure->stats().references);
  const double theirs = static_cast<double>(other.structure->stats().references);
  EXPECT_EQ(shown("statistics.references.difference"),
            fmt::format("{:+.1f} %", (theirs - mine) / mine * 100.0));
  EXPECT_EQ(shown("statistics.nodes.other"), "–") << "a grid has none";
  EXPECT_EQ(shown("statistics.cells.value"), "–");
  // The same structure in both is not compared.
  state_.settings.panes[1] = state_.settings.panes[0];
  frames(2);
  EXPECT_FALSE(find("statistics.references.other"));
}

TEST_F(Column, TwoStructuresFitANarrowColumn) {
  const Built other(accel::StructureKind::grid_exact);
  other.fill(view_.panes[1]);
  state_.settings.panes[1].structure = accel::default_spec(accel::StructureKind::grid_exact);
  accel::BuildStats many = *view_.panes[0].stats;
  many.allocations = 1'087'716'123;
  view_.panes[0].stats = std::make_shared<const accel::BuildStats>(many);
  const float width = 19.0F * ImGui::GetIO().Fonts->Fonts[0]->FontSize;
  draw_ = [this, width] {
    draw_structure_column({0.0F, 0.0F, width, 860.0F}, view_, state_, commands_);
  };
  frames(3);
  EXPECT_EQ(shown("statistics.compared"), "CPU bvh-median, and GPU grid-exact against it");
  EXPECT_EQ(shown("statistics.triangles.value"), "11,141");
  EXPECT_EQ(shown("statistics.triangles.difference"), "same");
  EXPECT_EQ(shown("statistics.allocations.value"), "1.09 G") << "shorter, not cut";
  EXPECT_EQ(shown("statistics.nodes.difference"), "–") << "a grid has none";
  EXPECT_EQ(shown("statistics.cells.value"), "–");
  EXPECT_NE(shown("statistics.cells.other"), "not there") << "in the place of the difference";
  for (const MappedWidget& widget : widget_map()) {
    if (!widget.name.starts_with("statistics.")) continue;
    EXPECT_LE(widget.x + widget.width, width) << widget.name;
    if (!widget.name.ends_with(".value")) continue;
    const auto difference = find(widget.name.substr(0, widget.name.size() - 5) + "difference");
    if (difference) {
      EXPECT_LE(widget.x + widget.width, difference->x) << widget.name;
    }
    EXPECT_EQ(widget.state.find("…"), std::string::npos) << widget.name << " " << widget.state;
  }
}

TEST_F(Column, AMissingStructureSaysSo) {
  view_.panes[0] = PaneView{};
  frames(2);
  EXPECT_NE(shown("statistics.none"), "not there");
}

TEST_F(Column, ARayOpensItsTabAndSteps) {
  frames(2);
  pick();
  frames(3);
  EXPECT_EQ(shown("structure.tab.ray"), "on");
  EXPECT_EQ(shown("ray.summary"), "Pixel 160, 120: " + accel::summary(*view_.pick->path));
  EXPECT_EQ(shown("ray.step.0"), "selected");
  click("ray.next");
  EXPECT_EQ(state_.ray_step, 1U);
  key(kRightKey);
  EXPECT_EQ(state_.ray_step, 2U);
  EXPECT_EQ(state_.selected_node, view_.pick->nodes[2]);
  key(kLeftKey);
  EXPECT_EQ(state_.ray_step, 1U);
  click("ray.last");
  EXPECT_EQ(state_.ray_step, view_.pick->sentences.size() - 1);
  key(kRightKey);
  EXPECT_EQ(state_.ray_step, view_.pick->sentences.size() - 1) << "there is none after it";
  frames(2);
  EXPECT_EQ(shown(fmt::format("ray.step.{}", state_.ray_step)), "selected") << "in sight";
  click("ray.first");
  EXPECT_EQ(state_.ray_step, 0U);
  EXPECT_EQ(shown("structure.tab.ray"), "on") << "selecting a step's node stays here";
}

TEST_F(Column, AStepIsClickedAndTheRayCopied) {
  pick();
  frames(4);
  std::size_t step = 1;
  while (step < 8 && !view_.pick->nodes[step]) ++step;
  click(fmt::format("ray.step.{}", step));
  EXPECT_EQ(state_.ray_step, step);
  EXPECT_EQ(state_.selected_node, view_.pick->nodes[step]);
  click("ray.copy");
  ASSERT_EQ(asked<CopyText>().size(), 1U);
  EXPECT_NE(asked<CopyText>()[0].text.find(view_.pick->sentences.back()), std::string::npos);
  click("ray.clear");
  EXPECT_EQ(asked<ClearPick>().size(), 1U);
}

TEST_F(Column, ArrowsStayWithATextThatIsTyped) {
  pick();
  frames(4);
  ImGui::GetIO().WantTextInput = true;
  const auto draw = draw_;
  draw_ = [&] {
    ImGui::GetIO().WantTextInput = true;
    draw();
  };
  key(kRightKey);
  EXPECT_EQ(state_.ray_step, 0U);
}

TEST_F(Column, ANodeSelectedElsewhereOpensItsTab) {
  frames(2);
  const std::uint32_t node = (*built_.nodes)[0].subtree_end / 2;
  state_.selected_node = node;
  frames(3);
  EXPECT_EQ(shown("structure.tab.selection"), "on");
  const accel::NodeRecord& record = (*built_.nodes)[node];
  EXPECT_EQ(shown("selection.depth"), fmt::format("{}", record.depth));
  EXPECT_EQ(shown("selection.path.0"), "0");
  click("selection.parent");
  EXPECT_EQ(state_.selected_node, record.parent);
  frames(2);
  click("selection.left");
  EXPECT_EQ(state_.selected_node, record.parent + 1);
  click("selection.path.0");
  EXPECT_EQ(state_.selected_node, 0U);
}

TEST_F(Column, FocusMovesTheCameraThatIsInUse) {
  state_.selected_node = 5;
  state_.picture_areas[0] = {320, 240};
  frames(3);
  const scene::Camera expected =
      scene::focus(state_.camera, (*built_.nodes)[5].bounds, 320.0 / 240.0);
  click("selection.focus");
  EXPECT_EQ(state_.camera, expected);
  state_.structure_view = true;
  state_.free_camera = scene::Camera{};
  state_.picture_areas[kPaneCount] = {100, 100};
  click("selection.focus");
  EXPECT_EQ(state_.camera, expected) << "the panes' camera stays";
  EXPECT_EQ(*state_.free_camera, scene::focus({}, (*built_.nodes)[5].bounds, 1.0));
}

TEST_F(Column, OnlyTheSubtreeTurnsTheOverlayOn) {
  state_.selected_node = 5;
  state_.settings.overlay.show = false;
  frames(3);
  click("selection.subtree");
  EXPECT_TRUE(state_.settings.overlay.selected_subtree);
  EXPECT_TRUE(state_.settings.overlay.show);
}

TEST_F(Column, TheOtherPaneIsInspectedOnDemand) {
  state_.selected_node = 5;
  frames(2);
  click("structure.pane.1");
  EXPECT_EQ(state_.inspected_pane, 1U);
  EXPECT_FALSE(state_.selected_node) << "it was the other table's";
  state_.settings.panes[1].device = PaneDevice::raster;
  frames(2);
  EXPECT_EQ(state_.inspected_pane, 0U) << "a rasteriser has no structure";
}

}  // namespace
}  // namespace encore::ui::test
