#include "panel_test.h"
#include "views.h"

#include <cmath>
#include <utility>

namespace encore::ui {
namespace {

using From = EnergySettings::From;

class EnergyDialog : public PanelTest {
 protected:
  EnergyDialog() { state.dialog = Dialog::energy; }
  void draw() override {
    if (state.dialog == Dialog::energy) draw_energy_dialog(view, state, commands);
  }
  void enter(float idle, float busy) {
    state.sessions.energy.idle_watts = idle;
    state.sessions.energy.busy_watts = busy;
    settle();
  }
};

TEST_F(EnergyDialog, WattsAreAppliedOnlyIfTheyCanBe) {
  click("energy.model");
  EXPECT_EQ(state_of("energy.apply"), "disabled") << "nothing is entered yet";
  for (const auto& [idle, busy] : {std::pair{-1.0F, 20.0F},
                                   {20.0F, 20.0F},
                                   {30.0F, 20.0F},
                                   {0.0F, 0.0F},
                                   {std::nanf(""), 20.0F},
                                   {5.0F, INFINITY}}) {
    enter(idle, busy);
    EXPECT_EQ(state_of("energy.apply"), "disabled") << idle << " " << busy;
    EXPECT_FALSE(state_of("energy.problem").empty());
  }
  click("energy.apply");
  EXPECT_FALSE(last<ApplyEnergy>());
  EXPECT_EQ(state.dialog, Dialog::energy);
  enter(0.0F, 20.0F);
  EXPECT_EQ(state_of("energy.apply"), "") << "0 W idle is a reading";
  EXPECT_EQ(widget("energy.problem"), nullptr);
  enter(7.5F, 21.0F);
  click("energy.apply");
  EXPECT_TRUE(last<ApplyEnergy>());
  EXPECT_EQ(state.settings.energy.from, From::model);
  EXPECT_EQ(state.settings.energy.idle_watts, 7.5F);
  EXPECT_EQ(state.settings.energy.busy_watts, 21.0F);
  EXPECT_EQ(state.dialog, Dialog::none);
}

TEST_F(EnergyDialog, WattsCanBeTyped) {
  click("energy.model");
  click("energy.idle");
  type("6");
  click("energy.busy");
  type("25");
  click("energy.apply");
  EXPECT_TRUE(last<ApplyEnergy>());
  EXPECT_EQ(state.settings.energy.idle_watts, 6.0F);
  EXPECT_EQ(state.settings.energy.busy_watts, 25.0F);
}

TEST_F(EnergyDialog, CancelChangesNothing) {
  state.settings.energy.from = From::automatic;
  const EnergySettings before = state.settings.energy;
  click("energy.model");
  enter(5.0F, 9.0F);
  click("energy.cancel");
  EXPECT_EQ(state.settings.energy, before);
  EXPECT_FALSE(last<ApplyEnergy>());
  EXPECT_EQ(state.dialog, Dialog::none);
}

TEST_F(EnergyDialog, ASensorIsPickedFromWhatTheDoctorFound) {
  view.doctor = doctor_with_obstacles();
  click("energy.chosen");
  EXPECT_EQ(state_of("energy.apply"), "disabled") << "none is named";
  EXPECT_EQ(widget("energy.sensor.rapl:package-0"), nullptr) << "it is not usable";
  click("energy.sensor.battery:BAT0");
  click("energy.apply");
  EXPECT_TRUE(last<ApplyEnergy>());
  EXPECT_EQ(state.settings.energy.from, From::chosen);
  EXPECT_EQ(state.settings.energy.source, "battery:BAT0");
}

TEST_F(EnergyDialog, BeginsWithWhatIsSet) {
  state.settings.energy = {From::model, "", 4.0F, 12.0F};
  state.sessions.energy = {};
  settle();
  EXPECT_EQ(state_of("energy.model"), "on");
  EXPECT_EQ(state_of("energy.idle"), "4.00");
  EXPECT_EQ(state_of("energy.busy"), "12.00");
}

}  // namespace
}  // namespace encore::ui
