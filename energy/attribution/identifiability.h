#pragma once

#include "energy/attribution/fit_rows.h"

#include <string>
#include <vector>

namespace encore::energy {

/// Condition numbers (columns scaled to length 1) up to which a fit is sound, and from which on it
/// is none.
inline constexpr double kSoundCondition = 30.0;
inline constexpr double kWorstCondition = 100.0;
/// Columns that are known worse than this (Identifiability::timing) bias the fit.
inline constexpr double kMostTiming = 0.1;
/// From this variance inflation on, a column is named together with its partner.
inline constexpr double kHighInflation = 10.0;

/// Whether rows can tell their columns apart.
struct Identifiability {
  double condition = 1.0;  ///< infinity if columns depend on each other
  /// Of the weakest mix: the part of its variance that the timing of updates alone can make.
  double timing = 0.0;
  std::vector<double> inflation;  ///< a column: variance against a column that stands alone
  /// The columns that cannot, or hardly, be told apart: as pairs, or (if no two of them are alike)
  /// all that take part.
  std::vector<std::vector<std::size_t>> alike;
};

/// Judges the mix of columns over stretches of five to ten updates: what varies less than the
/// timing of updates is no information, so a steady loop of phases far below the update period is
/// seen as the constant mix that it is.
Identifiability identifiability(const FitRows& rows);

/// "build and render always ran in the same proportion: cannot be told apart"; `names`: a column.
std::string describe(const std::vector<std::size_t>& alike, const std::vector<std::string>& names,
                     bool refused);

}  // namespace encore::energy
