#pragma once

#include "energy/attribution/busy_timeline.h"
#include "energy/phase_log.h"
#include "energy/sampling/sampler.h"

namespace encore::energy {

/// Shortest phase, in update periods of a source, that is read at its own edges: the edge error is
/// then below 1/(5 sqrt 6) = 8 % for one span, and falls with the number of spans.
inline constexpr double kEdgePeriods = 5.0;

/// Listens to phases for the energy side: tells the live busy time, and reads fast sources right
/// before and after phases that are long against their update period.
class PhaseProbe final : public PhaseListener {
 public:
  /// Either may be null.
  PhaseProbe(Sampler* sampler, LiveBusyTime* live) : sampler_(sampler), live_(live) {}

  /// Learns how long phases take from finished operations.
  void learn(const PhaseSpan& span);
  /// The mean time of a phase so far; 0 if it has not happened.
  [[nodiscard]] Seconds mean(Phase phase) const;
  /// Whether all sources of `total` are read at this phase's edges.
  [[nodiscard]] bool reads_edges(Phase phase, const std::vector<std::size_t>& total) const;

  void before(Phase phase) override { read_edge(phase); }
  void began(Phase phase, Seconds now) override {
    if (live_ != nullptr) live_->begin(phase, now);
  }
  void ended(Phase phase, Seconds now) override {
    if (live_ != nullptr) live_->end(now);
    read_edge(phase);
  }

 private:
  void read_edge(Phase phase);
  [[nodiscard]] Seconds slowest(Phase phase) const { return mean(phase) / kEdgePeriods; }

  Sampler* sampler_;
  LiveBusyTime* live_;
  PerPhase<Seconds> sums_{};
  PerPhase<std::uint64_t> counts_{};
};

}  // namespace encore::energy
