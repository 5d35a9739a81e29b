#pragma once

#include "energy/units.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace encore::energy {

/// A clock that never runs backwards. Tests put their own in its place.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Seconds since some fixed moment; a double resolves a nanosecond for 100 days of uptime.
  [[nodiscard]] virtual Seconds now() const = 0;
  /// Returns at `time`, or soon after `stop` is set.
  virtual void sleep_until(Seconds time, const std::atomic<bool>& stop) const = 0;
};

/// The system's monotonic clock.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] Seconds now() const override {
    const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
    return Seconds(std::chrono::duration<double>(since_start).count());
  }
  void sleep_until(Seconds time, const std::atomic<bool>& stop) const override {
    constexpr Seconds kLongestNap(0.05);
    for (Seconds left = time - now(); left.value > 0 && !stop; left = time - now()) {
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, kLongestNap).value));
    }
  }
};

}  // namespace encore::energy
