#pragma once

#include "energy/sources/power_source.h"

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace encore::energy {

/// One point of a trace: the cumulative energy of a source at a time.
struct TracePoint {
  Seconds time;
  Joules energy;                ///< since the source was opened, within its stretch
  std::optional<Watts> power;   ///< what a gauge showed
  bool changed = true;          ///< as in Reading
  bool starts_stretch = false;  ///< what lies between the point before and this one is unknown
};

/// The points of one source in the order of time, as they were at one moment. Energy is defined
/// within a stretch only: a gap stays a gap.
class TraceView {
 public:
  TraceView() = default;
  explicit TraceView(std::vector<TracePoint> points) : points_(std::move(points)) {}

  [[nodiscard]] const std::vector<TracePoint>& points() const { return points_; }
  [[nodiscard]] bool empty() const { return points_.empty(); }

  /// Energy between two times, linear between points; nothing if a gap lies between them or the
  /// trace does not reach that far.
  [[nodiscard]] std::optional<Joules> energy_between(Seconds from, Seconds to) const;
  /// Index of the first point at or after `time` (points().size() if there is none).
  [[nodiscard]] std::size_t first_at_or_after(Seconds time) const;
  /// The points of [from, to], as a trace of their own.
  [[nodiscard]] TraceView part(Seconds from, Seconds to) const;
  /// Sum of the lengths of the gaps that touch [from, to].
  [[nodiscard]] Seconds gaps_between(Seconds from, Seconds to) const;
  /// Median time between changes of the sensor's value, and the longest; nothing below 8 changes.
  struct Period {
    Seconds median;
    Seconds longest;
    std::size_t changes = 0;
  };
  [[nodiscard]] std::optional<Period> observed_period() const;

 private:
  std::vector<TracePoint> points_;
};

/// Grows while a source is read. One thread adds, any thread takes a view. Memory is bounded: at
/// `capacity` points, every second one of the older half is dropped, which keeps all totals
/// (energies are cumulative), gaps and the newest half as they are, so that days of running fit.
class Trace {
 public:
  explicit Trace(std::size_t capacity = 1U << 20U);

  /// Adds a reading (state ok or restarted). Times must not fall; equal times replace.
  void add(const Reading& reading, bool restarted);
  /// Notes that the source gave nothing: the next point starts a new stretch.
  void add_gap();

  [[nodiscard]] TraceView view() const;
  /// Only what lies in [from, to] plus the neighbours on both sides.
  [[nodiscard]] TraceView view(Seconds from, Seconds to) const;
  [[nodiscard]] std::optional<TracePoint> latest() const;
  [[nodiscard]] std::size_t size() const;

 private:
  void thin();

  mutable std::mutex mutex_;
  std::size_t capacity_;
  std::vector<TracePoint> points_;
  bool gap_ = false;
};

}  // namespace encore::energy
