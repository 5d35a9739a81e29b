#pragma once

#include "energy/phase_log.h"
#include "energy/sampling/trace.h"

#include <span>
#include <vector>

namespace encore::energy {

/// A load over time in equal steps.
struct LoadSignal {
  Seconds start;
  Seconds step;
  std::vector<double> values;  ///< mean over each step; NaN where it is not known
};

/// Mean watts of a trace in each step from its first point to its last; unknown in gaps.
LoadSignal load_of(const TraceView& trace, Seconds step);

/// Share of each step of [from, to] in which one of these spans was busy. Spans come in the order
/// of time and do not overlap.
LoadSignal load_of(std::span<const PhaseSpan> busy, Seconds from, Seconds to, Seconds step);

/// Median time between a trace's points within stretches; 0 if there are none.
Seconds spacing_of(const TraceView& trace);

}  // namespace encore::energy
