#include "energy/convergence/paired_energy.h"

#include <algorithm>
#include <utility>

namespace encore::energy {

namespace {

/// Operations that take longer than this many updates cost detail, never energy.
constexpr std::size_t kMostWaiting = 4096;

}  // namespace

PairedEnergy::PairedEnergy(Seconds start, std::function<void(const EnergyStep&)> on_step)
    : start_(start), on_step_(std::move(on_step)) {}

void PairedEnergy::add_row(Seconds start, Seconds end, double operations) {
  while (!waiting_.empty() && waiting_.front().time <= end) {
    Update update = waiting_.front();
    waiting_.pop_front();
    const double share =
        end > start ? std::clamp((update.time - start) / (end - start), 0.0, 1.0) : 1.0;
    update.operations = operations_ + operations * share;
    settle(update);
  }
  operations_ += operations;
}

void PairedEnergy::settle(Update update) {
  if (last_ && !update.starts_stretch && update.time > last_->time) {
    on_step_({last_->time, update.time, update.energy - last_->energy,
              update.operations - last_->operations});
  }
  last_ = update;
}

void PairedEnergy::add_energy(const TracePoint& point) {
  if (point.time < start_ || !(point.changed || point.starts_stretch)) return;
  const Update update{point.time, point.energy, point.starts_stretch};
  if (waiting_.size() >= kMostWaiting) {
    // Energies are cumulative: leaving out an update in between joins two steps. The first update
    // of a stretch is needed by the ones behind it, but not by the next stretch.
    const bool keep = waiting_.back().starts_stretch && !update.starts_stretch;
    if (!keep) {
      waiting_.back() = update;
      return;
    }
  }
  waiting_.push_back(update);
}

}  // namespace encore::energy
