#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace encore::energy {

/// Allan deviation of the means of `m` neighbouring values.
struct AllanPoint {
  std::size_t m = 1;
  double deviation = 0.0;
  std::size_t pairs = 0;  ///< of neighbouring means; few pairs, little trust

  /// Standard error of the deviation, relative, if the means are independent.
  [[nodiscard]] double relative_error() const;
};

/// sigma^2(m) = sum (y_{i+1} - y_i)^2 / (2 (M - 1)) over the M means y of m values each, for
/// m = 1, 2, 4 ... as long as there are two means (Allan 1966). Falls as m^-1/2 for independent
/// values, rises as m^+1/2 for a random walk and as m for a drift. Values at equal distances.
std::vector<AllanPoint> allan_deviation(std::span<const double> values);

/// Exponent b of deviation ~ m^b over the points from `first` to the last one with at least 4
/// pairs, weighted by their pairs; nothing if there are fewer than two such points above 0.
std::optional<double> allan_slope(std::span<const AllanPoint> points, std::size_t first = 0);

/// Where the deviation is least, if it rises behind that by more than chance (three standard
/// errors) and up to the longest means that can be trusted (4 pairs): windows longer than m values
/// tell no more, since drift outweighs what averaging gains. Nothing if no such minimum is seen.
std::optional<AllanPoint> allan_minimum(std::span<const AllanPoint> points);

}  // namespace encore::energy
