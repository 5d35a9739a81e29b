#pragma once

#include "energy/phase_log.h"
#include "energy/units.h"

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace encore::energy {

/// When each kind of work was busy, as cumulative busy time: one piecewise linear function of time
/// a column. Columns may overlap in time (CPU and GPU at once); a column's own spans may not.
/// Memory is bounded by `resolution`: spans of a column that follow each other within it are kept
/// as one straight line of the right slope, so its error in busy time is below `resolution`. A run
/// of days keeps `most_knots` a column: the older half gets coarser, totals stay as they are.
class BusyTimeline {
 public:
  /// `columns`: their names, such as "build" or "gpu render".
  explicit BusyTimeline(std::vector<std::string> columns, Seconds resolution = Seconds(0.001),
                        std::size_t most_knots = 1U << 20U);
  /// One column a Phase, in the order of kPhases.
  static BusyTimeline of_phases(Seconds resolution = Seconds(0.001));

  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  /// Adds a busy span; spans of a column come in the order of time.
  void add(std::size_t column, Seconds start, Seconds end);
  /// `count` operations were done in [start, end]; counted linearly between.
  void add_operations(double count, Seconds start, Seconds end);

  /// Busy seconds of a column in [from, to].
  [[nodiscard]] Seconds busy(std::size_t column, Seconds from, Seconds to) const;
  [[nodiscard]] double operations(Seconds from, Seconds to) const;

  /// A stretch in which a column was busy: all of the time, or (where short spans were merged) a
  /// `share` of it in (0, 1].
  struct Piece {
    Seconds start;
    Seconds end;
    double share = 1.0;
  };
  /// The busy stretches of a column that touch [from, to], uncut, in the order of time.
  [[nodiscard]] std::vector<Piece> pieces(std::size_t column, Seconds from, Seconds to) const;

 private:
  struct Knot {
    Seconds time;
    double total = 0.0;  ///< cumulative value up to `time`
  };
  /// Cumulative, non-decreasing, flat outside its spans.
  struct Line {
    std::vector<Knot> knots;
    void add(Seconds start, Seconds end, double amount, Seconds resolution, std::size_t most);
    void thin();
    [[nodiscard]] double at(Seconds time) const;
  };

  std::vector<std::string> columns_;
  Seconds resolution_;
  std::size_t most_knots_;
  std::vector<Line> lines_;
  Line operations_;
};

/// Busy time of each phase up to any recent moment, the phase that is running included; for the
/// power model, which is asked by the sampler's thread while phases run. Thread-safe.
class LiveBusyTime {
 public:
  /// `history`: how many beginnings and ends are remembered; only a simulated sensor, which looks
  /// back, needs more than the last one.
  explicit LiveBusyTime(std::size_t history = 1);

  void begin(Phase phase, Seconds now);
  void end(Seconds now);
  /// Up to `time`; before the oldest that is remembered, what had been busy by then.
  [[nodiscard]] PerPhase<Seconds> busy(Seconds time) const;

 private:
  struct Knot {
    Seconds time;
    PerPhase<Seconds> done{};
    std::optional<Phase> open;
  };
  void remember(Knot knot);

  mutable std::mutex mutex_;
  std::size_t history_;
  std::deque<Knot> knots_;
};

}  // namespace encore::energy
