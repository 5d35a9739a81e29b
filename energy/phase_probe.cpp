#include "energy/phase_probe.h"

namespace encore::energy {

void PhaseProbe::learn(const PhaseSpan& span) {
  sums_[span.phase] += span.end - span.start;
  ++counts_[span.phase];
}

Seconds PhaseProbe::mean(Phase phase) const {
  if (counts_[phase] == 0) return Seconds(0);
  return sums_[phase] / static_cast<double>(counts_[phase]);
}

bool PhaseProbe::reads_edges(Phase phase, const std::vector<std::size_t>& total) const {
  if (sampler_ == nullptr || total.empty()) return false;
  for (const std::size_t source : total) {
    if (sampler_->info(source).update_period > slowest(phase)) return false;
  }
  return true;
}

void PhaseProbe::read_edge(Phase phase) {
  if (sampler_ == nullptr) return;
  for (std::size_t i = 0; i < sampler_->source_count(); ++i) {
    if (sampler_->info(i).update_period > slowest(phase)) continue;
    sampler_->read_now(slowest(phase));
    return;
  }
}

}  // namespace encore::energy
