#pragma once

#include "energy/convergence/convergence.h"

#include <optional>
#include <string>

namespace encore::energy {

/// Measure until the mean is known well enough.
struct StopRule {
  ConvergenceQuantity quantity = ConvergenceQuantity::time_per_operation;
  /// Half-width of the 95 % interval by the mean.
  double target = 0.01;
  /// Against stopping by luck: an interval from few samples is itself poorly known, and whoever
  /// looks often catches it when it happens to be narrow. So the target must be met with at least
  /// so many effective samples, at two assessments in a row, and with something to spare: the
  /// half-width times 1 + sqrt(1.25 / effective samples), half its own standard error. No rule sees
  /// fluctuation that is slower than what was measured so far: give a least time for that.
  double least_effective_samples = 40.0;
  /// Gives up after so long; empty: never.
  std::optional<Seconds> limit;
};

enum class StopState {
  measuring,     ///< not there yet
  reached,       ///< known well enough: stop
  out_of_reach,  ///< as things stand, going on does not help; `words` says why
};

/// How a measurement stands against its rule.
struct StopOutlook {
  StopState state = StopState::measuring;
  /// Elapsed time at which the rule will be met as it looks now, the second assessment included;
  /// empty while too little is known, or if it never will be.
  std::optional<Seconds> predicted;
  /// One sentence for people: "±1 % needs about 212 s", or why it cannot be had.
  std::string words;
};

/// Judges the tracker's latest assessments; cheap. Ask anew whenever add_row() says there are new
/// ones: nothing is final but `reached`.
StopOutlook outlook(const StopRule& rule, const ConvergenceTracker& tracker);

}  // namespace encore::energy
