#pragma once

#include "energy/attribution/attribution.h"
#include "energy/attribution/busy_timeline.h"
#include "energy/sampling/trace.h"
#include "energy/sources/power_source.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// What a phase draws above idle.
struct PhaseCoefficient {
  /// Watts above idle with a 95 % interval (of chance alone: the sensor's gain is not in it). Where
  /// `at_bound`, 0 with what it can be at most as half-width. Where the fit has no `idle_watts`,
  /// the phase's whole power. Empty: see `reason`.
  std::optional<Uncertain> watts;
  bool at_bound = false;  ///< the fit stopped at 0: only an upper bound is known
  std::string reason;     ///< why there is no number, or what weakens it; one sentence or empty
};

struct PhaseFit {
  std::vector<PhaseCoefficient> phases;  ///< one a timeline column
  std::optional<Uncertain> idle_watts;   ///< empty: no idle time was seen (a note says so)
  /// Of the mix of phases over five to ten updates each, columns scaled; NaN if nothing could be
  /// judged.
  double condition = std::numeric_limits<double>::quiet_NaN();
  /// Of a counter's cumulative form or a gauge's updates: near 2 if their errors are independent;
  /// NaN if nothing was fitted.
  double durbin_watson = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> notes;  ///< one sentence each
  bool refused = false;            ///< no coefficients: `notes` say why and how to go on
};

/// The power of phases that are shorter than the sensor's update period, from how the energy grew
/// while their mix varied: E(t) = a + P_idle t + sum_k dP_k C_k(t) with C_k the busy time of column
/// k (ALEA, Mukhanov et al. 2015 and 2017; Lang and Ruenger 2013), dP_k >= 0. Uses the sensor's
/// updates inside the `idle` and `loaded` windows; every window and stretch has an intercept of its
/// own. Errors of a counter are those of its edges plus fluctuating power, in the ratio that the
/// data show. A gauge's watts are fitted to busy shares that went through its smoothing
/// (info.smoothing; if 0, the likeliest of several). Time outside all columns counts as idle.
///
/// Two phases that cannot be told apart, beside others that can, get no number each: they are
/// fitted as one column, so that the others keep theirs, and their reason says what they draw
/// together. Refuses where no phase would stand alone (condition above 100, or a mix that varied
/// hardly more than the timing of updates is known, as in a loop in step with the sensor); notes
/// what is uncertain (above 30, or variance inflation above 10). If there is no time without a
/// phase, idle power is part of the phases' watts. Columns that were busy at once get an
/// interaction of their own, which is noted, if it is certain not to be 0.
PhaseFit fit_phases(const SourceInfo& info, const TraceView& trace, const BusyTimeline& timeline,
                    const std::vector<Window>& idle, const std::vector<Window>& loaded);

}  // namespace encore::energy
