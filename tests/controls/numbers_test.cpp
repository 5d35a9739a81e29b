// Numbers that start long work take effect once, when the mouse lets go, and within their range.
#include "tests/controls/column.h"

namespace encore::ui {
namespace {

using accel::StructureKind;

TEST_F(Column, ADragOfAParameterTakesEffectOnceAtItsEnd) {
  use(left(), StructureKind::kd_sah);
  ASSERT_TRUE(shown("settings.left.kd.depth_offset"));
  const MappedWidget slider = *find("settings.left.kd.depth_offset");
  const auto& kd = std::get<accel::KdTreeSettings>(left().structure.settings);
  const float y = slider.y + slider.height * 0.5F;
  move_to(slider.x + slider.width * 0.3F, y);
  press(true);
  int changes = 0;
  float last = kd.depth_offset;
  const auto look = [&] {
    if (kd.depth_offset != last) ++changes;
    last = kd.depth_offset;
  };
  for (int step = 3; step <= 9; ++step) {
    move_to(slider.x + slider.width * float(step) * 0.1F, y);
    look();
  }
  EXPECT_EQ(changes, 0);
  EXPECT_EQ(kd.depth_offset, accel::KdTreeSettings{}.depth_offset);
  press(false);
  look();
  frame();
  look();
  EXPECT_EQ(changes, 1);
  EXPECT_GT(kd.depth_offset, 48.0F);
  EXPECT_LE(kd.depth_offset, 60.0F);
}

TEST_F(Column, AClickWithoutChangeChangesNothing) {
  use(left(), StructureKind::kd_sah);
  const accel::StructureSpec before = left().structure;
  click("settings.left.parameters", 0, 0.3F);
  EXPECT_FALSE(shown("settings.left.kd.depth_offset"));
  EXPECT_EQ(left().structure, before);
}

TEST_F(Column, ParametersGoBackToTheirUsualValues) {
  use(left(), StructureKind::grid_exact);
  EXPECT_FALSE(shown("settings.left.grid.cells_per_axis.reset"));
  std::get<accel::GridSettings>(left().structure.settings).cells_per_axis = 77;
  click("settings.left.grid.cells_per_axis.reset");
  EXPECT_EQ(left().structure, accel::default_spec(StructureKind::grid_exact));
  EXPECT_FALSE(shown("settings.left.grid.cells_per_axis.reset"));
  EXPECT_EQ(find("settings.left.grid.cells_per_axis")->state, "automatic");
}

TEST_F(Column, TypedNumbersStayInTheirRange) {
  use(left(), StructureKind::grid_exact);
  const auto& grid = std::get<accel::GridSettings>(left().structure.settings);
  enter_number("settings.left.grid.cells_per_axis", "512");  // more than the slider reaches
  EXPECT_EQ(grid.cells_per_axis, 512);
  enter_number("settings.left.grid.cells_per_axis", "5000");
  EXPECT_EQ(grid.cells_per_axis, 1024);
  enter_number("settings.left.grid.cells_per_axis", "-3");
  EXPECT_EQ(grid.cells_per_axis, 0);
}

TEST_F(Column, CustomSizesAreClamped) {
  choose("settings.left.size", "custom");
  enter_number("settings.left.width", "20000");
  EXPECT_EQ(left().custom_width, 16384);
  enter_number("settings.left.height", "0");
  EXPECT_EQ(left().custom_height, 1);
  enter_number("settings.left.width", "800");
  EXPECT_EQ(left().custom_width, 800);
}

TEST_F(Column, ATypedSizeTakesEffectOnLeavingTheField) {
  left().size = SizeChoice::custom;
  click("settings.left.width");
  ImGui::GetIO().KeyCtrl = false;
  // All of it is replaced: a double click selects it.
  click("settings.left.width");
  type("9");
  EXPECT_EQ(left().custom_width, 640);
  click("settings.left", 0, 0.3F);
  EXPECT_NE(left().custom_width, 640);
  EXPECT_GE(left().custom_width, 1);
  EXPECT_LE(left().custom_width, 16384);
}

TEST_F(Column, SeedsAreWholeNumbersOf64Bits) {
  put_scene("wave", 20'000, true);
  left().policy = accel::Policy::refit;
  auto& bvh = std::get<accel::BvhSettings>(left().structure.settings);
  bvh.update_case = accel::UpdateCase::average;
  enter_number("settings.left.bvh.seed", "18446744073709551615");
  EXPECT_EQ(bvh.seed, ~std::uint64_t{0});
}

TEST_F(Column, BothEndsOfTheDepthsMove) {
  state.settings.overlay.show = true;
  state.settings.overlay.first_depth = 0;
  state.settings.overlay.last_depth = 60;  // deeper than this tree
  auto stats = std::make_shared<accel::BuildStats>();
  stats->max_depth = 20;
  view.panes[0].stats = stats;
  click("settings.overlay", 0, 0.3F);
  ASSERT_TRUE(shown("settings.overlay.depths.high"));
  EXPECT_EQ(state.settings.overlay.last_depth, 60);  // nothing was touched
  const MappedWidget track = *find("settings.overlay.depths");
  const auto drag = [&](const std::string& end, float share) {
    const MappedWidget grab = *find(end);
    const float y = grab.y + grab.height * 0.5F;
    move_to(grab.x + grab.width * 0.5F, y);
    press(true);
    move_to(track.x + track.width * share, y);
    press(false);
    frame();
  };
  drag("settings.overlay.depths.high", 0.5F);
  EXPECT_NEAR(state.settings.overlay.last_depth, 10, 1);
  drag("settings.overlay.depths.low", 0.9F);  // not past the other end
  EXPECT_EQ(state.settings.overlay.first_depth, state.settings.overlay.last_depth);
  drag("settings.overlay.depths.low", -2.0F);
  EXPECT_EQ(state.settings.overlay.first_depth, 0);
}

TEST_F(Column, TheTimeFollowsTheSliderAtOnce) {
  put_scene("wave", 20'000, true);
  ASSERT_TRUE(shown("settings.animation.time"));
  const MappedWidget slider = *find("settings.animation.time");
  move_to(slider.x + slider.width * 0.5F, slider.y + slider.height * 0.5F);
  press(true);
  frame();
  EXPECT_NEAR(state.time_s, 2.0, 0.1);
  press(false);
  click("settings.animation.forward");
  EXPECT_NEAR(state.time_s, 2.0 + 1.0 / 30.0, 0.1);
  click("settings.animation.play");
  EXPECT_TRUE(state.settings.animation.playing);
}

TEST_F(Column, ARangeByHandBeginsAsItWas) {
  left().content = PaneContent::heatmap;
  HeatmapView heatmap;
  heatmap.max = 90.0;
  heatmap.high = 64.0;
  heatmap.unit = "steps";
  view.panes[0].heatmap = heatmap;
  click("settings.heatmap.automatic", 0, 0.1F);
  EXPECT_FALSE(state.settings.heatmap.automatic_range);
  EXPECT_EQ(state.settings.heatmap.high, 64.0F);
  EXPECT_TRUE(shown("settings.heatmap.range.low"));
}

}  // namespace
}  // namespace encore::ui
