// Files that are dropped onto the window, and opened by its browser.
#include "file_drop.h"
#include "window_test.h"

namespace encore::test {

namespace {

constexpr const char* kSquare = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
1 1 0
0 1 0
3 0 1 2
3 0 2 3
)";

}  // namespace

TEST_F(WindowTest, OpensADroppedModel) {
  const auto file = home().write("square of two.ply", kSquare);
  Person& person = start({"cow"});
  const Widget picture = person.see("pane.0.picture");
  ASSERT_TRUE(drop_file(display(), person.window(), file.parent_path() / "square%20of%20two.ply",
                        picture.center_x(), picture.center_y()));
  person.wait_until([](const WidgetMap& map) { return map.state("menu.scene") != "cow"; },
                    "the dropped scene");
  person.wait_idle();
  EXPECT_TRUE(contains(person.map().state("menu.scene"), "square of two"))
      << person.map().state("menu.scene");
  person.look_calmly("dropped");
  close();
}

TEST_F(WindowTest, ABadFileGivesOneLineAndTheSceneStays) {
  const auto file = home().write("bad.ply", "ply\nformat ascii 1.0\nelement vertex many\n");
  Person& person = start({"cow"});
  const Widget picture = person.see("pane.0.picture");
  const Screenshot before = person.look_calmly();
  ASSERT_TRUE(drop_file(display(), person.window(), file, picture.center_x(), picture.center_y()));
  const WidgetMap map =
      person.wait_until([](const WidgetMap& now) { return contains(now.states(""), "bad.ply"); },
                        "a line about the file");
  EXPECT_EQ(map.state("menu.scene"), "cow");
  const Screenshot after = person.look_calmly("bad-file");
  const Area middle{picture.x + picture.width / 4, picture.y + picture.height / 4,
                    picture.width / 2, picture.height / 2};
  EXPECT_LT(difference(before, after, middle), 0.01);
  close();
}

TEST_F(WindowTest, OpensAFileByTheBrowser) {
  home().write("models/square.ply", kSquare);
  Person& person = start({"triangle"});
  person.see("pane.0.picture");
  person.key("Ctrl+o");
  person.click("browser.home");
  person.double_click("browser.entry.models");
  person.look().keep("browser");
  person.click("browser.entry.square.ply");
  person.click("browser.choose");
  person.see_state("menu.scene", "square");
  close();
}

}  // namespace encore::test
