#include "app/window/mouse_clicks.h"

#include <gtest/gtest.h>

namespace encore::app {
namespace {

constexpr MouseClicks::Place kHere{200.0, 100.0};

TEST(MouseClicks, AClickWithinOneFrameIsDownForAFrame) {
  MouseClicks clicks;
  clicks.change(0, true, {1.0, 1.0}, kHere);
  clicks.change(0, false, {1.05, 1.05}, kHere);
  EXPECT_TRUE(clicks.more());
  EXPECT_TRUE(clicks.next_frame().down[0]);
  EXPECT_TRUE(clicks.more());
  EXPECT_FALSE(clicks.next_frame().down[0]);
  EXPECT_FALSE(clicks.more());
  EXPECT_FALSE(clicks.next_frame().down[0]);
}

TEST(MouseClicks, ADoubleClickWithinOneFrameIsTwoPresses) {
  MouseClicks clicks;
  for (const bool down : {true, false, true, false}) clicks.change(0, down, {1.0, 1.5}, kHere);
  const bool down[] = {true, false, true, false};
  const bool twice[] = {false, false, true, false};
  for (int frame = 0; frame < 4; ++frame) {
    const MouseClicks::Buttons told = clicks.next_frame();
    EXPECT_EQ(told.down[0], down[frame]) << frame;
    EXPECT_EQ(told.double_click, twice[frame]) << frame;
  }
}

TEST(MouseClicks, ADoubleClickAcrossASlowFrameIsOne) {
  MouseClicks clicks;
  clicks.change(0, true, {1.0, 1.1}, kHere);
  clicks.change(0, false, {1.1, 2.4}, kHere);
  clicks.change(0, true, {1.1, 2.4}, kHere);
  clicks.next_frame();
  clicks.next_frame();
  EXPECT_TRUE(clicks.next_frame().double_click);
}

TEST(MouseClicks, TwoSlowClicksAreTwo) {
  MouseClicks clicks;
  clicks.change(0, true, {1.0, 1.0}, kHere);
  clicks.change(0, false, {1.1, 1.1}, kHere);
  clicks.change(0, true, {1.31, 1.31}, kHere);
  clicks.next_frame();
  clicks.next_frame();
  const MouseClicks::Buttons told = clicks.next_frame();
  EXPECT_TRUE(told.down[0]);
  EXPECT_FALSE(told.double_click);
}

TEST(MouseClicks, TheThirdOfThreeQuickPressesBeginsAnew) {
  MouseClicks clicks;
  for (int press = 0; press < 4; ++press) {
    clicks.change(0, true, {1.0 + 0.1 * press, 1.0 + 0.1 * press}, kHere);
    clicks.change(0, false, {1.05 + 0.1 * press, 1.05 + 0.1 * press}, kHere);
  }
  for (int press = 0; press < 4; ++press) {
    EXPECT_EQ(clicks.next_frame().double_click, press % 2 == 1) << press;
    EXPECT_FALSE(clicks.next_frame().double_click);
  }
}

TEST(MouseClicks, QuickClicksOnTwoPlacesAreTwoAndTheLaterMayBegin) {
  MouseClicks clicks;
  clicks.change(0, true, {1.0, 1.0}, {10.0, 10.0});
  clicks.change(0, false, {1.0, 1.0}, {10.0, 10.0});
  for (const bool down : {true, false, true, false}) clicks.change(0, down, {1.1, 1.1}, kHere);
  const bool twice[] = {false, false, false, false, true, false};
  for (int frame = 0; frame < 6; ++frame) {
    EXPECT_EQ(clicks.next_frame().double_click, twice[frame]) << frame;
  }
}

TEST(MouseClicks, ButtonsAreTheirOwn) {
  MouseClicks clicks;
  clicks.change(0, true, {1.0, 1.0}, kHere);
  clicks.change(1, true, {1.1, 1.1}, kHere);
  clicks.change(99, true, {1.1, 1.1}, kHere);
  const MouseClicks::Buttons told = clicks.next_frame();
  EXPECT_TRUE(told.down[0]);
  EXPECT_TRUE(told.down[1]);
  EXPECT_FALSE(told.double_click);
  EXPECT_FALSE(clicks.more());
}

}  // namespace
}  // namespace encore::app
