#include "tests/attribution/simulated_run.h"

#include <gtest/gtest.h>

namespace encore::energy {
namespace {

TEST(OnlyPhase, ItsPausesAreIdleAndNotItsOwn) {
  // Too short for the sensor: 3.84 ms of work at 40 W, 0.16 ms of pause at 10 W.
  StepPower power(Seconds(0), Watts(10));
  BusyTimeline busy({"build"}, Seconds(0.0001));
  power.add(Seconds(10), Watts(10));
  for (int i = 0; i < 5000; ++i) {
    const Seconds start = Seconds(10) + Seconds(0.004) * i;
    power.add(start + Seconds(0.00384), Watts(40));
    power.add(start + Seconds(0.004), Watts(10));
    busy.add(0, start, start + Seconds(0.00384));
    busy.add_operations(1, start, start + Seconds(0.00384));
  }
  power.add(Seconds(1000), Watts(10));
  SimulatedSettings settings = simulated_preset("nvml");
  settings.info.gain_uncertainty = 0.0;
  settings.energy_until = [&](Seconds time) { return power.energy_until(time); };
  SimulatedSource source(settings);
  AttributionInput input;
  input.source = &source.info();
  input.trace = read_trace(source, Seconds(0), Seconds(40));
  input.busy = &busy;
  input.measured = {{Seconds(10), Seconds(30)}};
  input.idle = {{Seconds(0), Seconds(10)}, {Seconds(30), Seconds(40)}};
  const Attribution found = attribute(input);
  ASSERT_EQ(found.phases.size(), 1U);
  const PhaseEnergy& phase = found.phases[0];
  EXPECT_EQ(phase.method, AttributionMethod::whole);
  EXPECT_NEAR(phase.watts->value, 40, 1.5 * phase.watts->half_width + 0.05);
  EXPECT_LT(phase.watts->half_width, 0.8) << "the window's mean is 38.8 W";
  EXPECT_NEAR(phase.gross->value + found.remainder->value, found.gross->value, 1e-9);
  EXPECT_NEAR(found.remainder->value, 0.8 * 10, 0.1);
}

}  // namespace
}  // namespace encore::energy
