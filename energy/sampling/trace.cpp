#include "energy/sampling/trace.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace encore::energy {

namespace {

bool earlier(const TracePoint& point, Seconds time) {
  return point.time < time;
}

}  // namespace

std::size_t TraceView::first_at_or_after(Seconds time) const {
  return static_cast<std::size_t>(std::lower_bound(points_.begin(), points_.end(), time, earlier) -
                                  points_.begin());
}

std::optional<Joules> TraceView::energy_between(Seconds from, Seconds to) const {
  if (points_.empty() || from > to || from < points_.front().time || to > points_.back().time) {
    return std::nullopt;
  }
  // The cumulative energy at a time; both points of the straight line are of one stretch.
  const auto energy_at = [&](Seconds time, std::size_t next) -> std::optional<Joules> {
    if (points_[next].time == time) return points_[next].energy;
    if (points_[next].starts_stretch) return std::nullopt;
    const TracePoint& a = points_[next - 1];
    const TracePoint& b = points_[next];
    return a.energy + (b.energy - a.energy) * ((time - a.time) / (b.time - a.time));
  };
  const std::size_t first = first_at_or_after(from);
  const std::size_t last = first_at_or_after(to);
  for (std::size_t i = first + 1; i <= last; ++i) {
    if (points_[i].starts_stretch) return std::nullopt;
  }
  const auto start = energy_at(from, first);
  const auto end = energy_at(to, last);
  if (!start || !end) return std::nullopt;
  return *end - *start;
}

TraceView TraceView::part(Seconds from, Seconds to) const {
  const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(first_at_or_after(from));
  auto end = begin;
  while (end != points_.end() && end->time <= to) ++end;
  return TraceView({begin, end});
}

Seconds TraceView::gaps_between(Seconds from, Seconds to) const {
  Seconds sum;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Seconds start = points_[i - 1].time;
    const Seconds end = points_[i].time;
    if (points_[i].starts_stretch && end > from && start < to) sum += end - start;
  }
  return sum;
}

std::optional<TraceView::Period> TraceView::observed_period() const {
  constexpr std::size_t kLeastChanges = 8;
  std::vector<Seconds> lengths;
  std::optional<Seconds> last;
  for (const TracePoint& point : points_) {
    if (point.starts_stretch) last.reset();
    if (!point.changed) continue;
    if (last) lengths.push_back(point.time - *last);
    last = point.time;
  }
  if (lengths.size() < kLeastChanges) return std::nullopt;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return Period{*middle, *std::max_element(lengths.begin(), lengths.end()), lengths.size()};
}

Trace::Trace(std::size_t capacity) : capacity_(std::max<std::size_t>(capacity, 8)) {}

void Trace::add(const Reading& reading, bool restarted) {
  const std::lock_guard lock(mutex_);
  TracePoint point{reading.time, reading.energy, reading.power, reading.changed,
                   restarted || gap_ || points_.empty()};
  if (!points_.empty() && reading.time <= points_.back().time) {
    // Two readings at one time (a forced one beside a regular one): the later one holds.
    point.time = points_.back().time;
    point.changed = point.changed || points_.back().changed;
    point.starts_stretch = point.starts_stretch || points_.back().starts_stretch;
    points_.back() = point;
  } else {
    points_.push_back(point);
  }
  gap_ = false;
  if (points_.size() >= capacity_) thin();
}

void Trace::add_gap() {
  const std::lock_guard lock(mutex_);
  gap_ = true;
}

void Trace::thin() {
  const std::size_t older = points_.size() / 2;
  std::size_t kept = 0;
  bool dropped_last = true;  // the first point stays
  bool changed = false;      // of the points dropped since the last one that was kept
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const bool edge =
        points_[i].starts_stretch || points_[i + 1 < points_.size() ? i + 1 : i].starts_stretch;
    if (i < older && !dropped_last && !edge) {
      dropped_last = true;
      changed = changed || points_[i].changed;
      continue;
    }
    dropped_last = false;
    points_[kept] = points_[i];
    points_[kept].changed = points_[kept].changed || changed;
    changed = false;
    ++kept;
  }
  points_.resize(kept);
}

TraceView Trace::view() const {
  const std::lock_guard lock(mutex_);
  return TraceView(points_);
}

TraceView Trace::view(Seconds from, Seconds to) const {
  const std::lock_guard lock(mutex_);
  auto begin = std::lower_bound(points_.begin(), points_.end(), from, earlier);
  if (begin != points_.begin()) --begin;
  auto end = std::lower_bound(begin, points_.end(), to, earlier);
  if (end != points_.end()) ++end;
  return TraceView({begin, end});
}

std::optional<TracePoint> Trace::latest() const {
  const std::lock_guard lock(mutex_);
  if (points_.empty()) return std::nullopt;
  return points_.back();
}

std::size_t Trace::size() const {
  const std::lock_guard lock(mutex_);
  return points_.size();
}

}  // namespace encore::energy
