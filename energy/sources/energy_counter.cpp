#include "energy/sources/energy_counter.h"

#include <fmt/format.h>

namespace encore::energy {

EnergyCounter::Growth EnergyCounter::growth(Seconds elapsed, std::uint64_t value) const {
  if (failed_) return {std::nullopt, "readable again after a gap"};
  std::uint64_t counts = 0;
  if (value >= *last_) {
    counts = value - *last_;
  } else if (!traits_.range) {
    return {std::nullopt,
            "the counter started over and its range is unknown, so that this interval is left out"};
  } else if (*last_ > *traits_.range) {
    return {std::nullopt, "the counter started over beyond its stated range"};
  } else {
    counts = value + (*traits_.range - *last_);
  }
  const auto joules = [this](std::uint64_t n) {
    return Joules(static_cast<double>(n) * traits_.unit.value);
  };
  if (traits_.range && traits_.most * elapsed > joules(*traits_.range)) {
    return {std::nullopt,
            fmt::format("{:.0f} s without a reading: the counter may have started over more than "
                        "once",
                        elapsed.value)};
  }
  // An update may fall just inside a short interval, so that it gets two periods more.
  const Seconds generous = elapsed + traits_.update_period * 2.0;
  if (joules(counts) > traits_.most * generous) {
    return {std::nullopt, fmt::format("a jump of {:.4g} J in {:.4g} s is above {:.0f} W: taken for "
                                      "a reset of the counter",
                                      joules(counts).value, elapsed.value, traits_.most.value)};
  }
  return {counts, {}};
}

ReadResult EnergyCounter::update(Seconds now, std::uint64_t value) {
  ReadResult result;
  result.state = ReadState::ok;
  result.reading.time = now;
  if (last_) {
    const Growth grown = growth(now - last_time_, value);
    if (grown.counts) {
      total_ += *grown.counts;
    } else {
      result.state = ReadState::restarted;
      result.message = traits_.place + ": " + grown.problem;
    }
    result.reading.changed = value != *last_;
  }
  result.reading.energy = Joules(static_cast<double>(total_) * traits_.unit.value);
  last_ = value;
  last_time_ = now;
  failed_ = false;
  return result;
}

ReadResult EnergyCounter::fail(ReadState state, const std::string& reason) {
  failed_ = true;
  ReadResult result;
  result.state = state;
  result.message = traits_.place + ": " + reason;
  return result;
}

}  // namespace encore::energy
