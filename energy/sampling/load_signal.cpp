#include "energy/sampling/load_signal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace encore::energy {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

LoadSignal empty_signal(Seconds from, Seconds to, Seconds step) {
  LoadSignal signal{from, step, {}};
  // Steps that are not whole would be noisier than the others.
  const double count = std::floor((to - from) / step + 1e-9);
  if (count > 0) signal.values.assign(static_cast<std::size_t>(count), 0.0);
  return signal;
}

/// Calls `put` with each step that [from, to] touches and the part of it that lies within, both in
/// steps.
template <class Put>
void for_each_step(const LoadSignal& signal, Seconds from, Seconds to, const Put& put) {
  const double count = static_cast<double>(signal.values.size());
  const double begin = std::clamp((from - signal.start) / signal.step, 0.0, count);
  const double end = std::clamp((to - signal.start) / signal.step, 0.0, count);
  for (auto i = static_cast<std::size_t>(begin); i < signal.values.size(); ++i) {
    const double left = std::max(begin, static_cast<double>(i));
    const double right = std::min(end, static_cast<double>(i + 1));
    if (right <= left) break;
    put(i, left, right);
  }
}

}  // namespace

LoadSignal load_of(const TraceView& trace, Seconds step) {
  const std::vector<TracePoint>& points = trace.points();
  if (points.empty()) return {Seconds(0), step, {}};
  LoadSignal signal = empty_signal(points.front().time, points.back().time, step);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Seconds from = points[i - 1].time;
    const Seconds to = points[i].time;
    if (!(to > from)) continue;
    const double mean = ((points[i].energy - points[i - 1].energy) / (to - from)).value;
    // A gauge's energy is that of straight lines between its readings.
    const bool gauge = points[i - 1].power && points[i].power;
    const double rise = gauge ? (*points[i].power - *points[i - 1].power).value : 0.0;
    for_each_step(signal, from, to, [&](std::size_t at, double begin, double end) {
      const Seconds middle = signal.start + signal.step * ((begin + end) / 2);
      const double watts = mean + rise * ((middle - from) / (to - from) - 0.5);
      signal.values[at] += points[i].starts_stretch ? kUnknown : watts * (end - begin);
    });
  }
  return signal;
}

LoadSignal load_of(std::span<const PhaseSpan> busy, Seconds from, Seconds to, Seconds step) {
  LoadSignal signal = empty_signal(from, to, step);
  for (const PhaseSpan& span : busy) {
    for_each_step(signal, span.start, span.end, [&](std::size_t at, double begin, double end) {
      signal.values[at] += end - begin;
    });
  }
  return signal;
}

Seconds spacing_of(const TraceView& trace) {
  std::vector<Seconds> steps;
  const std::vector<TracePoint>& points = trace.points();
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!points[i].starts_stretch) steps.push_back(points[i].time - points[i - 1].time);
  }
  if (steps.empty()) return Seconds(0);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace encore::energy
