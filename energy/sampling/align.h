#pragma once

#include "energy/sampling/load_signal.h"

#include <optional>
#include <span>
#include <string>

namespace encore::energy {

/// How a recording's clock lies to the session's.
struct Alignment {
  Seconds offset;       ///< add it to the recording's times to get the session's
  Seconds uncertainty;  ///< standard, of the offset
  double correlation = 0.0;
  Seconds overlap;  ///< time that both cover then
};

struct AlignmentSettings {
  /// Below this correlation the recording is taken to show another load.
  double least_correlation = 0.6;
  /// The least share of the shorter one that the other must cover.
  double least_overlap = 0.75;
  /// What is known beforehand: the offset lies within `range` of `near`. Resolves repeating loads.
  std::optional<Seconds> near;
  Seconds range{60.0};
};

/// An alignment, or why there is none.
struct AlignmentResult {
  std::optional<Alignment> alignment;
  std::string reason;  ///< one sentence with the way out; empty if aligned
};

/// Finds the offset at which a recording's steps of load fit best to those of another trace of the
/// session (least squares over shift, height and gain: the peak of the normalised
/// cross-correlation, coarse to fine, with a parabola through its top). Refuses where the best fit
/// is poor, or where another shift leaves less than 1.5 times as much unexplained: a load that
/// repeats itself fits in many places. A delay of the
/// meter itself is part of the offset. Clocks that run at different speeds are not corrected; 50
/// millionths are 0.2 s in an hour.
AlignmentResult align(const TraceView& reference, const TraceView& recording,
                      const AlignmentSettings& settings = {});

/// The same against the session's busy and idle times in [from, to]; spans in the order of time.
AlignmentResult align(std::span<const PhaseSpan> busy, Seconds from, Seconds to,
                      const TraceView& recording, const AlignmentSettings& settings = {});

}  // namespace encore::energy
