#pragma once

namespace encore::energy {

/// Where `reached` turns true in (low, high]: false up to there, true from there on (`high` counts
/// as true unasked). To the last digit, or as near to it as 300 halvings come.
template <class Predicate>
double first_true(double low, double high, const Predicate& reached) {
  for (int i = 0; i < 300; ++i) {
    const double middle = low + (high - low) / 2.0;
    if (!(middle > low && middle < high)) break;
    (reached(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace encore::energy
