#pragma once

#include "energy/attribution/windows.h"

#include <optional>
#include <vector>

namespace encore::energy {

/// A value that a gauge showed from one update to the next.
struct GaugeUpdate {
  Seconds start;
  Seconds length;  ///< inside the window
  double watts = 0.0;
  /// What it counts for: its length, scaled so that every window weighs as much as it is long.
  double weight = 0.0;
};

/// Time between a gauge's updates: as documented, or as seen if that is longer.
Seconds gauge_period(const SourceInfo& source, const TraceView& trace);

/// How long after a change of load a gauge still tells of the load before:
/// max(1.5 periods, 3 time constants), which is 6 s for a battery that updates each 4 s.
Seconds settling_time(const SourceInfo& source, const TraceView& trace);

/// The updates of each window, without those before settling_time() has passed since its start.
/// A value that stands for twice the period or longer is taken as several equal updates.
std::vector<GaugeUpdate> settled_updates(const SourceInfo& source, const TraceView& trace,
                                         const std::vector<Window>& windows);

/// The updates of at least `threshold`, wherever they lie in the windows: a cut that is simple but
/// biased (updates still on their way up or down count, low ones of the load do not). To compare
/// with results that were found so.
std::vector<GaugeUpdate> cut_updates(const SourceInfo& source, const TraceView& trace,
                                     const std::vector<Window>& windows, Watts threshold);

/// The weighted mean of updates, with n_eff = (sum w)^2 / sum w^2 independent values, fewer where
/// the gauge's smoothing (AR(1) with exp(-period / time constant)) or the correlation that is seen
/// makes neighbours alike. Nothing if that leaves less than one and a half.
std::optional<MeanPower> mean_of_updates(const SourceInfo& source, Seconds period,
                                         const std::vector<GaugeUpdate>& updates);

}  // namespace encore::energy
