#pragma once

#include "energy/attribution/attribution.h"
#include "energy/attribution/busy_timeline.h"
#include "energy/session.h"

#include <span>
#include <vector>

namespace encore::app {

/// What the machine did while a session was measured, as its files tell it.
struct SessionLoad {
  std::vector<energy::PhaseSpan> busy;  ///< in the order of time, not overlapping
  energy::Seconds from;                 ///< start of the first window
  energy::Seconds to;                   ///< end of the last
};

/// Busy and idle times of a session from `since` on. Idle are its idle windows, the pauses between
/// operations, and the cool-down before a configuration; all else (preparing, warming up, mixed
/// blocks) counts as busy. Nothing lies between `from` and `to` if there are no windows.
SessionLoad load_of(const energy::Session& session, energy::Seconds since);

/// When each phase was busy in measured windows, which follow each other, by the rows of
/// frames.csv: a row tells the mean of its operations, so they are laid out alike, one after the
/// other from the row's start, each in the phases' order, none beyond the next row's start.
energy::BusyTimeline busy_in(const std::vector<energy::FrameRow>& frames,
                             std::span<const energy::Window> measured);

}  // namespace encore::app
