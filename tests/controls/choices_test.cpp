// What is chosen in the column is what the settings hold.
#include "tests/controls/column.h"

namespace encore::ui {
namespace {

using accel::Policy;
using accel::StructureKind;

TEST_F(Column, ChoosesStructuresAndKeepsParametersOfTheirFamily) {
  use(left(), StructureKind::grid_exact);
  std::get<accel::GridSettings>(left().structure.settings).cells_per_axis = 40;
  left().structure.memory = accel::MemoryMode::fresh;
  choose("settings.left.kind", "grid-box");
  EXPECT_EQ(left().structure.kind, StructureKind::grid_box);
  EXPECT_EQ(std::get<accel::GridSettings>(left().structure.settings).cells_per_axis, 40);
  choose("settings.left.kind", "kd-sah");
  EXPECT_EQ(left().structure.kind, StructureKind::kd_sah);
  EXPECT_EQ(std::get<accel::KdTreeSettings>(left().structure.settings), accel::KdTreeSettings{});
  EXPECT_EQ(left().structure.memory, accel::MemoryMode::fresh);
  EXPECT_EQ(right(), default_settings().panes[1]);
}

TEST_F(Column, ChoosesPoliciesOfTheRightPane) {
  put_scene("wave", 20'000, true);
  choose("settings.right.policy", "auto");
  EXPECT_EQ(right().policy, Policy::automatic);
  choose("settings.right.policy", "static");
  EXPECT_EQ(right().policy, Policy::fixed);
  EXPECT_EQ(left().policy, Policy::rebuild);
}

TEST_F(Column, APolicyThatAStructureCannotFollowIsShownAsARebuildAndComesBack) {
  put_scene("wave", 20'000, true);
  left().policy = Policy::refit;
  choose("settings.left.kind", "kd-median");
  ASSERT_TRUE(shown("settings.left.policy"));
  EXPECT_EQ(find("settings.left.policy")->state, "rebuild");
  choose("settings.left.kind", "bvh-median");
  EXPECT_EQ(find("settings.left.policy")->state, "refit");
  EXPECT_EQ(left().policy, Policy::refit);
}

TEST_F(Column, ChoosesResolutionsMemoryDeviceAndContent) {
  choose("settings.left.size", "512");
  EXPECT_EQ(left().size, SizeChoice::square_512);
  choose("settings.left.memory", "malloc");
  EXPECT_EQ(left().structure.memory, accel::MemoryMode::fresh);
  choose("settings.left.content", "heatmap");
  EXPECT_EQ(left().content, PaneContent::heatmap);
  choose("settings.heatmap.palette", "grey");
  EXPECT_EQ(state.settings.heatmap.palette, 1);
  choose("settings.heatmap.cost", "triangle tests");
  EXPECT_EQ(state.settings.heatmap.cost, HeatmapCost::triangle_tests);
  // A rasteriser traces no rays that could have a heatmap.
  choose("settings.left.device", "raster");
  EXPECT_EQ(left().device, PaneDevice::raster);
  EXPECT_EQ(left().content, PaneContent::picture);
}

TEST_F(Column, CopiesAndSwapsStructures) {
  use(left(), StructureKind::kd_sah);
  right().policy = Policy::refit;
  const PaneSettings was_left = left();
  const PaneSettings was_right = right();
  click("settings.copy.swap");
  EXPECT_EQ(left().structure, was_right.structure);
  EXPECT_EQ(left().policy, was_right.policy);
  EXPECT_EQ(right().structure, was_left.structure);
  EXPECT_EQ(left().device, was_left.device);
  click("settings.copy.to_left");
  EXPECT_EQ(left().structure, was_left.structure);
  EXPECT_EQ(left().policy, was_left.policy);
  EXPECT_FALSE(shown("settings.copy.swap"));  // there is nothing left to copy
}

TEST_F(Column, CameraWidgetsMoveTheCameraAndStoreIt) {
  click("settings.camera", 0, 0.3F);
  choose("settings.camera.up", "z");
  EXPECT_EQ(state.preferences.up_axis, 2);
  click("settings.camera.minus_x");
  EXPECT_NEAR(state.camera.eye.x, 25.0F, 1e-3F);
  EXPECT_NEAR(state.camera.up.z, 1.0F, 1e-5F);
  choose("settings.camera.projection", "orthographic");
  EXPECT_TRUE(state.camera.orthographic());
  click("settings.camera.bookmark.3");
  const scene::Camera stored = state.camera;
  ASSERT_TRUE(state.preferences.bookmarks["toys"][2].has_value());
  click("settings.camera.plus_y");
  ASSERT_NE(state.camera, stored);
  const scene::Camera other = state.camera;
  click("settings.camera.bookmark.3");
  EXPECT_EQ(state.camera, stored);
  state.camera = other;
  click("settings.camera.bookmark.3", 1);
  EXPECT_EQ(state.preferences.bookmarks["toys"][2], other);
}

TEST_F(Column, OverlayAndMeasuringTakeEffect) {
  click("settings.overlay", 0, 0.3F);
  click("settings.overlay.show", 0, 0.1F);
  ASSERT_TRUE(state.settings.overlay.show);
  choose("settings.overlay.color", "overlap");
  EXPECT_EQ(state.settings.overlay.color, OverlayColor::overlap);
  choose("settings.overlay.hidden", "x-ray");
  EXPECT_EQ(state.settings.overlay.hidden, HiddenLines::x_ray);
  click("settings.overlay.section", 0, 0.1F);
  choose("settings.overlay.section_axis", "z");
  EXPECT_EQ(state.settings.overlay.section_axis, 2);
  click("settings.measure.forced", 0, 0.1F);
  EXPECT_TRUE(state.settings.measure.forced);
  click("settings.measure.mode");
  EXPECT_TRUE(state.measuring);
}

}  // namespace
}  // namespace encore::ui
