// What does not apply to the scene, the device or the structure is not there.
#include "accel/inspect/node_measures.h"
#include "accel/inspect/node_table.h"
#include "tests/controls/column.h"

namespace encore::ui {
namespace {

using accel::Policy;
using accel::StructureKind;

TEST_F(Column, ShowsParametersOfTheStructuresKindOnly) {
  right().device = PaneDevice::off;
  for (const StructureKind kind : accel::all_structure_kinds()) {
    SCOPED_TRACE(std::string(accel::to_string(kind)));
    use(left(), kind);
    const bool grid = kind == StructureKind::grid_exact || kind == StructureKind::grid_box;
    const bool sah = kind == StructureKind::kd_sah;
    const bool kd = sah || kind == StructureKind::kd_median;
    EXPECT_EQ(shown("settings.left.grid.cells_per_axis"), grid);
    EXPECT_EQ(shown("settings.left.grid.density"), grid);
    EXPECT_EQ(shown("settings.left.kd.depth_offset"), kd);
    EXPECT_EQ(shown("settings.left.kd.bad_split_margin"), kd);
    EXPECT_EQ(shown("settings.left.kd.traversal_cost"), sah);
    EXPECT_EQ(shown("settings.left.kd.empty_bonus"), sah);
    EXPECT_FALSE(shown("settings.left.bvh.update_case"));  // nothing moves
    EXPECT_EQ(shown("settings.left.memory"), kind != StructureKind::brute);
  }
}

TEST_F(Column, DensityIsOfTheAutomaticNumberOfCells) {
  use(left(), StructureKind::grid_exact);
  std::get<accel::GridSettings>(left().structure.settings).cells_per_axis = 12;
  EXPECT_TRUE(shown("settings.left.grid.cells_per_axis"));
  EXPECT_FALSE(shown("settings.left.grid.density"));
}

TEST_F(Column, PoliciesAreForScenesThatMove) {
  EXPECT_FALSE(shown("settings.left.policy"));
  EXPECT_FALSE(shown("settings.animation"));
  EXPECT_TRUE(shown("settings.measure.forced"));
  state.settings.measure.forced = true;
  EXPECT_TRUE(shown("settings.left.policy"));
  state.settings.measure.forced = false;
  put_scene("wave", 20'000, true);
  EXPECT_TRUE(shown("settings.left.policy"));
  EXPECT_TRUE(shown("settings.animation.time"));
  EXPECT_FALSE(shown("settings.measure.forced"));
}

TEST_F(Column, RefittingIsForHierarchies) {
  put_scene("wave", 20'000, true);
  click("settings.left.policy");
  EXPECT_TRUE(find("settings.left.policy.refit").has_value());
  EXPECT_TRUE(find("settings.left.policy.auto").has_value());
  click("settings.left.policy.refit");
  EXPECT_TRUE(shown("settings.left.bvh.update_case"));
  EXPECT_FALSE(shown("settings.left.bvh.seed"));
  EXPECT_FALSE(shown("settings.left.bvh.rebuild_at"));
  std::get<accel::BvhSettings>(left().structure.settings).update_case = accel::UpdateCase::average;
  EXPECT_TRUE(shown("settings.left.bvh.seed"));
  left().policy = Policy::automatic;
  EXPECT_TRUE(shown("settings.left.bvh.rebuild_at"));
  use(left(), StructureKind::kd_sah);
  click("settings.left.policy");
  EXPECT_TRUE(find("settings.left.policy.rebuild").has_value());
  EXPECT_TRUE(find("settings.left.policy.static").has_value());
  EXPECT_FALSE(find("settings.left.policy.refit").has_value());
  EXPECT_FALSE(find("settings.left.policy.auto").has_value());
}

TEST_F(Column, DevicesHaveWhatIsTheirs) {
  EXPECT_TRUE(shown("settings.left.threads"));
  EXPECT_FALSE(shown("settings.right.threads"));
  EXPECT_TRUE(shown("settings.right.kind"));
  right().device = PaneDevice::raster;
  EXPECT_FALSE(shown("settings.right.kind"));
  EXPECT_FALSE(shown("settings.right.memory"));
  EXPECT_FALSE(shown("settings.right.rebuild"));
  EXPECT_TRUE(shown("settings.right.size"));
  right().device = PaneDevice::off;
  EXPECT_TRUE(shown("settings.right.device"));
  EXPECT_FALSE(shown("settings.right.size"));
  EXPECT_FALSE(shown("settings.right.content"));
  left().device = PaneDevice::raster;
  EXPECT_FALSE(shown("settings.overlay"));
}

TEST_F(Column, WhereTreesAreBuiltIsAskedWhereTheDeviceCan) {
  right().structure = accel::default_spec(StructureKind::bvh_sah);
  auto& preset = std::get<accel::BvhSettings>(right().structure.settings).preset;
  preset = accel::BuildPreset::fast;
  EXPECT_FALSE(shown("settings.right.build_on")) << "the scene stands still";
  put_scene("toys", 11'141, true);
  choose("settings.right.build_on", "device");
  EXPECT_EQ(right().build_on, accel::BuildPlace::device);
  right().policy = Policy::refit;
  EXPECT_FALSE(shown("settings.right.build_on"));
  right().policy = Policy::rebuild;
  preset = accel::BuildPreset::balanced;
  EXPECT_FALSE(shown("settings.right.build_on"));
  preset = accel::BuildPreset::fast;
  right().device = PaneDevice::cpu;
  EXPECT_FALSE(shown("settings.right.build_on"));
}

TEST_F(Column, BruteForceIsForTinyScenes) {
  click("settings.left.kind");
  EXPECT_TRUE(find("settings.left.kind.kd-sah").has_value());
  EXPECT_FALSE(find("settings.left.kind.brute").has_value());
  click("settings.left.kind.kd-sah");
  put_scene("triangle", 1, false);
  click("settings.left.kind");
  EXPECT_TRUE(find("settings.left.kind.brute").has_value());
}

TEST_F(Column, TheHeatmapIsThereWhereOneIsShown) {
  EXPECT_FALSE(shown("settings.heatmap"));
  left().content = PaneContent::heatmap;
  EXPECT_TRUE(shown("settings.heatmap.cost"));
  EXPECT_FALSE(shown("settings.heatmap.step_weight"));
  EXPECT_FALSE(shown("settings.heatmap.range"));
  state.settings.heatmap.cost = HeatmapCost::energy;
  state.settings.heatmap.automatic_range = false;
  EXPECT_TRUE(shown("settings.heatmap.step_weight"));
  EXPECT_TRUE(shown("settings.heatmap.range"));
  use(left(), StructureKind::grid_exact);
  click("settings.heatmap.cost");
  EXPECT_TRUE(find("settings.heatmap.cost.steps").has_value());
  EXPECT_FALSE(find("settings.heatmap.cost.box tests").has_value());
}

TEST_F(Column, TheOverlayFollowsTheStructures) {
  click("settings.overlay", 0, 0.3F);
  EXPECT_FALSE(shown("settings.overlay.color"));
  state.settings.overlay.show = true;
  auto stats = std::make_shared<accel::BuildStats>();
  stats->max_depth = 21;
  view.panes[0].stats = view.panes[1].stats = stats;
  EXPECT_TRUE(shown("settings.overlay.depths"));
  EXPECT_FALSE(shown("settings.overlay.planes"));
  use(left(), StructureKind::kd_median);
  EXPECT_TRUE(shown("settings.overlay.planes"));
  EXPECT_TRUE(shown("settings.overlay.empty"));
  use(left(), StructureKind::grid_exact);
  use(right(), StructureKind::grid_box);
  EXPECT_FALSE(shown("settings.overlay.depths"));
  EXPECT_FALSE(shown("settings.overlay.leaves"));
  EXPECT_FALSE(shown("settings.overlay.subtree"));
  state.settings.overlay.color = OverlayColor::leaf_size;
  click("settings.overlay.color");
  EXPECT_TRUE(find("settings.overlay.color.SAH share").has_value());
  EXPECT_FALSE(find("settings.overlay.color.overlap").has_value());
  EXPECT_FALSE(find("settings.overlay.color.decay").has_value());
  EXPECT_FALSE(find("settings.overlay.color.depth").has_value());
  click("settings.overlay.color.leaf size");
  auto values = std::make_shared<accel::NodeValues>();
  values->count = 3;
  values->percentile_99 = 12.0F;
  view.panes[0].node_values = values;
  ASSERT_TRUE(shown("settings.overlay.legend"));
  EXPECT_EQ(find("settings.overlay.legend")->state, "0 … 12");
}

TEST_F(Column, SectionsRememberThatTheyWereClosed) {
  EXPECT_TRUE(shown("settings.left.kind"));
  click("settings.left", 0, 0.3F);
  EXPECT_FALSE(shown("settings.left.kind"));
  EXPECT_EQ(find("settings.left")->state, "closed");
  left().device = PaneDevice::gpu;  // another title, the same section
  EXPECT_FALSE(shown("settings.left.kind"));
}

}  // namespace
}  // namespace encore::ui
