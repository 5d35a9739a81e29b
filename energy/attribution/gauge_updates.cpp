#include "energy/attribution/gauge_updates.h"

#include "energy/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::energy {

namespace {

/// Correlation of each value with the next.
double neighbour_correlation(const std::vector<double>& values, double mean) {
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = values[i] - mean;
    squares += off * off;
    if (i > 0) products += off * (values[i - 1] - mean);
  }
  return squares > 0 ? products / squares : 0.0;
}

/// (1 + phi) / (1 - phi): how many values of an AR(1) series tell as much as one independent one.
double ar1_inflation(double phi) {
  return (1 + phi) / (1 - phi);
}

/// How many correlated updates tell as much as one independent one.
double inflation(const SourceInfo& source, Seconds period, const std::vector<double>& values,
                 const std::vector<double>& weights) {
  double factor = 1.0;
  if (source.smoothing.value > 0) factor = ar1_inflation(std::exp(-(period / source.smoothing)));
  constexpr std::size_t kLeastForCorrelation = 20;
  if (values.size() < kLeastForCorrelation) return factor;
  // Estimated from few updates, a factor never below 1 is too large on average where there is no
  // correlation at all: it is asked for only where neighbours are more alike than chance makes them
  // in five series of six.
  const double n = static_cast<double>(values.size());
  const Estimate seen = estimate_mean(values, weights);
  const double correlation = neighbour_correlation(values, seen.mean);
  if (correlation < 1.0 / std::sqrt(n)) return factor;
  // About the sample's own mean, correlations come out too low by (1 + 4 rho) / n (Kendall 1954).
  constexpr double kLargest = 0.95;
  const double corrected = std::min(kLargest, correlation + (1 + 4 * correlation) / n);
  return std::max({factor, ar1_inflation(corrected), n / seen.effective_samples.value_or(n)});
}

/// The updates in [from, to] that began at or after `from`.
void append_updates(const TraceView& trace, Seconds from, Seconds to, Seconds period,
                    std::vector<GaugeUpdate>& updates) {
  const std::vector<TracePoint>& points = trace.points();
  const auto close = [&](Seconds start, Seconds end, double watts) {
    if (start < from) {
      // A value that stands for so long hides updates to an equal one: the first in time counts.
      if (end - start < period * 2.0) return;
      start += period * std::ceil((from - start) / period);
    }
    const Seconds length = std::min(end, to) - start;
    if (length.value <= 0) return;
    const double count = std::max(1.0, std::floor(length / period + 0.5));
    const double pieces = length >= period * 2.0 ? count : 1.0;
    for (int i = 0; i < static_cast<int>(pieces); ++i) {
      const Seconds piece = length / pieces;
      updates.push_back({start + piece * i, piece, watts, piece.value});
    }
  };
  const TracePoint* open = nullptr;
  std::size_t i = trace.first_at_or_after(from);
  // The value that stands at `from`.
  while (i > 0 && (i == points.size() || points[i].time > from || !points[i].changed) &&
         (i == points.size() || !points[i].starts_stretch)) {
    --i;
  }
  for (; i < points.size() && points[i].time < to; ++i) {
    const TracePoint& point = points[i];
    if (!point.changed && !point.starts_stretch) continue;
    // A gap ends the update before it at the last reading.
    if (open) {
      close(open->time, point.starts_stretch ? points[i - 1].time : point.time, open->power->value);
    }
    open = point.power ? &point : nullptr;
  }
  if (!open) return;
  const bool goes_on = i < points.size() && !points[i].starts_stretch;
  close(open->time, goes_on ? to : points[i - 1].time, open->power->value);
}

}  // namespace

Seconds gauge_period(const SourceInfo& source, const TraceView& trace) {
  const auto seen = trace.observed_period();
  const Seconds documented = std::max(source.update_period, Seconds(1e-6));
  return seen ? std::max(documented, seen->median) : documented;
}

Seconds settling_time(const SourceInfo& source, const TraceView& trace) {
  return std::max(gauge_period(source, trace) * 1.5, source.smoothing * 3.0);
}

std::vector<GaugeUpdate> settled_updates(const SourceInfo& source, const TraceView& trace,
                                         const std::vector<Window>& windows) {
  const Seconds period = gauge_period(source, trace);
  const Seconds settle = settling_time(source, trace);
  std::vector<GaugeUpdate> updates;
  for (const Window& window : join_windows(windows)) {
    const std::size_t before = updates.size();
    append_updates(trace, window.from + settle, window.to, period, updates);
    double covered = 0.0;
    for (std::size_t i = before; i < updates.size(); ++i) covered += updates[i].weight;
    const double scale = (window.to - window.from).value / covered;
    for (std::size_t i = before; i < updates.size(); ++i) updates[i].weight *= scale;
  }
  return updates;
}

std::vector<GaugeUpdate> cut_updates(const SourceInfo& source, const TraceView& trace,
                                     const std::vector<Window>& windows, Watts threshold) {
  const Seconds period = gauge_period(source, trace);
  std::vector<GaugeUpdate> updates;
  for (const Window& window : join_windows(windows)) {
    append_updates(trace, window.from, window.to, period, updates);
  }
  std::erase_if(updates, [&](const GaugeUpdate& u) { return u.watts < threshold.value; });
  return updates;
}

std::optional<MeanPower> mean_of_updates(const SourceInfo& source, Seconds period,
                                         const std::vector<GaugeUpdate>& updates) {
  std::vector<double> values;
  std::vector<double> weights;
  MeanPower mean;
  double sum = 0.0;
  double squares = 0.0;
  for (const GaugeUpdate& update : updates) {
    values.push_back(update.watts);
    weights.push_back(update.weight);
    sum += update.weight;
    squares += update.weight * update.weight;
    mean.covered += update.length;
    mean.watts += (update.watts - mean.watts) * (update.weight / sum);
  }
  if (updates.empty()) return std::nullopt;
  mean.effective_samples = sum * sum / squares / inflation(source, period, values, weights);
  constexpr double kLeast = 1.5;
  if (mean.effective_samples < kLeast) return std::nullopt;

  double variance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    variance += weights[i] * (values[i] - mean.watts) * (values[i] - mean.watts) / sum;
  }
  // variance n / (n - 1) is the unbiased variance of one update; over n, that of their mean.
  const double degrees = mean.effective_samples - 1.0;
  const Chance scatter = student_chance(std::sqrt(variance / degrees), degrees);
  // Scatter wider than a step holds the rounding already; a value that stands still does not.
  const double step = source.power_step.value_or(Watts(0)).value;
  ErrorSum rounding;
  if (variance < 0.25 * step * step) rounding.add_uniform(step);
  const std::array<Chance, 2> parts{scatter, rounding.chance()};
  mean.realised = mean.long_run = combined(parts);
  return mean;
}

}  // namespace encore::energy
