#include "panel_test.h"
#include "views.h"

namespace encore::ui {
namespace {

class Doctor : public PanelTest {
 protected:
  Doctor() { state.doctor_open = true; }
  void draw() override { draw_doctor_window(view, state, commands); }
};

TEST_F(Doctor, RunsAndStops) {
  click("doctor.run");
  auto examine = last<ExamineSensors>();
  ASSERT_TRUE(examine);
  EXPECT_FALSE(examine->stop);
  view.doctor.work.active = true;
  view.doctor.work.progress = 0.5;
  settle();
  EXPECT_EQ(widget("doctor.run"), nullptr);
  EXPECT_EQ(state_of("doctor.progress"), "50 %");
  click("doctor.stop");
  examine = last<ExamineSensors>();
  ASSERT_TRUE(examine);
  EXPECT_TRUE(examine->stop);
}

TEST_F(Doctor, OnlyUsableSensorsCanBeUsed) {
  view.doctor = doctor_with_obstacles();
  settle();
  EXPECT_EQ(state_of("doctor.sensor.rapl:package-0"), "not usable");
  EXPECT_EQ(widget("doctor.use.rapl:package-0"), nullptr);
  click("doctor.use.battery:BAT0");
  EXPECT_TRUE(last<ApplyEnergy>());
  EXPECT_EQ(state.settings.energy.from, EnergySettings::From::chosen);
  EXPECT_EQ(state.settings.energy.source, "battery:BAT0");
  settle();
  EXPECT_EQ(state_of("doctor.use.battery:BAT0"), "on");
  click("doctor.automatic");
  EXPECT_TRUE(last<ApplyEnergy>());
  EXPECT_EQ(state.settings.energy.from, EnergySettings::From::automatic);
}

TEST_F(Doctor, TheCopiedTextHoldsObstaclesAndWaysOut) {
  view.doctor = doctor_with_obstacles();
  view.power = {energy::Origin::unavailable, kNoSensor};
  EXPECT_EQ((settle(), state_of("doctor.total")), "unavailable");
  click("doctor.copy");
  const auto copy = last<CopyText>();
  ASSERT_TRUE(copy);
  for (const SensorRow& sensor : view.doctor.sensors) {
    EXPECT_NE(copy->text.find(sensor.name), std::string::npos);
    EXPECT_NE(copy->text.find(sensor.obstacle), std::string::npos);
    EXPECT_NE(copy->text.find(sensor.way_out), std::string::npos);
  }
  EXPECT_NE(copy->text.find("11.25 W"), std::string::npos);
  EXPECT_NE(copy->text.find(std::string("total: unavailable: ") + kNoSensor), std::string::npos);
}

TEST_F(Doctor, ASensorWithoutAReadingHasNoNumber) {
  view.doctor = doctor_with_obstacles();
  view.doctor.sensors.resize(1);
  view.doctor.sensors[0].name = "battery";
  view.doctor.sensors[0].place = "power supply";
  view.doctor.sensors[0].watts.reset();
  view.doctor.sensors[0].period.clear();
  view.doctor.opengl.clear();
  click("doctor.copy");
  const auto copy = last<CopyText>();
  ASSERT_TRUE(copy);
  EXPECT_FALSE(has_digit(copy->text)) << copy->text;
}

TEST_F(Doctor, ShowsOpenGlAsOneBlockThatBreaksItsLines) {
  view.doctor = doctor_with_obstacles();
  view.doctor.opengl = {"llvmpipe, OpenGL 4.5, software",
                        std::string(400, 'x') + " " + std::string(40, 'y')};
  settle();
  EXPECT_EQ(state_of("doctor.opengl"), view.doctor.opengl[0] + "\n" + view.doctor.opengl[1]);
  const MappedWidget* block = widget("doctor.opengl");
  const MappedWidget* window = widget("doctor.window");
  EXPECT_GT(block->height, 3.0F * ImGui::GetFontSize());
  EXPECT_LE(block->x + block->width, window->x + window->width);
  EXPECT_LE(block->y + block->height, window->y + window->height);
}

TEST_F(Doctor, LeadsToTheWatts) {
  click("doctor.watts");
  EXPECT_EQ(state.dialog, Dialog::energy);
}

}  // namespace
}  // namespace encore::ui
