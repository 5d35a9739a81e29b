#pragma once

#include "energy/clock.h"
#include "energy/sampling/sampler.h"

#include <algorithm>

namespace encore::energy {

/// A clock that only moves when it is told to, or slept on, and polls a sampler on its way as the
/// sampler's thread would.
class SamplingClock final : public Clock {
 public:
  [[nodiscard]] Seconds now() const override { return now_; }
  void attach(Sampler* sampler) { sampler_ = sampler; }
  void advance(Seconds time) const { go_to(now_ + time); }
  void sleep_until(Seconds time, const std::atomic<bool>& stop) const override {
    if (!stop) go_to(time);
  }

 private:
  void go_to(Seconds time) const {
    while (sampler_ != nullptr && !polling_ && next_ <= time) {
      now_ = std::max(now_, next_);
      polling_ = true;  // the sampler asks this clock for the time
      next_ = sampler_->poll();
      polling_ = false;
    }
    now_ = std::max(now_, time);
  }

  mutable Seconds now_{1000.0};
  mutable Seconds next_{1000.0};
  mutable bool polling_ = false;
  Sampler* sampler_ = nullptr;
};

}  // namespace encore::energy
