#pragma once

#include "energy/attribution/attribution.h"

#include <cstddef>
#include <vector>

namespace encore::energy {

/// The parts of `within` in which one column of a timeline was busy throughout (98 % of the time)
/// and no other at all, in the order of time; parts that touch are put together.
std::vector<Window> pure_windows(const BusyTimeline& busy, std::size_t column,
                                 const std::vector<Window>& within);

/// Busy seconds of a column in all windows together.
Seconds busy_in(const BusyTimeline& busy, std::size_t column, const std::vector<Window>& windows);

}  // namespace encore::energy
