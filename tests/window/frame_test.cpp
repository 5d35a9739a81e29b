// The window itself: its size, its look, its help, its end.
#include "window_test.h"

#include <csignal>

namespace encore::test {

TEST_F(WindowTest, StandsEverySize) {
  open_display(3000, 1900);
  Person& person = start({"mug"});
  person.see("pane.0.picture");
  person.wait_idle();
  for (const auto& [width, height] :
       {std::pair{320, 240}, std::pair{3000, 1900}, std::pair{640, 900}, std::pair{1280, 800}}) {
    person.resize(width, height);
    const Widget picture = person.see("pane.0.picture");
    EXPECT_GE(picture.x, 0);
    EXPECT_LE(picture.x + picture.width, width);
    EXPECT_LE(picture.y + picture.height, height);
    EXPECT_GT(picture.width, 40);
    EXPECT_GT(picture.height, 40);
    const std::string name = "size-" + std::to_string(width);
    EXPECT_GT(person.look_calmly(name).colors(area_of(person.see("pane.0.picture"))), 8U) << name;
  }
  EXPECT_TRUE(person.map().has("pane.1.picture"));
  close();
}

TEST_F(WindowTest, ChangesThemeAndScale) {
  Person& person = start({"triangle"});
  person.see("pane.0.picture");
  const Area menu{0, 0, 1280, 16};
  const double dark = person.look_calmly().brightness(menu);
  person.choose({"menu.view", "menu.view.theme", "menu.view.theme.light"});
  const double light = person.look_calmly("light").brightness(menu);
  EXPECT_GT(light, dark + 60.0);
  const Widget badge = person.see("menu.provenance");
  person.key("Ctrl+equal");
  person.key("Ctrl+equal");
  const Widget larger = person.see("menu.provenance");
  EXPECT_GT(larger.height, badge.height);
  person.look_calmly("light-large");
  person.key("Ctrl+0");
  EXPECT_EQ(person.see("menu.provenance").height, badge.height);
  close();
}

TEST_F(WindowTest, HelpsByManualAndShortcuts) {
  Person& person = start({"triangle"});
  person.see("pane.0.picture");
  person.key("F1");
  person.see("dialog.manual");
  person.look_calmly("manual");
  person.click("manual.search");
  person.type("energy");
  const WidgetMap found = person.wait_until(
      [](const WidgetMap& map) { return std::atoi(map.state("manual.search").c_str()) > 0; },
      "something found in the manual");
  person.key("Escape");
  person.key("Escape");
  person.wait_until([](const WidgetMap& map) { return !map.has("dialog.manual"); },
                    "the manual to close");
  person.key("question");
  person.see("dialog.shortcuts");
  person.look_calmly("shortcuts");
  person.key("Escape");
  person.wait_until([](const WidgetMap& map) { return !map.has("dialog.shortcuts"); },
                    "the list to close");
  person.choose({"menu.help", "menu.help.about"});
  person.see("dialog.about");
  person.look_calmly("about");
  person.key("Escape");
  close();
}

TEST_F(WindowTest, ShowsAllMenus) {
  Person& person = start({"triangle"});
  person.see("pane.0.picture");
  for (const char* menu :
       {"menu.file", "menu.edit", "menu.view", "menu.structure", "menu.measure", "menu.help"}) {
    person.click(menu);
    person.wait_until(
        [menu](const WidgetMap& map) {
          for (const Widget& widget : map.widgets) {
            if (widget.name.starts_with(std::string(menu) + ".")) return true;
          }
          return false;
        },
        "the menu's entries");
    person.look().keep(menu);
    person.key("Escape");
  }
  close();
}

TEST_F(WindowTest, SavesPictures) {
  Person& person = start({"triangle"});
  person.see("pane.0.picture");
  person.wait_idle();
  person.key("Ctrl+s");
  const WidgetMap map = person.wait_until(
      [](const WidgetMap& now) { return contains(now.states("notice"), "saved "); }, "a notice");
  const std::string said = map.states("notice");
  const std::size_t from = said.find("saved ") + 6;
  const std::filesystem::path file = said.substr(from, said.find('\n', from) - from);
  EXPECT_TRUE(std::filesystem::exists(file)) << file;
  EXPECT_TRUE(file.string().starts_with(home().path().string())) << file;
  close();
}

TEST_F(WindowTest, EndsInTheMiddleOfABuild) {
  Person& person = start({"buddha"});
  person.choose({"pane.0.structure", "pane.0.structure.kd-sah"});
  person.wait_until(
      [](const WidgetMap& map) { return contains(map.states(""), "building kd-sah"); },
      "the build to begin");
  person.look().keep("building");
  close();
}

TEST_F(WindowTest, EndsBySignalAndByKey) {
  start({"mug"});
  person().see("pane.0.picture");
  program().signal(SIGTERM);
  expect_exit(130);
  start({"mug"});
  person().see("pane.0.picture");
  person().last_key("Ctrl+q");
  expect_exit(0);
}

}  // namespace encore::test
