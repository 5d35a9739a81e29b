#pragma once

#include "energy/clock.h"
#include "energy/plan.h"
#include "energy/session.h"
#include "energy/workload.h"

#include <atomic>
#include <functional>
#include <vector>

namespace encore::energy {

/// What the runner tells while it runs; either may be empty. Both are called between operations,
/// never inside a measured phase.
struct RunObserver {
  std::function<void(const FrameRow&)> on_row;
  /// Share of the plan that is done, in [0, 1], warm-up included.
  std::function<void(double)> on_progress;
};

/// What was measured of one configuration.
struct Measurement {
  std::vector<FrameRow> rows;
  PerPhase<std::uint64_t> phase_counts{};
  bool stopped = false;  ///< the stop flag cut it short
};

/// Prepares `workload`, warms it up and measures it as `plan` says. Once `stop` is set it returns
/// after the current operation with what it has. `session_start`: the clock's time that rows count
/// from. Whatever the workload or the observer throws passes through.
Measurement run(Workload& workload, const Plan& plan, const Clock& clock, Seconds session_start,
                const std::atomic<bool>& stop, const RunObserver& observer);

}  // namespace encore::energy
