#pragma once

#include "energy/attribution/busy_timeline.h"

#include <span>
#include <vector>

namespace encore::energy {

/// The busy stretches of one column in the order of time; they do not overlap.
using Activity = std::vector<BusyTimeline::Piece>;

/// Busy seconds between each two neighbours of `edges` (which rise): one value fewer than edges.
std::vector<double> busy_between(const Activity& activity, std::span<const double> edges);

/// The share of time that was busy, as a sensor with first-order smoothing `tau` > 0 shows it at
/// each of `times` (which rise): exact. All was idle before the first piece.
std::vector<double> smoothed_share(const Activity& activity, double tau,
                                   std::span<const double> times);

/// When two columns were certainly busy at once. Where short spans were merged into a share of
/// their stretch, only what cannot have been one after the other counts.
Activity concurrent(const Activity& a, const Activity& b);

}  // namespace encore::energy
