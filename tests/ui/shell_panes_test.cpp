// What the whole window says and does about its panes: the pixel under the mouse, panes that are
// off.
#include "tests/ui/shell.h"

#include <memory>

namespace {

using namespace encore;
using namespace encore::ui;
using encore::test::Shell;

TEST_F(Shell, StatusPrefersWorkAndMeasuringToThePixel) {
  view.scene.scene = std::make_shared<scene::Scene>();
  PixelView pixel;
  pixel.x = 5;
  pixel.y = 7;
  view.panes[0].hover = pixel;
  frames(2);
  EXPECT_EQ(find("status.text")->state, "ready") << "the mouse is at no pixel";
  PaneView& pane = view.panes[0];
  pane.texture = 1;
  pane.width = pane.traced_width = 100;
  pane.height = pane.traced_height = 100;
  frames(2);
  const ui::MappedWidget picture = *find("pane.0.picture");
  move(picture.x + 20.0F, picture.y + 20.0F);
  EXPECT_EQ(find("status.text")->state.rfind("pixel 5, 7", 0), 0U);
  view.measure.measuring = true;
  view.measure.doing = "CPU pane, 1.2 s of 3 s";
  frames(2);
  EXPECT_EQ(find("status.text")->state, "measuring: CPU pane, 1.2 s of 3 s");
  view.measure.measuring = false;
  state.settings.panes[0].device = PaneDevice::off;
  frames(2);
  EXPECT_EQ(find("status.text")->state, "ready") << "a pane that is off has no pixels";
}

TEST_F(Shell, PanesThatAreOffAreSwitchedOn) {
  // One that is off leaves its room to the other.
  state.settings.panes[0].device = PaneDevice::off;
  frames(2);
  EXPECT_EQ(find("pane.0.device"), nullptr);
  EXPECT_NE(find("pane.1.device"), nullptr);
  EXPECT_EQ(find("panes.off"), nullptr);
  ASSERT_NE(find("settings.left.device"), nullptr) << "there it is switched on again";
  state.settings.panes[1].device = PaneDevice::off;
  frames(2);
  ASSERT_NE(find("panes.off"), nullptr);
  EXPECT_NE(find("settings.left.device"), nullptr);
  click("panes.off.switch_on.1");
  EXPECT_EQ(state.settings.panes[1].device, PaneDevice::gpu);
  EXPECT_EQ(find("panes.off"), nullptr);
  state.settings.panes[1].device = PaneDevice::off;
  frames(2);
  click("panes.off.switch_on.0");
  EXPECT_EQ(state.settings.panes[0].device, PaneDevice::cpu);
  EXPECT_NE(find("pane.0.device"), nullptr);
}

}  // namespace
