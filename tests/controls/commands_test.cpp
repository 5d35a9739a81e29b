// Buttons ask for what they say.
#include "tests/controls/column.h"

namespace encore::ui {
namespace {

TEST_F(Column, ScenesAreOpenedReloadedAndCancelled) {
  click("settings.scene.open");
  EXPECT_EQ(state.dialog, Dialog::open_scene);
  click("settings.scene.reload");
  EXPECT_NE(command<ReloadScene>(), nullptr);
  commands.clear();
  choose("settings.scene.sample", "wave");
  ASSERT_NE(command<OpenScene>(), nullptr);
  EXPECT_EQ(command<OpenScene>()->name_or_path, "wave");
  commands.clear();
  view.scene.loading = {
      .active = true, .doing = "reading buddha", .progress = 0.1, .cancellable = true};
  click("settings.scene.loading.cancel");
  ASSERT_NE(command<CancelWork>(), nullptr);
  EXPECT_FALSE(command<CancelWork>()->pane.has_value());
}

TEST_F(Column, PanesAreBuiltAgainAndCancelled) {
  click("settings.right.rebuild");
  ASSERT_NE(command<Rebuild>(), nullptr);
  EXPECT_EQ(command<Rebuild>()->pane, 1U);
  commands.clear();
  view.panes[0].work = {
      .active = true, .doing = "building kd-sah", .progress = 0.4, .cancellable = true};
  click("settings.left.work.cancel");
  ASSERT_NE(command<CancelWork>(), nullptr);
  EXPECT_EQ(command<CancelWork>()->pane, std::size_t{0});
  view.panes[0].work.cancellable = false;
  EXPECT_FALSE(shown("settings.left.work.cancel"));
}

TEST_F(Column, RecordingsBeginPauseAndEnd) {
  click("settings.measure.record");
  EXPECT_NE(command<StartRecording>(), nullptr);
  commands.clear();
  view.recorder.state = RecorderView::State::recording;
  EXPECT_FALSE(shown("settings.measure.record"));
  click("settings.measure.pause");
  ASSERT_NE(command<PauseRecording>(), nullptr);
  EXPECT_TRUE(command<PauseRecording>()->paused);
  commands.clear();
  view.recorder.state = RecorderView::State::paused;
  click("settings.measure.pause");
  ASSERT_NE(command<PauseRecording>(), nullptr);
  EXPECT_FALSE(command<PauseRecording>()->paused);
  commands.clear();
  click("settings.measure.stop");
  EXPECT_NE(command<StopRecording>(), nullptr);
  commands.clear();
  click("settings.measure.clear");
  EXPECT_NE(command<ClearResults>(), nullptr);
  click("settings.measure.sessions");
  EXPECT_TRUE(state.sessions_open);
}

TEST_F(Column, TheSourceOfWattsIsNamedAndCanBeChanged) {
  ASSERT_TRUE(shown("settings.energy.badge"));
  EXPECT_EQ(find("settings.energy.badge")->state, "unavailable");
  click("settings.energy.watts");
  EXPECT_EQ(state.dialog, Dialog::energy);
  click("settings.energy.doctor");
  EXPECT_TRUE(state.doctor_open);
  EXPECT_FALSE(shown("settings.energy.automatic"));
  state.settings.energy = {
      .from = EnergySettings::From::model, .source = {}, .idle_watts = 20, .busy_watts = 65};
  ASSERT_TRUE(shown("settings.energy.source"));
  EXPECT_EQ(find("settings.energy.source")->state, "20 W idle, 65 W busy");
  click("settings.energy.automatic");
  EXPECT_EQ(state.settings.energy.from, EnergySettings::From::automatic);
  EXPECT_NE(command<ApplyEnergy>(), nullptr);
}

TEST_F(Column, TheCameraIsCopiedAsText) {
  click("settings.camera", 0, 0.3F);
  click("settings.camera.copy");
  ASSERT_NE(command<CopyText>(), nullptr);
  EXPECT_NE(command<CopyText>()->text.find("eye"), std::string::npos);
}

}  // namespace
}  // namespace encore::ui
