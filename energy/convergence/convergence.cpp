#include "energy/convergence/convergence.h"

#include "energy/convergence/allan.h"
#include "energy/convergence/correlation.h"
#include "energy/student_t.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::energy {

namespace {

constexpr double kGrowth = 1.1;

/// The period by which the ends of this source's windows are unsure: its update period; a counter
/// that is polled faster than it updates shows the update at the poll behind it.
Seconds edge_period(const SourceInfo& source) {
  if (source.is_counter && source.poll_period.value > 0) {
    return std::min(source.update_period, source.poll_period);
  }
  return source.update_period;
}

/// Adds to a pilot what the sensor does to a mean of `watts`.
void add_sensor(const SourceInfo& source, double watts, Pilot& pilot) {
  if (!(watts > 0.0)) return;
  // A counter's step acts as the time does that it takes to fill it.
  const double step = source.energy_step ? source.energy_step->value / watts : 0.0;
  pilot.edge = Seconds(std::hypot(edge_period(source).value, step));
  if (!source.is_counter && source.power_step) {
    pilot.floor = source.power_step->value / watts / std::sqrt(12.0);
  }
}

void add_allan(const BlockSeries& series, ConvergencePoint& point) {
  constexpr std::size_t kLeastMeans = 8;
  const auto blocks = series.blocks();
  std::vector<double> values(blocks.size());
  double length = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    values[i] = blocks[i].ratio();
    length += blocks[i].length.value;
  }
  for (const AllanPoint& allan : allan_deviation(values)) {
    if (allan.pairs + 1 < kLeastMeans) break;
    point.allan_deviation = allan.deviation;
    point.allan_window =
        Seconds(length / static_cast<double>(blocks.size()) * static_cast<double>(allan.m));
  }
}

std::optional<Drift> drift_of(const BlockSeries& series, Seconds start) {
  std::vector<double> times;
  std::vector<double> values;
  for (const Block& block : series.blocks()) {
    times.push_back((block.middle - start).value);
    values.push_back(block.ratio());
  }
  return linear_drift(times, values);
}

Estimate estimate_of(const BlockSeries& series) {
  std::vector<double> values;
  std::vector<double> weights;
  for (const Block& block : series.all()) {
    values.push_back(block.ratio());
    weights.push_back(block.weight);
  }
  return cautious_mean(values, weights);
}

}  // namespace

std::string_view to_string(ConvergenceQuantity quantity) {
  switch (quantity) {
    case ConvergenceQuantity::time_per_operation:
      return "time_per_operation";
    case ConvergenceQuantity::watts:
      return "watts";
    case ConvergenceQuantity::joules_per_operation:
      return "joules_per_operation";
  }
  return "";
}

std::string_view unit_of(ConvergenceQuantity quantity) {
  switch (quantity) {
    case ConvergenceQuantity::time_per_operation:
      return "s";
    case ConvergenceQuantity::watts:
      return "W";
    case ConvergenceQuantity::joules_per_operation:
      return "J";
  }
  return "";
}

ConvergenceTracker::ConvergenceTracker(Seconds start, std::optional<SourceInfo> source)
    : start_(start), source_(std::move(source)), paired_(start, [this](const EnergyStep& step) {
        const double joules = step.energy.value;
        watched(ConvergenceQuantity::watts)
            .series.add(step.start, step.end, joules, (step.end - step.start).value);
        watched(ConvergenceQuantity::joules_per_operation)
            .series.add(step.start, step.end, joules, step.operations);
      }) {}

ConvergenceTracker::Watched& ConvergenceTracker::watched(ConvergenceQuantity quantity) {
  return watched_.at(static_cast<std::size_t>(quantity));
}
const ConvergenceTracker::Watched& ConvergenceTracker::watched(ConvergenceQuantity quantity) const {
  return watched_.at(static_cast<std::size_t>(quantity));
}

bool ConvergenceTracker::add_row(Seconds end, double operations, Seconds per_operation) {
  const Seconds busy = per_operation * operations;
  if (end < start_ || !(operations > 0.0)) return false;
  const Seconds begin = std::max(start_, end - busy);
  watched(ConvergenceQuantity::time_per_operation).series.add(begin, end, busy.value, operations);
  if (source_) paired_.add_row(begin, end, operations);

  const Seconds elapsed = end - start_;
  if (elapsed < next_) return false;
  next_ = elapsed * kGrowth;
  const std::size_t before = points_.size();
  assess(ConvergenceQuantity::time_per_operation, elapsed);
  if (source_) {
    assess(ConvergenceQuantity::watts, elapsed);
    assess(ConvergenceQuantity::joules_per_operation, elapsed);
  }
  return points_.size() > before;
}

void ConvergenceTracker::add_energy(const TracePoint& point) {
  if (source_) paired_.add_energy(point);
}

void ConvergenceTracker::assess(ConvergenceQuantity quantity, Seconds elapsed) {
  Watched& one = watched(quantity);
  const BlockSeries& series = one.series;
  // Nothing new since: the same data must not count as a second confirmation.
  if (series.additions() == one.assessed_additions) return;
  one.assessed_additions = series.additions();

  const Estimate estimate = estimate_of(series);
  Assessment now;
  ConvergencePoint& point = now.point;
  point.elapsed = elapsed;
  point.quantity = quantity;
  point.mean = estimate.mean;
  point.effective_samples =
      estimate.effective_samples.value_or(static_cast<double>(estimate.samples));
  now.pauses = series.length().value > 0 ? elapsed / series.length() : 1.0;
  now.pilot = pilot_of(estimate, series.length());
  double sensor = 0.0;
  if (now.pilot && source_ && quantity != ConvergenceQuantity::time_per_operation) {
    const BlockSeries& power = watched(ConvergenceQuantity::watts).series;
    add_sensor(*source_, estimate_of(power).mean, *now.pilot);
    now.shortest = edge_period(*source_);
    sensor = kNormal95 * std::hypot(edge_error(now.pilot->edge, series.length()), now.pilot->floor);
  }
  if (estimate.ci95_half_width) {
    point.half_width = std::hypot(*estimate.ci95_half_width, sensor * std::fabs(estimate.mean));
    if (estimate.mean != 0.0) point.relative = *point.half_width / std::fabs(estimate.mean);
  }
  add_allan(series, point);
  now.drift = drift_of(series, start_);
  if (now.drift && now.drift->significant) point.drift_per_second = now.drift->per_second;

  points_.push_back(point);
  one.previous = std::exchange(one.latest, std::move(now));
}

const std::optional<Assessment>& ConvergenceTracker::latest(ConvergenceQuantity quantity) const {
  return watched(quantity).latest;
}
const std::optional<Assessment>& ConvergenceTracker::previous(ConvergenceQuantity quantity) const {
  return watched(quantity).previous;
}

std::optional<Seconds> ConvergenceTracker::longest_useful_window(
    ConvergenceQuantity quantity) const {
  const auto blocks = watched(quantity).series.blocks();
  std::vector<double> values;
  double length = 0.0;
  for (const Block& block : blocks) {
    values.push_back(block.ratio());
    length += block.length.value;
  }
  const auto minimum = allan_minimum(allan_deviation(values));
  if (!minimum) return std::nullopt;
  return Seconds(length / static_cast<double>(blocks.size()) * static_cast<double>(minimum->m));
}

std::size_t ConvergenceTracker::kept() const {
  std::size_t kept = points_.size() + paired_.waiting();
  for (const Watched& one : watched_) kept += one.series.blocks().size();
  return kept;
}

}  // namespace encore::energy
