#pragma once

#include "ui/plot/sample_history.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace encore::ui::test {

/// A sample as it was given.
struct Given {
  double time = 0.0;
  double value = 0.0;
  bool changed = true;
  bool gap_before = false;
};

/// A seeded series with gaps, repeated values, equal times and long pauses.
inline std::vector<Given> random_series(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Given> series;
  double time = 1000.0 * part(random) - 500.0;
  double value = 30.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double kind = part(random);
    if (kind > 0.03) time += 0.01 * part(random);
    if (kind > 0.995) time += 20.0 * part(random);
    const bool changed = part(random) < 0.4;
    // What a float holds exactly, so that sums can be compared.
    if (changed) value = std::floor(100.0 * part(random)) + 0.5;
    series.push_back({time, value, changed, part(random) < 0.01});
  }
  return series;
}

inline void fill(SampleHistory& history, const std::vector<Given>& series) {
  for (const Given& s : series) history.add(s.time, s.value, s.changed, s.gap_before);
}

}  // namespace encore::ui::test
