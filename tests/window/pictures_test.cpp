// Choosing what the panes show, and how.
#include "window_test.h"

namespace encore::test {

namespace {

/// Both panes on the CPU: what is looked for does not depend on who traces.
void put_both_on_the_cpu(Person& person) {
  person.choose({"pane.1.device", "pane.1.device.cpu"});
  person.see_state("pane.1.device", "cpu");
  person.wait_idle();
}

Area inner(const Widget& picture) {
  // Without what lies over the picture's rims.
  return {picture.x + picture.width / 4, picture.y + picture.height / 4, picture.width / 2,
          picture.height / 2};
}

}  // namespace

TEST_F(WindowTest, AnotherStructureShowsTheSamePicture) {
  Person& person = start({"cow"});
  person.see("pane.0.picture");
  person.choose({"pane.0.structure", "pane.0.structure.bvh-median"});
  const Screenshot before = person.look_calmly();
  const Area area = inner(person.see("pane.0.picture"));
  person.choose({"pane.0.structure", "pane.0.structure.kd-sah"});
  person.see_state("pane.0.structure", "kd-sah");
  const Screenshot kd = person.look_calmly("kd-sah");
  EXPECT_EQ(person.map().state("structure.title"), "kd-sah");
  EXPECT_LT(difference(before, kd, area), 0.01);
  person.choose({"pane.0.structure", "pane.0.structure.bvh-median"});
  person.see_state("pane.0.structure", "bvh-median");
  EXPECT_LT(difference(before, person.look_calmly(), area), 0.01);
  EXPECT_GT(before.colors(area), 50U);
  close();
}

TEST_F(WindowTest, TellsHowFarThePanesDiffer) {
  Person& person = start({"mug"});
  put_both_on_the_cpu(person);
  // Both of the same size, whatever the window leaves them.
  for (const char* pane : {"settings.left", "settings.right"}) {
    const Widget column = person.see("settings");
    const std::string size = std::string(pane) + ".size";
    ASSERT_TRUE(person.scroll_to(size, column.center_x(), column.center_y()));
    person.choose({size, size + ".256"});
  }
  person.choose({"pane.1.content", "pane.1.content.difference"});
  const WidgetMap map = person.wait_until(
      [](const WidgetMap& now) { return contains(now.states("pane.1.legend.line"), "RMSE"); },
      "the difference's figures");
  EXPECT_TRUE(contains(map.states("pane.1.legend.line"), "RMSE 0,")) << map.states("pane.1.legend");
  person.look_calmly("difference");
  close();
}

TEST_F(WindowTest, ShowsWhatPixelsCost) {
  Person& person = start({"mug"});
  const Widget picture = person.see("pane.0.picture");
  const Screenshot plain = person.look_calmly();
  person.choose({"pane.0.content", "pane.0.content.heatmap"});
  person.wait_until([](const WidgetMap& map) { return map.has("pane.0.legend"); }, "a legend");
  const Screenshot heat = person.look_calmly("heatmap");
  EXPECT_GT(difference(plain, heat, inner(picture)), 0.3);
  EXPECT_TRUE(contains(person.map().state("pane.0.legend"), "steps"));
  close();
}

TEST_F(WindowTest, OrbitsWithTheMouseAndGoesBackByKey) {
  Person& person = start({"cow"});
  put_both_on_the_cpu(person);
  const Widget picture = person.see("pane.0.picture");
  const Area area = inner(picture);
  const Screenshot first = person.look_calmly();
  person.drag(picture.center_x(), picture.center_y(), picture.center_x() + 90,
              picture.center_y() + 30);
  const Screenshot turned = person.look_calmly("orbited");
  EXPECT_GT(difference(first, turned, area), 0.05);
  EXPECT_GT(turned.colors(area), 50U);
  // Both panes share the camera.
  EXPECT_GT(difference(first, turned, inner(person.see("pane.1.picture"))), 0.05);

  person.wheel(picture.center_x(), picture.center_y(), 4);
  EXPECT_GT(difference(turned, person.look_calmly("zoomed"), area), 0.05);
  person.move(picture.center_x(), picture.center_y());
  person.key("r");
  EXPECT_LT(difference(first, person.look_calmly(), area), 0.005);
  close();
}

TEST_F(WindowTest, PlaysTheAnimation) {
  Person& person = start({"wave"});
  put_both_on_the_cpu(person);
  const Widget picture = person.see("pane.0.picture");
  const Screenshot first = person.look_calmly();
  person.key("space");
  EXPECT_TRUE(eventually([&] { return difference(first, person.look(), inner(picture)) > 0.02; }))
      << "nothing moves";
  person.key("space");
  person.wait_idle();
  const Screenshot paused = person.look_calmly("paused");
  person.wait_frames(5);
  EXPECT_LT(difference(paused, person.look(), inner(picture)), 0.005);

  // A structure that follows by refits shows the same, and goes on doing so.
  const Widget column = person.see("settings");
  ASSERT_TRUE(person.scroll_to("settings.left.policy", column.center_x(), column.center_y()));
  person.choose({"settings.left.policy", "settings.left.policy.refit"});
  person.see_state("settings.left.policy", "refit");
  EXPECT_LT(difference(paused, person.look_calmly("refit"), inner(picture)), 0.005);
  person.key("space");
  EXPECT_TRUE(eventually([&] { return difference(paused, person.look(), inner(picture)) > 0.02; }))
      << "nothing moves";
  person.key("space");
  person.wait_idle();
  // The pane beside builds anew: both see the same moment.
  const Screenshot both = person.look_calmly();
  const Area left = inner(picture);
  const Area right = inner(person.see("pane.1.picture"));
  EXPECT_NEAR(both.brightness(left), both.brightness(right), 3.0);
  EXPECT_FALSE(person.map().has("pane.0.state")) << person.map().state("pane.0.state");
  close();
}

TEST_F(WindowTest, UndoesAndRedoesSettings) {
  Person& person = start({"triangle"});
  person.see("pane.0.picture");
  const std::string first = person.map().state("pane.0.structure");
  const std::string other = first == "kd-sah" ? "grid-density" : "kd-sah";
  person.choose({"pane.0.structure", "pane.0.structure." + other});
  person.see_state("pane.0.structure", other);
  person.key("Ctrl+z");
  person.see_state("pane.0.structure", first);
  person.key("Ctrl+Shift+z");
  person.see_state("pane.0.structure", other);
  person.click("menu.edit");
  person.click("menu.edit.undo");
  person.see_state("pane.0.structure", first);
  close();
}

TEST_F(WindowTest, SwitchesAPaneOffAndOn) {
  Person& person = start({"mug"});
  const int half = person.see("pane.0.picture").width;
  person.choose({"pane.1.device", "pane.1.device.off"});
  person.wait_until(
      [half](const WidgetMap& map) {
        const Widget* picture = map.find("pane.0.picture");
        return !map.has("pane.1.picture") && picture != nullptr && picture->width > half + 50;
      },
      "the other pane to take the room");
  person.look_calmly("one-pane");
  person.key("Ctrl+z");
  person.see("pane.1.picture");
  close();
}

TEST_F(WindowTest, RasteriserAndRaysAgreeOnTheScene) {
  Person& person = start({"car"});
  person.choose({"pane.1.device", "pane.1.device.raster"});
  person.see_state("pane.1.device", "raster");
  const Screenshot shot = person.look_calmly("raster");
  const Widget left = person.see("pane.0.picture");
  const Widget right = person.see("pane.1.picture");
  EXPECT_NEAR(shot.brightness(inner(left)), shot.brightness(inner(right)), 12.0);
  EXPECT_GT(shot.colors(inner(right)), 30U);
  close();
}

}  // namespace encore::test
