#include "energy/attribution/fit_rows.h"

#include "energy/attribution/windows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace encore::energy {

namespace {

/// More rows than this add nothing but time: neighbours are joined.
constexpr std::size_t kMostRows = 1U << 16U;
/// No clock tells times apart better (s).
constexpr double kLeastJitter = 1e-9;

/// One update of a sensor.
struct Update {
  double time = 0.0;    ///< when it was seen
  double jitter = 0.0;  ///< it happened at most so much earlier
  double value = 0.0;   ///< J or W
  bool starts = false;  ///< it does not follow the update before it
};

bool moved(const TracePoint& point, const TracePoint& before) {
  return point.changed || point.energy > before.energy;
}

/// The updates inside the windows. A point that opens a stretch is no update: it is not known since
/// when the sensor has shown it.
std::vector<Update> updates(const TraceView& trace, const std::vector<Window>& windows,
                            double period, bool is_counter) {
  std::vector<Update> found;
  const auto& points = trace.points();
  for (const Window& window : windows) {
    bool starts = true;
    for (std::size_t i = trace.first_at_or_after(window.from); i < points.size(); ++i) {
      const TracePoint& point = points[i];
      if (point.time > window.to) break;
      if (i == 0 || point.starts_stretch) {
        starts = true;
        continue;
      }
      const double now = point.time.value;
      const double gap = now - points[i - 1].time.value;
      if (is_counter ? moved(point, points[i - 1]) : point.changed && point.power) {
        found.push_back({now, std::max(is_counter ? std::min(gap, period) : gap, kLeastJitter),
                         is_counter ? point.energy.value : point.power->value, starts});
      } else if (!is_counter && point.power && !starts && now - found.back().time >= 2 * period) {
        // At some time in the last period the gauge showed the same value again.
        found.push_back({now, std::max(period, gap), point.power->value, false});
      } else {
        continue;
      }
      starts = false;
    }
  }
  return found;
}

/// Every n-th update, so that at most kMostRows are left; beginnings stay.
std::vector<Update> thinned(std::vector<Update> all) {
  const std::size_t stride = all.size() / kMostRows + 1;
  if (stride == 1) return all;
  std::vector<Update> kept;
  std::size_t since = 0;
  for (const Update& update : all) {
    since = update.starts ? 0 : since + 1;
    if (since % stride == 0) kept.push_back(update);
  }
  return kept;
}

/// Busy seconds in [from, to].
double busy_in(const Activity& activity, double from, double to) {
  const auto first =
      std::partition_point(activity.begin(), activity.end(),
                           [&](const BusyTimeline::Piece& p) { return p.end.value <= from; });
  double sum = 0.0;
  for (auto p = first; p != activity.end() && p->start.value < to; ++p) {
    sum += std::max(0.0, std::min(p->end.value, to) - std::max(p->start.value, from)) * p->share;
  }
  return sum;
}

/// The mean share over the window before an update, averaged over when the update may have been:
/// an error of time in the column itself would draw the coefficient towards 0.
double windowed_share(const Activity& activity, const Update& update, const GaugeKernel& kernel) {
  constexpr int kPlaces = 4;
  if (kernel.window <= update.jitter) {
    return busy_in(activity, update.time - update.jitter, update.time) / update.jitter;
  }
  double sum = 0.0;
  for (int place = 0; place < kPlaces; ++place) {
    const double end = update.time - update.jitter * (place + 0.5) / kPlaces;
    sum += busy_in(activity, end - kernel.window, end);
  }
  return sum / (kPlaces * kernel.window);
}

}  // namespace

FitRows counter_rows(const SourceInfo& info, const TraceView& trace,
                     const std::vector<Activity>& activities, const std::vector<Window>& windows,
                     double lag) {
  const double period = std::max(info.update_period.value, kLeastJitter);
  const auto found = thinned(updates(trace, windows, period, true));
  std::vector<double> edges;
  for (const Update& update : found) edges.push_back(update.time - lag * update.jitter);

  FitRows rows;
  std::vector<std::size_t> ends;  // index of the update that ends each row
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (found[i].starts || !(edges[i] > edges[i - 1])) continue;
    rows.starts.push_back(ends.empty() || ends.back() != i - 1);
    rows.values.push_back(found[i].value - found[i - 1].value);
    rows.lengths.push_back(edges[i] - edges[i - 1]);
    rows.edges_before.push_back(found[i - 1].jitter * found[i - 1].jitter);
    rows.edges_after.push_back(found[i].jitter * found[i].jitter);
    rows.jitter.push_back(found[i].jitter);
    ends.push_back(i);
  }
  const double total = std::accumulate(rows.lengths.begin(), rows.lengths.end(), 0.0);
  for (const double length : rows.lengths) {
    rows.noise.push_back(length * static_cast<double>(rows.size()) / total);
  }
  for (const Activity& activity : activities) {
    const std::vector<double> all = busy_between(activity, edges);
    std::vector<double> column;
    std::vector<double> timing;
    for (const std::size_t end : ends) {
      column.push_back(all[end - 1]);
      timing.push_back(busy_in(activity, found[end].time - found[end].jitter, found[end].time));
    }
    rows.columns.add_column(column);
    rows.timing.add_column(timing);
  }
  rows.columns.add_column(rows.lengths);
  rows.timing.add_column(rows.jitter);
  return rows;
}

FitRows gauge_rows(const TraceView& trace, const std::vector<Activity>& activities,
                   const std::vector<Window>& windows, const GaugeKernel& kernel, double settling,
                   double period) {
  std::vector<Window> settled = windows;
  for (Window& window : settled) window.from += Seconds(settling);
  std::erase_if(settled, [](const Window& w) { return !(w.from < w.to); });
  const auto found = thinned(updates(trace, settled, period, false));

  FitRows rows;
  std::vector<double> times;
  for (std::size_t i = 0; i < found.size(); ++i) {
    // Seen on average half a poll after it happened.
    times.push_back(found[i].time - 0.5 * found[i].jitter);
    rows.values.push_back(found[i].value);
    rows.starts.push_back(found[i].starts);
    rows.lengths.push_back(i == 0 ? 0.0 : times[i] - times[i - 1]);
    rows.jitter.push_back(found[i].jitter);
  }
  rows.noise.assign(rows.size(), 1.0);
  for (const Activity& activity : activities) {
    if (kernel.smoothing > 0.0) {
      rows.columns.add_column(smoothed_share(activity, kernel.smoothing, times));
      rows.timing.add_column(std::vector<double>(times.size(), 0.0));
      continue;
    }
    std::vector<double> column;
    std::vector<double> timing;
    for (const Update& update : found) {
      column.push_back(windowed_share(activity, update, kernel));
      const double window = std::max(kernel.window, update.jitter);
      const double early = update.time - update.jitter;
      timing.push_back((busy_in(activity, update.time - window, update.time) -
                        busy_in(activity, early - window, early)) /
                       window);
    }
    rows.columns.add_column(column);
    rows.timing.add_column(timing);
  }
  rows.columns.add_column(std::vector<double>(times.size(), 1.0));
  rows.timing.add_column(std::vector<double>(times.size(), 0.0));
  return rows;
}

FitRows merge_columns(const FitRows& rows, const std::vector<std::vector<std::size_t>>& groups) {
  FitRows merged = rows;
  const auto sum = [&](const DenseMatrix& all) {
    DenseMatrix result(all.rows(), 0);
    std::size_t used = 0;
    for (const std::vector<std::size_t>& group : groups) {
      std::vector<double> total(all.rows(), 0.0);
      for (const std::size_t c : group) {
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += all(i, c);
      }
      result.add_column(total);
      used += group.size();
    }
    for (std::size_t c = used; c < all.columns(); ++c) result.add_column(all.column(c));
    return result;
  };
  merged.columns = sum(rows.columns);
  merged.timing = sum(rows.timing);
  return merged;
}

}  // namespace encore::energy
