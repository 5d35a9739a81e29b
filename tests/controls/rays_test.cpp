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

}  // namespace
}  // namespace encore::ui
