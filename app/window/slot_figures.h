#pragma once

#include "app/window/power_set.h"
#include "app/window/slot_book.h"
#include "energy/attribution/busy_timeline.h"

#include <memory>
#include <string>
#include <vector>

namespace encore::app {

/// Everything a configuration's figures are computed from, as it was at one moment.
struct SlotEvidence {
  Slot slot;                           ///< the latest of its slots
  std::vector<energy::FrameRow> rows;  ///< without their configuration
  energy::PerPhase<std::uint64_t> counts{};
  std::size_t slots = 0;
  energy::BusyTimeline busy = energy::BusyTimeline::of_phases();
  std::shared_ptr<const PowerSet> power;  ///< that energies rest on; null: none is open
  std::vector<energy::Window> measured;   ///< with `power`, one device at a time
  std::vector<energy::Window> idle;       ///< with `power`
  bool overlapped = false;                ///< there were others in which both devices were busy
};

/// The figures of one configuration, all but its convergence. `rows` is not empty.
LiveFigures figures_of(const SlotEvidence& evidence, energy::Seconds now);

/// The counters of a summary in the order of counter_columns(): those given, Mrays/s by the mean
/// time of a render, and place for the energies.
std::vector<energy::Counter> summary_counters(const Slot& slot, const energy::SummaryRow& summary);

/// Attributes one configuration's energy by every source, and puts it into `figures`: summary,
/// phases of the total and of each source, notes. `traces`: one for each of `sources`.
void attribute_sources(const std::vector<energy::SessionSource>& sources,
                       const std::vector<energy::TraceView>& traces,
                       const energy::BusyTimeline& busy,
                       const std::vector<energy::Window>& measured,
                       const std::vector<energy::Window>& idle,
                       const energy::Provenance& provenance, LiveFigures& figures);

}  // namespace encore::app
