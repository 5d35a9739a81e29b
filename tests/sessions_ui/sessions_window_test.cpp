#include "panel_test.h"
#include "ui/panels/change_text.h"
#include "views.h"

namespace encore::ui {
namespace {

class Sessions : public PanelTest {
 protected:
  Sessions() { state.sessions_open = true; }
  void draw() override { draw_sessions_window(view, state, commands); }
};

TEST_F(Sessions, TheRecorderIsStartedPausedResumedAndStopped) {
  click("sessions.record");
  EXPECT_TRUE(last<StartRecording>());
  view.recorder.state = RecorderView::State::recording;
  view.recorder.folder = "/sessions/new";
  view.recorder.seconds = 12.5;
  view.recorder.rows = 4321;
  settle();
  EXPECT_EQ(widget("sessions.record"), nullptr);
  EXPECT_EQ(state_of("sessions.recorder_folder"), "/sessions/new");
  click("sessions.pause");
  auto pause = last<PauseRecording>();
  ASSERT_TRUE(pause);
  EXPECT_TRUE(pause->paused);
  view.recorder.state = RecorderView::State::paused;
  click("sessions.resume");
  pause = last<PauseRecording>();
  ASSERT_TRUE(pause);
  EXPECT_FALSE(pause->paused);
  click("sessions.stop");
  EXPECT_TRUE(last<StopRecording>());
}

TEST_F(Sessions, AFailedRecorderSaysWhyAndCanBeStartedAgain) {
  view.recorder.state = RecorderView::State::failed;
  view.recorder.problem = "cannot write /sessions/new/samples.csv: the disk is full; free some";
  settle();
  EXPECT_EQ(state_of("sessions.recorder"), "failed");
  EXPECT_EQ(state_of("sessions.recorder_problem"), view.recorder.problem);
  click("sessions.record");
  EXPECT_TRUE(last<StartRecording>());
}

TEST_F(Sessions, WordsAreAnnotatedOnceAndOnlyIfThereAreAny) {
  settle();
  EXPECT_EQ(state_of("sessions.annotate"), "disabled");
  click("sessions.annotate");
  EXPECT_FALSE(last<Annotate>());
  click("sessions.annotation");
  type("fan off");
  click("sessions.annotate");
  const auto note = last<Annotate>();
  ASSERT_TRUE(note);
  EXPECT_EQ(note->text, "fan off");
  EXPECT_TRUE(state.sessions.annotation.empty());
}

TEST_F(Sessions, WithoutASessionNothingOfOneCanBeDone) {
  settle();
  for (const char* name : {"sessions.compare", "sessions.export", "sessions.close"}) {
    EXPECT_EQ(state_of(name), "disabled") << name;
  }
  click("sessions.close");
  EXPECT_FALSE(last<CloseSession>());
  click("sessions.open");
  EXPECT_EQ(state.dialog, Dialog::open_session);
}

TEST_F(Sessions, TheOpenSessionIsShownComparedExportedAndClosed) {
  view.session = compared_session();
  settle();
  EXPECT_EQ(state_of("sessions.folder"), "/sessions/monday");
  EXPECT_EQ(state_of("sessions.state"), "complete");
  EXPECT_EQ(state_of("sessions.changes.row.0"), "cpu bvh; lower; higher");
  click("sessions.show");
  EXPECT_TRUE(state.show_session);
  click("sessions.compare");
  EXPECT_EQ(state.dialog, Dialog::compare_session);
  click("sessions.export");
  EXPECT_EQ(state.dialog, Dialog::export_session);
  click("sessions.close");
  EXPECT_TRUE(last<CloseSession>());
}

TEST_F(Sessions, SessionsWithNothingInCommonSaySo) {
  view.session = compared_session();
  view.session.changes.clear();
  settle();
  EXPECT_EQ(state_of("sessions.changes"), "none");
}

TEST_F(Sessions, RecentOnesAreOpenedByAClick) {
  state.preferences.recent_sessions = {"/sessions/a", "/sessions/b"};
  click("sessions.recent.1");
  const auto open = last<OpenSession>();
  ASSERT_TRUE(open);
  EXPECT_EQ(open->folder, "/sessions/b");
}

TEST_F(Sessions, ReadingShowsProgressAndCanBeCancelled) {
  view.session.reading.active = true;
  view.session.reading.doing = "reading";
  settle();
  EXPECT_EQ(state_of("sessions.progress"), "unknown");
  EXPECT_EQ(widget("sessions.cancel"), nullptr) << "it cannot be cancelled";
  view.session.reading.progress = 0.42;
  view.session.reading.cancellable = true;
  settle();
  EXPECT_EQ(state_of("sessions.progress"), "42 %");
  click("sessions.cancel");
  EXPECT_TRUE(last<CancelSession>());
}

TEST_F(Sessions, AProblemIsOneLine) {
  view.session.problem = "/x holds no session.toml: choose the folder of a session";
  settle();
  EXPECT_EQ(state_of("sessions.problem"), view.session.problem);
}

TEST(ChangeText, NeverInventsANumber) {
  EXPECT_EQ(change_text(std::nullopt, 1.0, 2.0), "unavailable");
  EXPECT_EQ(change_text(3.14, std::nullopt, std::nullopt), "+3.1 %, no interval");
  EXPECT_EQ(change_text(-10.0, -12.0, -8.0), "-10.0 % (-12.0 .. -8.0)");
}

}  // namespace
}  // namespace encore::ui
