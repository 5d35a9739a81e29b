#include "tests/attribution/simulated_run.h"

#include <gtest/gtest.h>

namespace encore::energy {
namespace {

/// The thesis' protocol: 10 s idle, 180 s of load, 10 s idle, a smoothed gauge read at 1 Hz.
Attribution measure(double idle, double load, std::optional<Watts> cut) {
  StepPower power(Seconds(0), Watts(idle));
  power.add(Seconds(10), Watts(idle));
  power.add(Seconds(190), Watts(load));
  power.add(Seconds(1000), Watts(idle));
  SimulatedSettings settings = simulated_preset("battery");
  settings.energy_until = [&](Seconds time) { return power.energy_until(time); };
  settings.info.smoothing = Seconds(4.0);
  settings.info.poll_period = Seconds(1.0);
  SimulatedSource gauge(settings);
  BusyTimeline busy({"build"});
  busy.add(0, Seconds(10), Seconds(190));
  busy.add_operations(180, Seconds(10), Seconds(190));
  AttributionInput input;
  input.source = &gauge.info();
  input.trace = read_trace(gauge, Seconds(0), Seconds(200));
  input.busy = &busy;
  input.measured = {{Seconds(10), Seconds(190)}};
  input.idle = {{Seconds(0), Seconds(10)}, {Seconds(190), Seconds(200)}};
  input.cut_below = cut;
  return attribute(input);
}

TEST(ThesisCut, IsBiasedAndTellsTheSettledMeanBesideIt) {
  const Attribution settled = measure(18, 60, std::nullopt);
  const Attribution cut = measure(18, 60, Watts(24));
  ASSERT_TRUE(settled.watts && cut.watts);
  EXPECT_NEAR(settled.watts->value, 60, 0.005 * 60);
  EXPECT_LT(cut.watts->value, 60 - 0.01 * 60) << "rising updates count as load";
  bool told = false;
  for (const std::string& note : cut.notes) {
    told = told ||
           note.find("by the cut below 24 W, which is biased; by settled updates 59.") !=
               std::string::npos ||
           note.find("by settled updates 60") != std::string::npos;
  }
  EXPECT_TRUE(told);
}

TEST(ThesisCut, LeavesNothingOfALoadBelowIt) {
  const Attribution cut = measure(10, 20, Watts(24));
  EXPECT_TRUE(cut.watts) << "the settled mean stays";
  bool told = false;
  for (const std::string& note : cut.notes) {
    told = told || note.find("too few updates of at least 24 W") != std::string::npos;
  }
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace encore::energy
