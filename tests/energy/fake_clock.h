#pragma once

#include "energy/clock.h"

namespace encore::energy {

/// A clock that moves only when told.
class FakeClock final : public Clock {
 public:
  [[nodiscard]] Seconds now() const override { return now_; }
  void advance(double seconds) { now_ += Seconds(seconds); }

 private:
  Seconds now_{1000.0};
};

}  // namespace encore::energy
