#pragma once

#include "energy/units.h"

#include <cstdint>

namespace encore::energy {

/// How one configuration is measured: warm up, then measure.
struct Plan {
  /// Operations that are not measured: until both this long and this many. They fill caches and
  /// pools and let the clock frequency settle; too short, and the first rows come out slow.
  Seconds warm_up{0.2};
  std::uint64_t warm_up_operations = 1;
  /// Measured: until both this long and this many operations. Longer narrows the confidence
  /// interval with the square root of the time.
  Seconds run{1.5};
  std::uint64_t min_operations = 3;
  /// Stops earlier, after this many measured operations; 0: no limit.
  std::uint64_t max_operations = 0;
  /// A row holds one operation, or as many as it takes to fill this time, so that rows stay
  /// bounded (100 a second) however short operations are.
  Seconds row{0.010};

  friend bool operator==(const Plan&, const Plan&) = default;
};

}  // namespace encore::energy
