#pragma once

#include "energy/attribution/windows.h"

#include <optional>
#include <string>
#include <vector>

namespace encore::energy {

/// An idle baseline and what chance does to it.
struct IdleEstimate {
  IdleBaseline baseline;
  Chance chance;  ///< of baseline.watts
};

/// The idle power that the load is measured against, as it was at time `at` (the middle of the
/// load). Idle windows before and after it are joined by a straight line; windows on one side only
/// are averaged. Its chance is that of the long run: the baseline speaks for a time when it could
/// not be seen.
///
/// Drift is post minus pre, or the later half minus the earlier one. Where it is more than three
/// standard uncertainties, the baseline is flagged and half the spread of a uniform distribution
/// between the two (|drift| / sqrt(12)) goes into its half-width, since the way between them is not
/// known to be straight.
///
/// Nothing, and a sentence in `why`, without idle windows that the source can resolve.
std::optional<IdleEstimate> idle_baseline(const SourceInfo& source, const TraceView& trace,
                                          const std::vector<Window>& idle, Seconds at,
                                          std::string& why);

}  // namespace encore::energy
