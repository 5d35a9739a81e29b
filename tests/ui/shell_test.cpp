// The window's own parts as a person uses them: menus ask for what they say, keys do what the
// table says, dialogs open and close, splitters follow the mouse.
#include "tests/ui/shell.h"

#include "ui/shortcuts.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

namespace {

using namespace encore;
using namespace encore::ui;
using encore::test::Shell;
namespace fs = std::filesystem;

std::shared_ptr<const scene::Scene> some_scene() {
  auto scene = std::make_shared<scene::Scene>();
  scene->name = "some";
  scene->camera.eye = {1.0F, 2.0F, 30.0F};
  return scene;
}

TEST_F(Shell, FileMenuOpensSamplesAndQuits) {
  click("menu.file");
  click("menu.file.samples");
  click("menu.file.sample.toys");
  ASSERT_NE(last<OpenScene>(), nullptr);
  EXPECT_EQ(last<OpenScene>()->name_or_path, "toys");
  click("menu.file");
  click("menu.file.quit");
  EXPECT_NE(last<Quit>(), nullptr);
}

TEST_F(Shell, EntriesThatDoNothingAreGrey) {
  click("menu.file");
  for (const char* name : {"menu.file.reload", "menu.file.export", "menu.file.compare"}) {
    ASSERT_NE(find(name), nullptr) << name;
    EXPECT_EQ(find(name)->state, "disabled") << name;
  }
  click("menu.file.reload");
  EXPECT_TRUE(commands.empty());
}

TEST_F(Shell, ViewMenuTogglesParts) {
  click("menu.view");
  click("menu.view.plots");
  EXPECT_FALSE(state.preferences.layout.plots);
  click("menu.view");
  click("menu.view.theme");
  click("menu.view.theme.light");
  EXPECT_EQ(state.preferences.theme, Theme::light);
  state.preferences.layout.left_width = 30.0F;
  click("menu.view");
  click("menu.view.reset_layout");
  EXPECT_EQ(state.preferences.layout, LayoutSettings{});
}

TEST_F(Shell, StructureAndMeasureMenus) {
  view.scene.scene = some_scene();
  click("menu.structure");
  click("menu.structure.rebuild.1");
  ASSERT_NE(last<Rebuild>(), nullptr);
  EXPECT_EQ(last<Rebuild>()->pane, 1U);
  click("menu.structure");
  click("menu.structure.overlay");
  EXPECT_TRUE(state.settings.overlay.show);
  click("menu.measure");
  click("menu.measure.mode");
  EXPECT_TRUE(state.measuring);
  click("menu.measure");
  click("menu.measure.record");
  EXPECT_NE(last<StartRecording>(), nullptr);
  view.recorder.state = RecorderView::State::recording;
  click("menu.measure");
  click("menu.measure.pause");
  ASSERT_NE(last<PauseRecording>(), nullptr);
  EXPECT_TRUE(last<PauseRecording>()->paused);
}

TEST_F(Shell, MenusShowTheKeysOfTheTable) {
  // Each name below is drawn by action_entry(); what it does is what its key does.
  view.scene.scene = some_scene();
  click("menu.help");
  click("menu.help.shortcuts");
  EXPECT_EQ(state.dialog, Dialog::shortcuts);
  key(GLFW_KEY_ESCAPE);
  EXPECT_EQ(state.dialog, Dialog::none);
  type("?");
  EXPECT_EQ(state.dialog, Dialog::shortcuts);
}

TEST_F(Shell, UndoByKeysIsToldAndReopensSources) {
  state.settings.panes[0].structure = accel::default_spec(accel::StructureKind::kd_sah);
  frames();
  state.settings.energy.from = EnergySettings::From::model;
  frames();
  key(GLFW_KEY_Z, true);
  EXPECT_EQ(state.settings.energy.from, EnergySettings::From::automatic);
  EXPECT_NE(last<ApplyEnergy>(), nullptr);
  commands.clear();
  key(GLFW_KEY_Z, true);
  EXPECT_EQ(state.settings, default_settings());
  EXPECT_TRUE(commands.empty());
  EXPECT_EQ(state.notices.back().text, "undone: structure of pane CPU: kd-sah");
  key(GLFW_KEY_Y, true);
  key(GLFW_KEY_Z, true, true);
  EXPECT_EQ(state.settings.energy.from, EnergySettings::From::model);
  EXPECT_EQ(state.settings.panes[0].structure.kind, accel::StructureKind::kd_sah);
}

TEST_F(Shell, KeysOfTheCamera) {
  view.scene.scene = some_scene();
  state.camera.eye = {5.0F, 6.0F, 7.0F};
  const scene::Camera stored = state.camera;
  key(GLFW_KEY_3, true);
  key(GLFW_KEY_R);
  EXPECT_EQ(state.camera, view.scene.scene->camera);
  key(GLFW_KEY_3);
  EXPECT_EQ(state.camera, stored);
  key(GLFW_KEY_O);
  EXPECT_TRUE(state.camera.orthographic());
  key(GLFW_KEY_C, true);
  ASSERT_NE(last<CopyText>(), nullptr);
  const std::string text = last<CopyText>()->text;
  const scene::Camera copied = state.camera;
  key(GLFW_KEY_R);
  ImGui::SetClipboardText(text.c_str());
  key(GLFW_KEY_V, true);
  EXPECT_EQ(state.camera.eye, copied.eye);
  EXPECT_TRUE(state.camera.orthographic());
  ImGui::SetClipboardText("no camera");
  key(GLFW_KEY_V, true);
  EXPECT_EQ(state.camera.eye, copied.eye);
  EXPECT_TRUE(state.notices.back().problem);
}

TEST_F(Shell, FocusShowsTheScene) {
  auto info = std::make_shared<scene::SceneInfo>();
  info->bounds.extend({100.0F, 100.0F, 100.0F});
  info->bounds.extend({110.0F, 104.0F, 102.0F});
  view.scene.info = info;
  key(GLFW_KEY_F);
  EXPECT_EQ(state.camera.target, info->bounds.center());
}

TEST_F(Shell, OtherKeys) {
  key(GLFW_KEY_V);
  EXPECT_TRUE(state.structure_view);
  key(GLFW_KEY_B);
  EXPECT_TRUE(state.settings.overlay.show);
  key(GLFW_KEY_M);
  EXPECT_TRUE(state.measuring);
  key(GLFW_KEY_SPACE);
  EXPECT_FALSE(state.settings.animation.playing);  // nothing moves here
  view.scene.animated = true;
  key(GLFW_KEY_SPACE);
  EXPECT_TRUE(state.settings.animation.playing);
  key(GLFW_KEY_S, true);
  EXPECT_NE(last<SavePicture>(), nullptr);
  key(GLFW_KEY_F11);
  EXPECT_NE(last<ToggleFullScreen>(), nullptr);
  key(GLFW_KEY_EQUAL, true);
  EXPECT_EQ(state.preferences.ui_scale, 1.25F);
  key(GLFW_KEY_MINUS, true);
  key(GLFW_KEY_MINUS, true);
  EXPECT_EQ(state.preferences.ui_scale, 0.75F);
  key(GLFW_KEY_0, true);
  EXPECT_EQ(state.preferences.ui_scale, 0.0F);
}

TEST_F(Shell, EscapeEndsTheInnermostThing) {
  view.pick = PickView{};
  view.panes[1].work = {true, "building", 0.5, true, 2.0};
  key(GLFW_KEY_F1);
  EXPECT_EQ(state.dialog, Dialog::manual);
  key(GLFW_KEY_ESCAPE);
  EXPECT_EQ(state.dialog, Dialog::none);
  EXPECT_TRUE(commands.empty());
  key(GLFW_KEY_ESCAPE);
  EXPECT_NE(last<ClearPick>(), nullptr);
  view.pick.reset();
  key(GLFW_KEY_ESCAPE);
  ASSERT_NE(last<CancelWork>(), nullptr);
  EXPECT_EQ(last<CancelWork>()->pane, 1U);
}

TEST_F(Shell, EscapeClosesAMenuFirst) {
  view.pick = PickView{};
  click("menu.file");
  ASSERT_NE(find("menu.file.open"), nullptr);
  key(GLFW_KEY_ESCAPE);
  EXPECT_EQ(find("menu.file.open"), nullptr);
  EXPECT_TRUE(commands.empty());
}

TEST_F(Shell, StatusTellsTheWorkAndCancelsIt) {
  view.scene.loading = {true, "reading dragon.ply", 0.25, true, 3.0};
  frames(2);
  ASSERT_NE(find("status.text"), nullptr);
  EXPECT_NE(find("status.text")->state.find("reading dragon.ply, 25 %"), std::string::npos);
  click("status.cancel");
  ASSERT_NE(last<CancelWork>(), nullptr);
  EXPECT_FALSE(last<CancelWork>()->pane);
}

TEST_F(Shell, StatusTellsWhatTheMachineLacks) {
  view.panes[1].software = true;
  frames(2);
  EXPECT_NE(find("status.software"), nullptr);
  EXPECT_NE(find("status.no_watts"), nullptr);
  view.panes[1].software = false;
  view.power.origin = energy::Origin::measured;
  frames(2);
  EXPECT_EQ(find("status.software"), nullptr);
  EXPECT_EQ(find("status.no_watts"), nullptr);
}

TEST_F(Shell, BadgeSaysWhereWattsComeFrom) {
  for (const energy::Origin origin : {energy::Origin::measured, energy::Origin::modelled,
                                      energy::Origin::simulated, energy::Origin::unavailable}) {
    view.power.origin = origin;
    frames(2);
    ASSERT_NE(find("menu.provenance"), nullptr);
    EXPECT_EQ(find("menu.provenance")->state, energy::to_string(origin));
  }
  click("menu.provenance");
  EXPECT_TRUE(state.doctor_open);
}

TEST_F(Shell, PowerLineHelpsAndGoes) {
  view.power.detail = "no sensor in this machine";
  frames(2);
  ASSERT_NE(find("power_line.text"), nullptr);
  EXPECT_EQ(find("power_line.text")->state, "No watts: no sensor in this machine");
  click("power_line.watts");
  EXPECT_EQ(state.dialog, Dialog::energy);
  state.dialog = Dialog::none;
  click("power_line.dismiss");
  EXPECT_EQ(find("power_line.text"), nullptr);
}

TEST_F(Shell, SplittersFollowTheMouse) {
  const MappedWidget* splitter = find("splitter.left");
  ASSERT_NE(splitter, nullptr);
  const float x = splitter->x + 2.0F;
  const float y = splitter->y + 100.0F;
  move(x, y);
  button(true);
  move(x + 30.0F, y);
  move(x + 50.0F, y);
  button(false);
  frames(2);
  EXPECT_NEAR(find("splitter.left")->x + 2.0F, x + 50.0F, 1.5F);
  EXPECT_FALSE(state.shell.history.can_undo());
}

TEST_F(Shell, NoticesGoAway) {
  tell(state, "saved");
  tell(state, "a problem", true);
  frames(30);
  EXPECT_EQ(state.notices.size(), 2U);
  frames(6 * 60);
  ASSERT_EQ(state.notices.size(), 1U);
  EXPECT_EQ(state.notices[0].text, "a problem");
  click("notice");
  EXPECT_TRUE(state.notices.empty());
}

TEST_F(Shell, AnnotateSendsItsText) {
  key(GLFW_KEY_M, true);
  EXPECT_EQ(state.dialog, Dialog::none);  // nothing is recorded
  view.recorder.state = RecorderView::State::recording;
  key(GLFW_KEY_M, true);
  EXPECT_EQ(state.dialog, Dialog::annotate);
  frames(2);
  type("fm?");  // letters that are shortcuts elsewhere
  EXPECT_EQ(state.dialog, Dialog::annotate);
  key(GLFW_KEY_ENTER);
  ASSERT_NE(last<Annotate>(), nullptr);
  EXPECT_EQ(last<Annotate>()->text, "fm?");
  EXPECT_EQ(state.dialog, Dialog::none);
}

TEST_F(Shell, ManualIsShownAndSearched) {
  key(GLFW_KEY_F1);
  frames(3);
  ASSERT_NE(find("manual.search"), nullptr);
  click("manual.search");
  type("provenance");
  frames(2);
  EXPECT_FALSE(state.shell.manual.found.empty());
  click("manual.chapter.Measuring");
  key(GLFW_KEY_F1);
  EXPECT_EQ(state.dialog, Dialog::none);
}

TEST_F(Shell, BrowserOpensASceneFile) {
  const fs::path folder =
      fs::temp_directory_path() / ("encore_shell_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "one.obj") << "x";
  std::ofstream(folder / "notes.md") << "x";
  state.preferences.last_folder = folder.string();
  key(GLFW_KEY_O, true);
  while (state.shell.browser.reader.list() == nullptr) std::this_thread::yield();
  frames(3);
  EXPECT_EQ(find("browser.entry.notes.md"), nullptr);
  EXPECT_EQ(find("browser.choose")->state, "disabled");
  click("browser.entry.one.obj");
  click("browser.choose");
  ASSERT_NE(last<OpenScene>(), nullptr);
  EXPECT_EQ(last<OpenScene>()->name_or_path, (folder / "one.obj").string());
  EXPECT_EQ(state.dialog, Dialog::none);
  fs::remove_all(folder);
}

TEST_F(Shell, ExportRefusesToOverwrite) {
  const fs::path folder =
      fs::temp_directory_path() / ("encore_shell_x_" + std::to_string(::getpid()));
  fs::create_directories(folder / "taken");
  state.preferences.last_folder = folder.string();
  view.session.folder = "/some/session";
  click("menu.file");
  click("menu.file.export");
  while (state.shell.browser.reader.list() == nullptr) std::this_thread::yield();
  state.shell.browser.name = "taken";
  frames(2);
  EXPECT_EQ(find("browser.choose")->state, "disabled");
  state.shell.browser.name = "free";
  frames(2);
  click("browser.choose");
  ASSERT_NE(last<ExportSession>(), nullptr);
  EXPECT_EQ(last<ExportSession>()->to, folder / "free");
  EXPECT_EQ(last<ExportSession>()->from, "/some/session");
  fs::remove_all(folder);
}

TEST_F(Shell, EverySizeAndThemeDraws) {
  view.scene.scene = some_scene();
  for (const ImVec2 size : {ImVec2(320.0F, 240.0F), ImVec2(900.0F, 500.0F), ImVec2(3840, 2160)}) {
    ImGui::GetIO().DisplaySize = size;
    for (const Dialog dialog : {Dialog::none, Dialog::shortcuts, Dialog::manual, Dialog::about,
                                Dialog::open_scene, Dialog::open_session, Dialog::annotate}) {
      state.dialog = dialog;
      frames(2);
      EXPECT_NE(find("menu.file"), nullptr);
    }
  }
}

}  // namespace
