#pragma once

#include "energy/attribution/activity.h"
#include "energy/attribution/attribution.h"
#include "energy/attribution/householder.h"
#include "energy/sampling/trace.h"
#include "energy/sources/power_source.h"

#include <string>
#include <vector>

namespace encore::energy {

/// What a regression is made of: one row an update of the sensor.
///
/// A counter's row is the joules since the update before and, a column, the seconds of it that the
/// column was busy; the last column holds all seconds. A gauge's row is the watts it shows and, a
/// column, the share of time that the sensor can have seen it busy; the last column is 1.
struct FitRows {
  DenseMatrix columns;
  DenseMatrix
      timing;  ///< how far each column's value changes over the time that an update may lie in
  std::vector<double> values;
  std::vector<double> lengths;       ///< seconds since the update before
  std::vector<double> noise;         ///< variance of a row's own error; any common factor
  std::vector<bool> starts;          ///< the row does not follow the one before it
  std::vector<double> edges_before;  ///< variance of a counter's timing error at the row's start,
  std::vector<double> edges_after;   ///< and at its end; any common factor
  std::vector<double> jitter;        ///< seconds in which the update at the row's end may lie

  [[nodiscard]] std::size_t size() const { return values.size(); }
};

/// The rows of a counter's updates inside the windows. Each window and each stretch of the trace
/// stands alone. `lag` in [0, 1]: how much of the time in which an update may lie (since the
/// reading before, at most an update period) has passed when it is read.
FitRows counter_rows(const SourceInfo& info, const TraceView& trace,
                     const std::vector<Activity>& activities, const std::vector<Window>& windows,
                     double lag);

/// What a gauge does to the power before it shows it.
struct GaugeKernel {
  double window = 0.0;     ///< mean over so many seconds before the update, or
  double smoothing = 0.0;  ///< if > 0: first-order low pass of this time constant
  /// Seconds after a change of load until what is shown has forgotten the time before.
  [[nodiscard]] double settling() const { return smoothing > 0.0 ? 3.0 * smoothing : window; }
};

/// The rows of a gauge's updates inside the windows, from `settling` seconds after their starts on.
/// A value that stays for two update periods and longer hides updates that repeat it: a row each.
FitRows gauge_rows(const TraceView& trace, const std::vector<Activity>& activities,
                   const std::vector<Window>& windows, const GaugeKernel& kernel, double settling,
                   double period);

/// Rows whose columns are sums: `groups` lists those of each, in order; the last column (all time)
/// stays as it is, where there is one column more than the groups hold.
FitRows merge_columns(const FitRows& rows, const std::vector<std::vector<std::size_t>>& groups);

}  // namespace encore::energy
