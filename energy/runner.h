#pragma once

#include "energy/attribution/attribution.h"
#include "energy/attribution/busy_timeline.h"
#include "energy/clock.h"
#include "energy/plan.h"
#include "energy/sampling/sampler.h"
#include "energy/session.h"
#include "energy/workload.h"

#include <atomic>
#include <functional>
#include <string_view>
#include <vector>

namespace encore::energy {

/// What the runner tells while it runs; each may be empty. All are called between operations,
/// never inside a measured phase.
struct RunObserver {
  std::function<void(const FrameRow&)> on_row;
  /// Share of the plan that is done, in [0, 1], and what is going on: "idle", "warm-up" ...
  std::function<void(double, std::string_view)> on_progress;
  /// Asked after each row once the plan's least time is over, if the plan has an `until`: whether
  /// the result is good enough. Without it such a plan runs to its limit.
  std::function<bool()> enough;
};

/// What a run measures with.
struct RunContext {
  const Clock& clock;
  Seconds session_start;  ///< the clock's time that rows count from
  const std::atomic<bool>& stop;
  RunObserver observer;
  Sampler* sampler = nullptr;      ///< null: there is no power source
  std::vector<std::size_t> total;  ///< its sources whose energies are added
  LiveBusyTime* live = nullptr;    ///< is told which phase runs; may be null
};

/// What was measured of one configuration. Times are the clock's.
struct Measurement {
  std::vector<FrameRow> rows;
  PerPhase<std::uint64_t> phase_counts{};
  bool stopped = false;  ///< the stop flag cut it short
  BusyTimeline busy = BusyTimeline::of_phases();
  Window measured;
  std::vector<Window> idle;
  std::vector<Window> mixed;
};

/// Prepares `workload` and measures it as `plan` says: idle, warm-up, operations, mixed blocks,
/// idle. Once the stop flag is set it returns after the current operation with what it has.
/// Whatever the workload or the observer throws passes through.
Measurement run(Workload& workload, const Plan& plan, const RunContext& context);

}  // namespace encore::energy
