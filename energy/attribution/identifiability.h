#pragma once

#include "energy/attribution/fit_rows.h"

#include <optional>
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

/// The sets of `alike` that hold only the first `phases` columns go first: that two phases are
/// alike says more than that idle time is, too.
void phases_first(Identifiability& found, std::size_t phases);

/// Why the columns cannot be told apart, in one sentence; empty if they can.
std::string refusal(const Identifiability& found, const std::vector<std::string>& names);

/// Groups of columns that are fitted as one each.
using ColumnGroups = std::vector<std::vector<std::size_t>>;
/// `groups` (if empty, each of the `count` columns alone) with two of them joined; nothing if
/// `alike` is no pair of them, or no column would be left that stands alone.
std::optional<ColumnGroups> join_pair(ColumnGroups groups, std::size_t count,
                                      const std::vector<std::size_t>& alike);

/// "build and render always ran in the same proportion: cannot be told apart"; `names`: a column.
std::string describe(const std::vector<std::size_t>& alike, const std::vector<std::string>& names,
                     bool refused);

}  // namespace encore::energy
