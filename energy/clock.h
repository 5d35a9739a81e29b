#pragma once

#include "energy/units.h"

#include <chrono>

namespace encore::energy {

/// A clock that never runs backwards. Tests put their own in its place.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Seconds since some fixed moment; a double resolves a nanosecond for 100 days of uptime.
  [[nodiscard]] virtual Seconds now() const = 0;
};

/// The system's monotonic clock.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] Seconds now() const override {
    const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
    return Seconds(std::chrono::duration<double>(since_start).count());
  }
};

}  // namespace encore::energy
