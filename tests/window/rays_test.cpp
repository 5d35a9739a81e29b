// Shadows are switched on by hand, and the pictures show them.
#include "window_test.h"

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

}  // namespace encore::test
