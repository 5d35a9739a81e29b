#pragma once

#include "energy/clock.h"

namespace encore::energy {

/// A clock that moves only when told.
class FakeClock final : public Clock {
 public:
  [[nodiscard]] Seconds now() const override { return now_; }
  void advance(double seconds) { now_ += Seconds(seconds); }
  void sleep_until(Seconds time, const std::atomic<bool>& stop) const override {
    if (!stop && time > now_) now_ = time;
  }

 private:
  mutable Seconds now_{1000.0};
};

}  // namespace encore::energy
