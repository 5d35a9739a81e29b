// What a person meets first: no file, no sensor, and yet pictures, and the truth about watts.
#include "window_test.h"

#include <algorithm>

namespace encore::test {

namespace {

bool contains_digits_of_watts(const std::string& text) {
  for (std::size_t i = 0; i + 2 < text.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (digit && text[i + 1] == ' ' && text[i + 2] == 'W' &&
        (i + 3 == text.size() || text[i + 3] == ' ')) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_F(WindowTest, ShowsTheSceneInBothPanesWithNothingGiven) {
  Person& person = start(no_sensors());
  const Widget left = person.see("pane.0.picture");
  const Widget right = person.see("pane.1.picture");
  const Screenshot shot = person.look_calmly("first-look");
  EXPECT_GT(shot.colors(area_of(left)), 100U);
  EXPECT_GT(shot.colors(area_of(right)), 100U);
  EXPECT_GT(shot.edges(area_of(left)), 0.005);
  EXPECT_GT(left.width, 200);
  EXPECT_GT(right.width, 200);
  EXPECT_EQ(person.map().state("menu.scene"), "toys");
  close();
}

TEST_F(WindowTest, SaysThatThereAreNoWattsAndWhy) {
  Person& person = start(no_sensors());
  person.wait_idle();
  person.see_state("menu.provenance", "unavailable");
  const WidgetMap map = person.map();
  EXPECT_GT(map.state("power_line.text").size(), 20U) << "one line tells why";
  EXPECT_EQ(map.state("status.no_watts"), "no watts");
  for (const Widget& widget : map.widgets) {
    EXPECT_FALSE(contains_digits_of_watts(widget.state)) << widget.name << ": " << widget.state;
  }
  EXPECT_EQ(map.state("pane.0.badge"), "unavailable");

  // The line's buttons open the ways out.
  person.click("power_line.doctor");
  person.see("doctor.window");
  person.click("doctor.run");
  const WidgetMap examined = person.wait_until(
      [](const WidgetMap& now) { return !now.state("doctor.conclusion").empty(); },
      "what the sensors are like");
  EXPECT_EQ(examined.state("doctor.total"), "unavailable");
  person.look_calmly("doctor");
  person.click("power_line.dismiss");
  person.wait_until([](const WidgetMap& now) { return !now.has("power_line.text"); },
                    "the line to go");
  EXPECT_EQ(person.map().state("menu.provenance"), "unavailable") << "the badge stays";
  close();
}

TEST_F(WindowTest, StartsWithoutADisplayInOneLine) {
  EncoreProcess blind({{}, {}, home().path(), {}});
  const auto code = blind.wait(kPatience);
  ASSERT_TRUE(code);
  EXPECT_EQ(*code, 5);
  const std::string said = blind.err();
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_TRUE(contains(said, "DISPLAY")) << said;
}

TEST_F(WindowTest, RefusesWhatIsNoSceneBeforeAWindowOpens) {
  EncoreProcess wrong({display_name(), {"buddah"}, home().path(), {}});
  const auto code = wrong.wait(kPatience);
  ASSERT_TRUE(code);
  EXPECT_EQ(*code, 2);
  EXPECT_TRUE(contains(wrong.err(), "buddha")) << wrong.err();
}

TEST_F(WindowTest, TakesTheDefaultsFromBadSettings) {
  home().write(".config/encore/window.toml", "theme = [[[ this is no TOML\n");
  Person& person = start();
  const WidgetMap map = person.wait_until(
      [](const WidgetMap& now) { return contains(now.states("notice"), "window.toml"); },
      "a notice about window.toml");
  EXPECT_TRUE(map.has("pane.0.device"));
  EXPECT_EQ(map.state("pane.0.device"), "cpu");
  person.look().keep("bad-settings");
  person.see("pane.0.picture");
  close();
}

TEST_F(WindowTest, RemembersLayoutAndScenesAtTheSecondStart) {
  home().write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  start({(home().path() / "one.obj").string()});
  person().see("pane.0.picture");
  const int before = person().see("pane.0.picture").x;
  const Widget splitter = person().see("splitter.left");
  person().drag(splitter.center_x(), splitter.center_y(), splitter.center_x() + 80,
                splitter.center_y());
  person().choose({"menu.view", "menu.view.plots"});
  person().wait_until([](const WidgetMap& map) { return !map.has("splitter.plots"); },
                      "the plots to go");
  person().key("Escape");
  const int moved = person().see("splitter.left").x;
  EXPECT_GT(moved, splitter.x + 40);
  EXPECT_NE(person().see("pane.0.picture").x, before);
  close();

  start();
  person().see("pane.0.picture");
  EXPECT_NEAR(person().see("splitter.left").x, moved, 2);
  EXPECT_FALSE(person().map().has("splitter.plots"));
  // The scene that was opened last is offered; the one that a start without any shows comes first.
  person().choose({"menu.file", "menu.file.recent"});
  person().see("menu.file.recent.0");
  person().look().keep("recent");
  const WidgetMap map = person().map();
  EXPECT_TRUE(map.has("menu.file.recent.1")) << map.states("menu.file");
  person().click("menu.file.recent.1");
  person().wait_until([](const WidgetMap& now) { return contains(now.state("menu.scene"), "one"); },
                      "the scene of before");
  close();
}

TEST_F(WindowTest, FreshStartNeitherReadsNorWritesSettings) {
  home().write(".config/encore/window.toml", "theme = [[[ this is no TOML\n");
  Person& person = start({"--fresh", "triangle"});
  person.see("pane.0.picture");
  person.wait_idle();
  EXPECT_FALSE(contains(person.map().states("notice"), "window.toml"));
  close();
  EXPECT_EQ(contents_of(home().path() / ".config/encore/window.toml"),
            "theme = [[[ this is no TOML\n");
}

}  // namespace encore::test
