#pragma once

#include "energy/attribution/attribution.h"
#include "energy/attribution/chance.h"

#include <optional>
#include <vector>

namespace encore::energy {

/// What a counter's joules in successive batches of time tell about the load's fluctuation.
struct Batches {
  Chance relative;         ///< of the mean joules an operation (or a second), by that mean
  double effective = 0.0;  ///< independent batches
  std::size_t count = 0;
};

/// Cuts the windows into about 48 batches between updates, none shorter than
/// ten times the age an update can have, lest their edges look like fluctuation; none crosses
/// windows or gaps. `busy` counts the operations; null: joules a second. Nothing below four
/// batches.
std::optional<Batches> batches_of(const SourceInfo& source, const TraceView& trace,
                                  const BusyTimeline* busy, const std::vector<Window>& windows);

/// The same for seconds an operation, which a gauge's watts are multiplied by.
std::optional<Batches> time_batches_of(const BusyTimeline& busy,
                                       const std::vector<Window>& windows);

}  // namespace encore::energy
