#pragma once

#include "energy/units.h"

#include <optional>
#include <span>
#include <string>

namespace encore::energy {

/// end + change e^(-(t - start) / tau): a machine that warms up, or a gauge that settles after a
/// step of its load.
struct ExponentialFit {
  /// The time constant, and what these three are with it. Empty: see `reason`.
  std::optional<Seconds> tau;
  double end = 0.0;     ///< what the series tends to
  double change = 0.0;  ///< at `start` above the end
  Seconds start;        ///< of the series
  /// The 95 % interval of the time constant, by the profile likelihood: not symmetric. Where only
  /// one side is known (the record is too short, or too coarse), the other is 0 or infinity.
  Seconds tau_low;
  Seconds tau_high;
  double deviation = 0.0;          ///< standard deviation about the fit
  double effective_samples = 0.0;  ///< of the deviations from it
  /// Why there is no time constant, in one sentence: nothing changes, the record is too short for
  /// it (it is at least tau_low), or too coarse (it is at most tau_high).
  std::string reason;

  /// How long after `start` only `share` of the change is left; nothing without a time constant.
  [[nodiscard]] std::optional<Seconds> settled_to(double share) const;
};

/// Least squares over times (s, rising strictly) and values, all finite; else, or with fewer than
/// 8, a reason only. Variable projection (Golub and Pereyra 1973): for each tau the two amplitudes
/// follow linearly, so that one unknown is left, log tau, which is searched over all that the times
/// can show and well beyond. Straight lines (tau beyond the record) and a first value that stands
/// alone (tau below the spacing) are its limits: where they fit about as well, no tau is given.
/// Correlated deviations count as fewer (estimate_mean()). Takes about 300 passes over the series.
ExponentialFit fit_exponential(std::span<const double> times, std::span<const double> values);

}  // namespace encore::energy
