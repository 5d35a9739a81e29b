#pragma once

#include "energy/attribution/attribution.h"
#include "energy/attribution/chance.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// Mean power over some windows, as one source tells it. The sensor's gain, which scales all
/// figures of a source alike, is left out.
struct MeanPower {
  double watts = 0.0;
  /// Of the mean over exactly these windows: update edges, rounding, and for a gauge the scatter of
  /// its updates.
  Chance realised;
  /// Of the mean that windows of this kind have in the long run: also the load's fluctuation. Equal
  /// to `realised` if there is too little to tell.
  Chance long_run;
  Seconds length;                  ///< of the windows
  Seconds covered;                 ///< of them, between updates that lie in one and the same window
  double effective_samples = 0.0;  ///< independent updates or batches
};

/// Windows that follow each other without a break, put together; empty ones dropped. In order.
std::vector<Window> join_windows(std::vector<Window> windows);
Seconds length_of(const std::vector<Window>& windows);

/// A number and its half-width with the sensor's gain (a standard uncertainty, relative) added.
Uncertain with_gain(double value, double half_width, double gain);

/// Mean power of a source over `windows`.
///
/// A counter is read at the updates inside a window: the first after its start and the last before
/// its end. Each is up to one update period Tu (or one poll, if that is shorter) old by then, so a
/// difference of two is off by a triangular error of standard deviation P Tu / sqrt(6), and by
/// another of q / sqrt(6) for the counter's step q. What is left at the edges and in gaps takes the
/// mean power of the window's rest, with the uncertainty of the fluctuation seen.
///
/// A gauge is the mean of its settled updates (gauge_updates.h).
///
/// Nothing, and one sentence in `why`, if less than half of the time (a quarter for a gauge) can be
/// covered, or there are too few updates.
std::optional<MeanPower> mean_power(const SourceInfo& source, const TraceView& trace,
                                    const std::vector<Window>& windows, std::string& why);

}  // namespace encore::energy
