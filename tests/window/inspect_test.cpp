// Looking into the structure: overlay, 3D view, tree, the way of a ray.
#include "window_test.h"

#include <cstdlib>

namespace encore::test {

namespace {

/// "step 3 of 12" and the like: the first number in it; -1 if there is none.
int first_number(const std::string& text) {
  const std::size_t at = text.find_first_of("0123456789");
  return at == std::string::npos ? -1 : std::atoi(text.c_str() + at);
}

}  // namespace

TEST_F(WindowTest, DrawsTheStructureOverThePicture) {
  Person& person = start({"cow"});
  const Widget picture = person.see("pane.0.picture");
  const Screenshot plain = person.look_calmly();
  person.move(picture.center_x(), picture.center_y());
  person.key("b");
  const Screenshot with = person.look_calmly("overlay");
  EXPECT_GT(difference(plain, with, area_of(picture)), 0.03);
  EXPECT_GT(with.edges(area_of(picture)), plain.edges(area_of(picture)) * 1.3);
  person.move(picture.center_x(), picture.center_y());
  person.key("b");
  EXPECT_LT(difference(plain, person.look_calmly(), area_of(picture)), 0.01);
  close();
}

TEST_F(WindowTest, SelectsANodeInTheFreeView) {
  Person& person = start({"cow"}, "1280x800");
  person.see("pane.0.picture");
  person.key("v");
  const Widget view = person.see("structure_view.picture");
  const Screenshot shot = person.look_calmly("free-view");
  EXPECT_GT(shot.edges(area_of(view)), 0.02);
  person.click("structure.tab.tree");
  person.see("tree.list");
  person.click(view.center_x(), view.center_y());
  const WidgetMap map = person.wait_until(
      [](const WidgetMap& now) {
        for (const Widget& widget : now.widgets) {
          if (widget.name.starts_with("tree.node.") && widget.state == "selected") return true;
        }
        return false;
      },
      "the tree to follow the click");
  EXPECT_GT(first_number(map.state("structure_view.nodes")), 10);
  person.look_calmly("tree");
  person.click("structure.tab.selection");
  person.look_calmly("selection");
  EXPECT_FALSE(person.map().has("selection.none"));
  person.click("structure_view.close");
  person.wait_until([](const WidgetMap& now) { return !now.has("structure_view.picture"); },
                    "the view to close");
  close();
}

TEST_F(WindowTest, FollowsARayStepByStep) {
  Person& person = start({"cow"});
  const Widget picture = person.see("pane.0.picture");
  person.wait_idle();
  person.click(picture.center_x(), picture.center_y());
  WidgetMap map = person.wait_until([](const WidgetMap& now) { return now.has("ray.step"); },
                                    "the ray's steps");
  EXPECT_EQ(map.state("structure.tab.ray"), "on");
  EXPECT_FALSE(map.state("ray.summary").empty());
  const std::string before = map.state("ray.step");
  person.key("Right");
  map = person.wait_until([&](const WidgetMap& now) { return now.state("ray.step") != before; },
                          "the next step");
  EXPECT_EQ(first_number(map.state("ray.step")), first_number(before) + 1);
  person.look_calmly("ray");
  person.key("Left");
  person.see_state("ray.step", before);
  person.key("Escape");
  person.wait_until([](const WidgetMap& now) { return !now.has("ray.step"); }, "the ray to go");
  close();
}

TEST_F(WindowTest, StatisticsNameBothStructures) {
  Person& person = start({"cow"});
  person.choose({"pane.0.structure", "pane.0.structure.kd-sah"});
  person.wait_idle();
  person.click("structure.tab.statistics");
  const WidgetMap map = person.wait_until(
      [](const WidgetMap& now) { return !now.states("statistics.").empty(); }, "statistics");
  EXPECT_FALSE(map.has("statistics.none"));
  person.look_calmly("statistics");
  close();
}

}  // namespace encore::test
