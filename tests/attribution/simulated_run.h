#pragma once

#include "energy/attribution/attribution.h"
#include "energy/sources/simulated.h"

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace encore::energy {

/// Reads a source at its poll period (each poll up to `jitter` late) and right at the times in
/// `also`, as the sampler would.
inline TraceView read_trace(PowerSource& source, Seconds from, Seconds to,
                            std::vector<Seconds> also = {}, double jitter = 0.0,
                            std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> late(0.0, 1.0);
  Trace trace;
  std::size_t next = 0;
  const auto read = [&](Seconds time) {
    const ReadResult result = source.read(time);
    if (result.state == ReadState::ok || result.state == ReadState::restarted) {
      trace.add(result.reading, result.state == ReadState::restarted);
    } else {
      trace.add_gap();
    }
  };
  const Seconds period = source.info().poll_period;
  for (int i = 0; from + period * i <= to; ++i) {
    const Seconds time = from + period * i + Seconds(jitter > 0 ? jitter * late(random) : 0.0);
    for (; next < also.size() && also[next] <= time; ++next) {
      if (also[next] < time) read(also[next]);
    }
    read(time);
  }
  for (; next < also.size(); ++next) read(also[next]);
  return trace.view();
}

/// A made-up load of operations: each takes a time and a power of its own.
struct Load {
  double watts = 30.0;
  double fast = 0.1;      ///< relative sd of an operation's power, independent
  double slow = 0.05;     ///< relative sd of a fluctuation that lasts for some operations
  double slow_phi = 0.9;  ///< its correlation from one operation to the next
  double seconds = 0.05;  ///< of an operation, on average
  double spread = 0.2;    ///< relative sd of that, independent of the power
};

/// Adds operations from `power.end()` on up to `until` to a power curve and a timeline.
inline void add_load(const Load& load, Seconds until, std::mt19937_64& random, StepPower& power,
                     BusyTimeline& busy, std::size_t column) {
  std::normal_distribution<double> normal;
  double slow = normal(random);
  while (power.end() < until) {
    const double length = load.seconds * std::max(0.2, 1.0 + load.spread * normal(random));
    const Seconds start = power.end();
    const Seconds end(std::min(start.value + length, until.value));
    const double watts = load.watts * (1 + load.fast * normal(random) + load.slow * slow);
    power.add(end, Watts(std::max(0.0, watts)));
    busy.add(column, start, end);
    busy.add_operations((end - start).value / length, start, end);
    slow = load.slow_phi * slow + std::sqrt(1 - load.slow_phi * load.slow_phi) * normal(random);
  }
}

/// A fluctuating idle power up to `until`.
inline void add_idle(double watts, Seconds until, std::mt19937_64& random, StepPower& power) {
  std::normal_distribution<double> normal;
  while (power.end() < until) {
    const Seconds end(std::min(power.end().value + 0.2, until.value));
    power.add(end, Watts(std::max(0.0, watts * (1 + 0.1 * normal(random)))));
  }
}

}  // namespace encore::energy
