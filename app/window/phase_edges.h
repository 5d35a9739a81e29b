#pragma once

#include "app/window/power_hub.h"
#include "energy/phase_probe.h"

#include <array>
#include <memory>

namespace encore::app {

/// Listens to the phases of one device: notes them in the busy marks, and reads fast sources right
/// before and after phases that are long against their update period.
class PhaseEdges final : public energy::PhaseListener {
 public:
  PhaseEdges(Device device, std::shared_ptr<PowerHub> hub, std::shared_ptr<BusyMarks> busy)
      : device_(device), hub_(std::move(hub)), busy_(std::move(busy)) {}

  void before(energy::Phase phase) override { read_edge(phase); }
  void began(energy::Phase phase, energy::Seconds now) override {
    began_ = now;
    busy_->begin(device_, phase, now);
  }
  void ended(energy::Phase phase, energy::Seconds now) override {
    busy_->end(device_, now);
    // Recent ones count most: settings change while the window is open.
    energy::Seconds& mean = mean_[phase];
    constexpr double kWeight = 0.2;
    mean = mean.value > 0 ? mean + (now - began_ - mean) * kWeight : now - began_;
    read_edge(phase);
  }

 private:
  void read_edge(energy::Phase phase) {
    const energy::Seconds slowest = mean_[phase] / energy::kEdgePeriods;
    if (!(slowest.value > 0)) return;
    const auto set = hub_->current();
    if (!set || !set->sampler) return;
    for (const energy::SessionSource& source : set->sources) {
      if (source.info.update_period > slowest) continue;
      set->sampler->read_now(slowest);
      hub_->last_edge = hub_->clock().now().value;
      return;
    }
  }

  Device device_;
  std::shared_ptr<PowerHub> hub_;
  std::shared_ptr<BusyMarks> busy_;
  energy::PerPhase<energy::Seconds> mean_{};
  energy::Seconds began_;
};

}  // namespace encore::app
