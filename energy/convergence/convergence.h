#pragma once

#include "energy/convergence/blocks.h"
#include "energy/convergence/drift.h"
#include "energy/convergence/paired_energy.h"
#include "energy/convergence/required_time.h"
#include "energy/sources/power_source.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace encore::energy {

/// What is watched while it settles.
enum class ConvergenceQuantity { time_per_operation, watts, joules_per_operation };
inline constexpr std::size_t kConvergenceQuantities = 3;
/// The words exactly as files hold them, and the SI unit of the value.
std::string_view to_string(ConvergenceQuantity quantity);
std::string_view unit_of(ConvergenceQuantity quantity);

/// How well a quantity was known at a time. The half-width is of the 95 % interval of the mean: its
/// scatter (cautious_mean()), and for energies the window's edges and the sensor's step. The
/// sensor's gain is not in it, since no length of measuring lowers that.
struct ConvergencePoint {
  Seconds elapsed;  ///< since the tracker's start
  ConvergenceQuantity quantity = ConvergenceQuantity::time_per_operation;
  double mean = 0.0;
  std::optional<double> half_width;
  std::optional<double> relative;  ///< half_width / |mean|
  double effective_samples = 0.0;
  /// Allan deviation of means over `allan_window`, the longest of which there are at least 8.
  std::optional<double> allan_deviation;
  std::optional<Seconds> allan_window;
  /// The slope of a straight line, where it is more than chance.
  std::optional<double> drift_per_second;
};

/// A point and what predictions rest on.
struct Assessment {
  ConvergencePoint point;
  std::optional<Pilot> pilot;  ///< its times are of measuring, pauses left out
  std::optional<Drift> drift;  ///< significant or not
  double pauses = 1.0;         ///< elapsed time by measuring time
  Seconds shortest;            ///< edge_bound's update period; 0 without a sensor
};

/// Watches a measurement converge. Takes rows as they come and, where there is a sensor, its
/// cumulative joules, and assesses what they say at elapsed times that grow by a tenth each. Memory
/// is bounded for runs of any length (blocks.h), and so is the cost: below a millisecond an
/// assessment, of which there are 25 for each decade of time. Used by one thread at a time.
///
/// For the sum of sources, feed the sum of their joules at common times and the info of the
/// slowest.
class ConvergenceTracker {
 public:
  /// `start`: when measuring began, on the clock of rows and energies; what lies before is ignored.
  explicit ConvergenceTracker(Seconds start, std::optional<SourceInfo> source = std::nullopt);
  ConvergenceTracker(const ConvergenceTracker&) = delete;
  ConvergenceTracker& operator=(const ConvergenceTracker&) = delete;

  /// `operations` that ended at `end` and took `per_operation` each, back to back. True if new
  /// points were added.
  bool add_row(Seconds end, double operations, Seconds per_operation);
  /// In the order of time, before or after the rows they belong to.
  void add_energy(const TracePoint& point);

  [[nodiscard]] const std::vector<ConvergencePoint>& points() const { return points_; }
  /// The latest assessment; nothing before the first one.
  [[nodiscard]] const std::optional<Assessment>& latest(ConvergenceQuantity quantity) const;
  /// The one before it.
  [[nodiscard]] const std::optional<Assessment>& previous(ConvergenceQuantity quantity) const;
  /// Averaging over more than this tells no more, since drift outweighs what it gains (the minimum
  /// of the Allan deviation); nothing if no such minimum is seen.
  [[nodiscard]] std::optional<Seconds> longest_useful_window(ConvergenceQuantity quantity) const;

  /// Blocks, points and waiting updates that are kept; for tests of the bound.
  [[nodiscard]] std::size_t kept() const;

 private:
  struct Watched {
    BlockSeries series;
    std::size_t assessed_additions = 0;
    std::optional<Assessment> latest;
    std::optional<Assessment> previous;
  };
  Watched& watched(ConvergenceQuantity quantity);
  [[nodiscard]] const Watched& watched(ConvergenceQuantity quantity) const;
  void assess(ConvergenceQuantity quantity, Seconds elapsed);

  Seconds start_;
  std::optional<SourceInfo> source_;
  std::array<Watched, kConvergenceQuantities> watched_;
  PairedEnergy paired_;
  Seconds next_;
  std::vector<ConvergencePoint> points_;
};

}  // namespace encore::energy
