#pragma once

#include "energy/clock.h"
#include "energy/units.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// One step size at one time constant.
struct TimeConstantRow {
  Seconds tau;
  Seconds step;
  std::uint64_t steps = 0;  ///< of a fit: the values of the record
  /// The largest relative error met; nothing where the numbers ran over or no time constant could
  /// be told.
  std::optional<double> error;
  std::optional<Seconds> fitted;  ///< of a fit: the time constant; nothing if it was refused
  /// Of a fit: the 95 % interval; if refused, what is known of it (0 and infinity: no limit).
  std::optional<Seconds> low, high;
  Seconds run_time;
  bool stable = true;   ///< false: beyond the scheme's limit for this time constant
  std::string refused;  ///< of a fit: why there is no time constant
};

/// One way of stepping or fitting over all time constants (1 ms to 1e6 s) and steps (1 ms to 10 h),
/// the steps of a time constant after each other.
struct TimeConstantTable {
  std::string method;
  std::string measure;  ///< what the error is of and against which reference
  std::vector<TimeConstantRow> rows;
};

/// Error against step size and time constant, and run time, of what has a time constant beside
/// batteries (step_study.h), against closed forms in extended precision over 10 h or `most_steps`:
/// - the gauge's low pass (low_pass.h) after a step of its load and along a ramp, by exact steps
///   and, as the contrast, explicit Euler steps;
/// - fits of a thermal drift (exponential_fit.h) to records of 600 values at the step's spacing
///   with noise of 1 % of the change: the error of the time constant, or why it cannot be told.
/// `most_steps`: combinations that need more are left out. Equal but for run times on every
/// machine.
std::vector<TimeConstantTable> study_time_constants(const Clock& clock,
                                                    std::uint64_t most_steps = 2'000'000);

}  // namespace encore::energy
