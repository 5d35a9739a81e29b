// Undo brings settings back step by step; a drag is one step; the past is bounded.
#include "ui/undo.h"

#include <gtest/gtest.h>

namespace {

using namespace encore;
using ui::History;
using ui::Settings;

TEST(ChangeName, NamesWhatChanged) {
  const Settings before = ui::default_settings();
  Settings after = before;
  EXPECT_EQ(ui::change_name(before, after), "");
  after.panes[0].structure = accel::default_spec(accel::StructureKind::kd_sah);
  EXPECT_EQ(ui::change_name(before, after), "structure of pane CPU: kd-sah");
  after.overlay.show = true;
  EXPECT_EQ(ui::change_name(before, after), "several settings");
  after = before;
  std::get<accel::BvhSettings>(after.panes[1].structure.settings).seed = 9;
  EXPECT_EQ(ui::change_name(before, after), "parameters of bvh-median, pane GPU");
  after = before;
  after.panes[1].device = ui::PaneDevice::cpu;
  EXPECT_EQ(ui::change_name(before, after), "device of the right pane: cpu");
  after = before;
  after.rays.shadows = true;
  EXPECT_EQ(ui::change_name(before, after), "rays: shadows,textures");
  after = before;
  after.panes[0].structure.intersection = accel::IntersectionMode::watertight;
  EXPECT_EQ(ui::change_name(before, after), "intersection of pane CPU: watertight");
  after = before;
  after.panes[1].build_on = accel::BuildPlace::cpu;
  EXPECT_EQ(ui::change_name(before, after), "structure of pane GPU built on: cpu");
  after = before;
  after.animation.playing = true;
  EXPECT_EQ(ui::change_name(before, after), "");
}

TEST(Undo, GoesBackAndForth) {
  History history;
  Settings now = ui::default_settings();
  history.observe(now, false);
  EXPECT_FALSE(history.undo(now));
  const Settings first = now;
  now.overlay.show = true;
  history.observe(now, false);
  const Settings second = now;
  now.measure.slot_s = 7.0F;
  history.observe(now, false);
  const Settings third = now;

  EXPECT_EQ(history.undo_name(), "measuring");
  now = *history.undo(now);
  EXPECT_EQ(now, second);
  EXPECT_EQ(history.redo_name(), "measuring");
  now = *history.undo(now);
  EXPECT_EQ(now, first);
  EXPECT_FALSE(history.can_undo());
  now = *history.redo(now);
  now = *history.redo(now);
  EXPECT_EQ(now, third);
  EXPECT_FALSE(history.redo(now));
}

TEST(Undo, ADragIsOneStep) {
  History history;
  Settings now = ui::default_settings();
  history.observe(now, false);
  for (int i = 0; i < 20; ++i) {
    now.overlay.opacity = 0.3F + 0.01F * static_cast<float>(i);
    history.observe(now, true);
  }
  EXPECT_EQ(history.size(), 0U);
  history.observe(now, false);
  EXPECT_EQ(history.size(), 1U);
  EXPECT_EQ(history.undo(now)->overlay.opacity, 0.8F);
}

TEST(Undo, AChangeEndsWhatCouldBeRedone) {
  History history;
  Settings now = ui::default_settings();
  history.observe(now, false);
  now.overlay.show = true;
  now = *history.undo(now);  // not observed before: a step all the same
  EXPECT_TRUE(history.can_redo());
  now.heatmap.logarithmic = true;
  history.observe(now, false);
  EXPECT_FALSE(history.can_redo());
  EXPECT_FALSE(history.undo(now)->overlay.show);
}

TEST(Undo, DoesNotStartTheAnimation) {
  History history;
  Settings now = ui::default_settings();
  now.animation.playing = true;
  history.observe(now, false);
  now.overlay.show = true;
  history.observe(now, false);
  now.animation.playing = false;
  EXPECT_FALSE(history.undo(now)->animation.playing);
}

TEST(Undo, ForgetsTheOldest) {
  History history(5);
  Settings now = ui::default_settings();
  history.observe(now, false);
  for (int i = 0; i < 12; ++i) {
    now.overlay.last_depth = 20 + i;
    history.observe(now, false);
  }
  EXPECT_EQ(history.size(), 5U);
  int steps = 0;
  while (const auto back = history.undo(now)) {
    now = *back;
    ++steps;
  }
  EXPECT_EQ(steps, 5);
  EXPECT_EQ(now.overlay.last_depth, 26);
}

}  // namespace
