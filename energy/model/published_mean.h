#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace encore::energy {

/// The mean of figures from a published table and two 95 % intervals about it, for checking what a
/// paper states. Unlike estimate_mean() the order of the figures means nothing, so none are taken
/// for alike.
struct PublishedMean {
  std::size_t count = 0;
  double mean = 0.0;
  std::optional<double> standard_deviation;  ///< of the figures, over n - 1; needs two
  std::optional<double> normal_half_width;   ///< 1.96 s / sqrt(n), right for many figures only
  std::optional<double> student_half_width;  ///< t(n - 1) s / sqrt(n)
};

PublishedMean published_mean(std::span<const double> figures);

/// The normal interval of a mean of `count` figures whose deviation is given, perhaps rounded.
double normal_half_width(double standard_deviation, std::size_t count);

}  // namespace encore::energy
