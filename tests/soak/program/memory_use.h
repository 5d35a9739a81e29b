#pragma once

#include <cstdint>
#include <span>

namespace encore::test {

/// What the process holds.
struct MemoryUse {
  std::uint64_t resident = 0;  ///< bytes of /proc/self/statm
  /// Bytes that were asked for and not given back, all libraries' together: the allocator's own
  /// count (of a sanitizer, where there is one).
  std::uint64_t in_use = 0;
};
MemoryUse memory_use();

/// What the least-squares line through values one round apart says.
struct Drift {
  double per_round = 0.0;  ///< its slope
  double whole = 0.0;      ///< from the first value to the last, as a share of their mean
};
/// Of at least two values.
Drift drift_of(std::span<const double> values);

}  // namespace encore::test
