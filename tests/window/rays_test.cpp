// Shadows are switched on by hand, and the pictures show them.
#include "window_test.h"

#include <string>

namespace encore::test {

TEST_F(WindowTest, ShadowsDarkenThePictureOfTheDefaultScene) {
  Person& person = start({"toys"});
  const Widget left = person.see("pane.0.picture");
  person.see("rays.shadows");
  const double plain = person.look_calmly("rays-plain").brightness(area_of(left));
  const Widget box = person.see("rays.shadows");
  person.click(box.x + box.height / 2, box.y + box.height / 2);
  person.see_state("rays.shadows", "on");
  person.wait_idle();
  const double shadowed = person.look_calmly("rays-shadows").brightness(area_of(left));
  EXPECT_LT(shadowed, plain - 0.2);
  person.key("Ctrl+z");
  person.see_state("rays.shadows", "off");
  person.wait_idle();
  EXPECT_NEAR(person.look_calmly().brightness(area_of(left)), plain, 0.05);
  close();
}

TEST_F(WindowTest, WhatTheSceneDoesWithoutIsMeasured) {
  Person& person = start({"mug"});
  person.see("pane.0.picture");
  person.wait_idle();
  const Widget head = person.see("settings.scene.left_out");
  person.click(head.x + head.height, head.y + head.height / 2);
  const Widget button = person.see("settings.scene.left_out.measure");
  person.click(button.x + button.width / 2, button.y + button.height / 2);
  person.wait_until(
      [](const WidgetMap& now) {
        const std::string row = "settings.scene.left_out.vertex colours";
        return now.has(row) && (now.state(row).find(" ms (") != std::string::npos ||
                                now.state(row).find("below noise") != std::string::npos);
      },
      "a time beside what is left out");
  close();
}

}  // namespace encore::test
