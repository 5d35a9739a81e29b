#pragma once

#include "energy/phase_log.h"
#include "energy/sources/power_source.h"

#include <cstdint>
#include <span>
#include <vector>

namespace encore::energy {

/// A block of work whose mix of phases was chosen: each phase so many times in a row, then sleep.
struct MixBlock {
  PerPhase<std::size_t> repeats{};
  Seconds sleep;
  /// How long it will take, by the phases' mean times.
  [[nodiscard]] Seconds length(const PerPhase<Seconds>& mean_times) const;
};

/// A block lasts at least so many update periods: less would drown in the timing of updates.
inline constexpr double kLeastBlockPeriods = 5.0;

/// Blocks that let a regression (regression.h) tell phases apart which are shorter than the
/// sensor's update period: a steady loop shows only its mean power. Rounds follow each other; each
/// holds, in random order, one block a phase (only that phase repeated) and one sleep. A block
/// takes at least kLeastBlockPeriods periods, up to 60 % more at random (so that nothing locks to
/// the sensor) and at least half of the longest phase, which balances the columns. Phases without
/// a mean time above 0 are left out.
///
/// As many rounds as fit into `budget`; empty if not even two do or there is no phase (then nothing
/// can be told apart). Equal arguments give equal blocks on every machine.
std::vector<MixBlock> make_mix_blocks(std::span<const Phase> phases,
                                      const PerPhase<Seconds>& mean_times, Seconds update_period,
                                      Seconds budget, std::uint64_t seed);
/// The same for a source: its updates are seen once a poll at best.
std::vector<MixBlock> make_mix_blocks(std::span<const Phase> phases,
                                      const PerPhase<Seconds>& mean_times, const SourceInfo& source,
                                      Seconds budget, std::uint64_t seed);

}  // namespace encore::energy
