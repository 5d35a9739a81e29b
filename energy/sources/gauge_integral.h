#pragma once

#include "energy/sources/power_source.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace encore::energy {

/// Turns a gauge's watts into the cumulative joules that a PowerSource owes: trapezoids between
/// readings. What lies between a failure and the reading after it is unknown and is never filled
/// in: the energy stands still there and the reading says `restarted`.
class GaugeIntegral {
 public:
  /// Two readings further apart than `longest_gap` are not joined either; 0: no limit.
  explicit GaugeIntegral(Seconds longest_gap = Seconds(0)) : longest_gap_(longest_gap) {}

  /// A good reading. `updated`: the sensor is known to have updated although its value may repeat
  /// (it has a time stamp of its own, or another of its values moved). A value that is negative or
  /// no number fails. A time that does not rise adds no energy.
  ReadResult add(Seconds now, Watts value, bool updated = false) {
    if (!std::isfinite(value.value) || value.value < 0) {
      return failed("power reading of " + std::to_string(value.value) +
                    " W makes no sense; skipped");
    }
    ReadResult result;
    result.state = ReadState::ok;
    if (failed_) {
      result.state = ReadState::restarted;
      result.message = "readings are back; the energy in between is unknown";
    } else if (last_ && longest_gap_.value > 0 && now - last_->time > longest_gap_) {
      result.state = ReadState::restarted;
      result.message = "no reading for " + std::to_string((now - last_->time).value) +
                       " s; the energy in between is unknown";
    } else if (last_ && now > last_->time) {
      energy_ += (last_->power + value) * 0.5 * (now - last_->time);
    }
    const bool changed = !last_ || updated || last_->power != value;
    result.reading = {.time = now, .energy = energy_, .power = value, .changed = changed};
    failed_ = false;
    last_ = Point{now, value};
    return result;
  }

  /// No value now: what lies between the last good reading and the next one is a gap.
  ReadResult failed(std::string message) {
    failed_ = last_.has_value();
    ReadResult result;
    result.state = ReadState::failed;
    result.message = std::move(message);
    return result;
  }

  /// No value any more.
  ReadResult lost(std::string message) {
    ReadResult result = failed(std::move(message));
    result.state = ReadState::lost;
    return result;
  }

  /// Joules so far.
  [[nodiscard]] Joules energy() const { return energy_; }

 private:
  struct Point {
    Seconds time;
    Watts power;
  };
  Seconds longest_gap_;
  std::optional<Point> last_;
  Joules energy_;
  bool failed_ = false;
};

}  // namespace encore::energy
