// The section of rays lists what this scene has a use for, and nothing else.
#include "tests/controls/column.h"

#include <array>

namespace encore::ui {
namespace {

constexpr std::array kNames{"rays.shadows",  "rays.reflections", "rays.refractions",
                            "rays.textures", "rays.depth",       "rays.seed"};

TEST_F(Column, RaysThatASceneHasNoUseForAreNotThere) {
  EXPECT_TRUE(shown("rays.samples"));
  for (const char* name : kNames) EXPECT_FALSE(shown(name)) << name;
  view.scene.could_use.shadows = true;
  EXPECT_TRUE(shown("rays.shadows"));
  EXPECT_FALSE(shown("rays.reflections"));
  view.scene.could_use.textures = true;
  EXPECT_TRUE(shown("rays.textures"));
  view.scene.could_use.reflections = true;
  EXPECT_TRUE(shown("rays.reflections"));
  EXPECT_FALSE(shown("rays.refractions"));
  view.scene.could_use.refractions = true;
  EXPECT_TRUE(shown("rays.refractions"));
}

TEST_F(Column, DepthIsOfRaysThatBounceAndTheSeedOfSeveralSamples) {
  state.settings.rays.reflections = true;
  EXPECT_FALSE(shown("rays.depth")) << "nothing mirrors";
  view.scene.could_use.reflections = true;
  EXPECT_TRUE(shown("rays.depth"));
  state.settings.rays.reflections = false;
  EXPECT_FALSE(shown("rays.depth"));
  EXPECT_FALSE(shown("rays.seed"));
  state.settings.rays.samples = 2;
  EXPECT_TRUE(shown("rays.seed"));
}

TEST_F(Column, RaysAreOfPanesThatTraceThem) {
  for (PaneSettings& pane : state.settings.panes) pane.device = PaneDevice::raster;
  EXPECT_FALSE(shown("settings.rays"));
  EXPECT_FALSE(shown("settings.left.intersection"));
  left().device = PaneDevice::cpu;
  EXPECT_TRUE(shown("settings.rays"));
  EXPECT_TRUE(shown("settings.left.intersection"));
  EXPECT_FALSE(shown("settings.right.intersection"));
}

TEST_F(Column, RaysAreSwitchedForBothPanesAndIntersectionForOne) {
  view.scene.could_use.shadows = true;
  click("rays.shadows", 0, 0.05F);
  EXPECT_TRUE(state.settings.rays.shadows);
  choose("settings.left.intersection", "watertight");
  EXPECT_EQ(left().structure.intersection, accel::IntersectionMode::watertight);
  EXPECT_EQ(right().structure.intersection, accel::IntersectionMode::precise);
}

TEST_F(Column, WhatIsLeftOutIsListedWithItsBytes) {
  EXPECT_FALSE(shown("settings.scene.left_out"));
  view.scene.left_out = {{"vertex colours", "no mesh has any", 3600},
                         {"shadow rays", "switched off", std::nullopt}};
  click("settings.scene.left_out", 0, 0.3F);
  ASSERT_TRUE(shown("settings.scene.left_out.vertex colours"));
  EXPECT_EQ(find("settings.scene.left_out.vertex colours")->state, "3.52 KiB: no mesh has any");
  EXPECT_EQ(find("settings.scene.left_out.shadow rays")->state, "switched off");
}

TEST_F(Column, WhatIsLeftOutSavesIsMeasuredWhenAsked) {
  view.scene.left_out = {{"vertex colours", "no mesh has any", 3600},
                         {"shadow rays", "switched off", std::nullopt}};
  click("settings.scene.left_out", 0, 0.3F);
  click("settings.scene.left_out.measure");
  EXPECT_NE(command<MeasureLeftOut>(), nullptr);
  view.scene.left_out_times = {{"vertex colours", 0.125, 0.1, 0.15, false, true},
                               {"shadow rays", 0.01, -0.1, 0.2, true, false}};
  ASSERT_TRUE(shown("settings.scene.left_out.vertex colours"));
  EXPECT_EQ(find("settings.scene.left_out.vertex colours")->state,
            "3.52 KiB, 0.125 ms (0.1 to 0.15): no mesh has any");
  EXPECT_EQ(find("settings.scene.left_out.shadow rays")->state, "time below noise: switched off");
}

TEST_F(Column, WhatIsLeftOutIsNotMeasuredTwiceAtOnce) {
  view.scene.left_out = {{"shadow rays", "switched off", std::nullopt}};
  view.scene.measuring_left_out = true;
  click("settings.scene.left_out", 0, 0.3F);
  click("settings.scene.left_out.measure");
  EXPECT_EQ(command<MeasureLeftOut>(), nullptr);
}

TEST_F(Column, RaysOfTheCpuGoTogetherOrAlone) {
  left().device = PaneDevice::cpu;
  choose("settings.left.grouping", "single");
  EXPECT_EQ(left().structure.grouping, accel::RayGrouping::single);
  left().device = PaneDevice::gpu;
  EXPECT_FALSE(shown("settings.left.grouping"));
}

TEST_F(Column, OnlyTheHierarchyOfTodayHasPresets) {
  left().device = PaneDevice::cpu;
  left().structure = accel::default_spec(accel::StructureKind::bvh_median);
  EXPECT_FALSE(shown("settings.left.bvh.preset"));
  left().structure = accel::default_spec(accel::StructureKind::bvh_sah);
  choose("settings.left.bvh.preset", "fast");
  EXPECT_EQ(std::get<accel::BvhSettings>(left().structure.settings).preset,
            accel::BuildPreset::fast);
  EXPECT_FALSE(shown("settings.left.bvh.update_case")) << "the thesis' emulation is bvh-median's";
}

}  // namespace
}  // namespace encore::ui
