#pragma once

#include "energy/sources/power_source.h"

#include <cstdint>
#include <optional>
#include <string>

namespace encore::energy {

/// Turns the values of a hardware counter, which starts over at its range, into joules that never
/// fall. What cannot be known (a reset, a missed wrap, an impossible jump) restarts; it is never
/// guessed and never negative.
class EnergyCounter {
 public:
  struct Traits {
    Joules unit;  ///< of one count
    /// The counter starts over behind this value; nothing: unknown, so that a fall is a gap.
    std::optional<std::uint64_t> range;
    /// More than that is no load but a reset.
    Watts most{1000.0};
    Seconds update_period{0.001};
    std::string place;  ///< begins every message
  };
  explicit EnergyCounter(Traits traits) : traits_(std::move(traits)) {}

  /// Takes a value that was read at `now`. The first is `ok` with 0 J.
  ReadResult update(Seconds now, std::uint64_t value);
  /// Notes that there was no value, for this reason: the next one restarts.
  ReadResult fail(ReadState state, const std::string& reason);

 private:
  /// Counts since the last value, or why they are unknown.
  struct Growth {
    std::optional<std::uint64_t> counts;
    std::string problem;
  };
  [[nodiscard]] Growth growth(Seconds elapsed, std::uint64_t value) const;

  Traits traits_;
  std::optional<std::uint64_t> last_;
  Seconds last_time_;
  std::uint64_t total_ = 0;
  bool failed_ = false;
};

}  // namespace encore::energy
