// Error against run time, as a person asks for it.
#include "window_test.h"

namespace encore::test {

TEST_F(WindowTest, AccuracyShowsErrorsThenTimesAndStops) {
  Person& person = start({"mug", "--model", "idle=12,render=30"});
  person.wait_idle();
  person.key("Ctrl+e");
  person.see("accuracy.start");
  person.see("accuracy.device.cpu");
  const Widget side = person.see("accuracy.side");
  EXPECT_EQ(side.state, "256");
  person.click("accuracy.structure.kd-sah");
  person.click("accuracy.samples.16");
  person.click("accuracy.start");
  person.see("accuracy.stop");
  person.see("accuracy.row.5");
  EXPECT_FALSE(person.map().has("accuracy.row.6")) << "three modes of 1 and 4 samples";
  person.see("accuracy.by_joules");
  person.wait_until([](const WidgetMap& map) { return map.has("accuracy.start"); },
                    "accuracy comes to an end");
  person.click("accuracy.by_joules");
  EXPECT_EQ(person.see("accuracy.origin").state, "modelled");
  person.click("accuracy.start");
  person.click("accuracy.stop");
  person.see("accuracy.start");
  person.key("Ctrl+e");
  close();
}

}  // namespace encore::test
