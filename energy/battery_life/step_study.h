#pragma once

#include "energy/battery_life/battery.h"
#include "energy/clock.h"
#include "energy/units.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// One step size of one way of stepping.
struct StepRow {
  Seconds step;  ///< infinite: limited by the charge taken, as forecasts do (StepLimits)
  std::uint64_t steps = 0;
  /// The largest relative error met; nothing where the numbers ran over, or the step was left out.
  std::optional<double> error;
  Seconds run_time;
  bool stable = true;     ///< false: beyond the scheme's limit for this battery
  bool left_out = false;  ///< too many steps
};

/// One way of stepping over all sizes.
struct StepTable {
  std::string method;
  std::string measure;  ///< what the error is of and against which reference
  std::vector<StepRow> rows;
};

/// Error against step size, 1 ms to 10 h, and run time of the models that step, from a full
/// battery:
/// - kinetic and Thevenin at a constant current (half the charge in 10 h) against their closed form
///   in extended precision, by exact steps and, as the contrast, by explicit Euler steps;
/// - Thevenin at the constant power `load`: time to the end against the Richardson limit of small
///   steps, with the charge taken in a step unlimited; last, as forecasts choose the steps.
/// `most_steps`: combinations that need more are left out. Throws std::invalid_argument for a
/// faulty battery.
std::vector<StepTable> study_steps(const Battery& battery, Watts load, const Clock& clock,
                                   std::uint64_t most_steps = 40'000'000);

}  // namespace encore::energy
