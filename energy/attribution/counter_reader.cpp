#include "energy/attribution/counter_reader.h"

#include <algorithm>
#include <optional>

namespace encore::energy {

CounterReader::CounterReader(const SourceInfo& source, const TraceView& trace)
    : trace_(trace),
      points_(trace.points()),
      period_(source.update_period.value),
      step_(source.energy_step.value_or(Joules(0)).value) {
  // A value that stands still for longer than the documented period tells that the sensor is slower
  // than that. Readings in quick succession, as at the edges of phases, tell nothing.
  std::size_t stood = 0;
  std::size_t asked = 0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if ((points_[i].time - points_[i - 1].time).value <= 1.1 * period_) continue;
    ++asked;
    stood += points_[i].changed ? 0 : 1;
  }
  const auto seen = trace.observed_period();
  if (seen && stood * 5 > asked) period_ = std::max(period_, seen->median.value);
}

std::vector<CounterRun> CounterReader::runs(const Window& window) const {
  std::vector<CounterRun> found;
  std::optional<CounterRun> run;
  const auto close = [&] {
    if (run && run->last > run->first) found.push_back(*run);
    run.reset();
  };
  for (std::size_t i = trace_.first_at_or_after(window.from);
       i < points_.size() && points_[i].time <= window.to; ++i) {
    if (points_[i].starts_stretch) close();
    if (!points_[i].changed) continue;
    if (!run) run = CounterRun{i, i};
    run->last = i;
  }
  close();
  return found;
}

double CounterReader::oldest(std::size_t point) const {
  if (point == 0 || points_[point].starts_stretch) return period_;
  return std::min(period_, (points_[point].time - points_[point - 1].time).value);
}

std::size_t CounterReader::update_before(std::size_t point) const {
  for (std::size_t i = point; i > 0 && !points_[i].starts_stretch;) {
    if (points_[--i].changed) return i;
  }
  return point;
}

std::size_t CounterReader::update_after(std::size_t point) const {
  for (std::size_t i = point + 1; i < points_.size() && !points_[i].starts_stretch; ++i) {
    if (points_[i].changed) return i;
  }
  return point;
}

CounterReader::Age CounterReader::age(std::size_t point) const {
  const double all = oldest(point);
  // Sensors keep their period about so well.
  const double slack = 0.1 * period_;
  // One update and no more lies between two polls that are closer than a period.
  const auto one_update = [&](double gap, std::size_t later) {
    return gap > 0 && gap < 1.9 * period_ && oldest(later) < period_;
  };
  Age age{0.0, all};
  const std::size_t before = update_before(point);
  const double since = (points_[point].time - points_[before].time).value;
  if (one_update(since, point)) {
    age.least = std::max(age.least, since - period_ - slack);
    age.most = std::min(age.most, since - period_ + slack + oldest(before));
  }
  const std::size_t after = update_after(point);
  const double until = (points_[after].time - points_[point].time).value;
  if (one_update(until, after)) {
    age.least = std::max(age.least, period_ - until - slack);
    age.most = std::min(age.most, period_ - until + slack + oldest(after));
  }
  // Polls that found nothing new tell that the next update was still to come.
  std::size_t same = point;
  while (same + 1 < points_.size() && !points_[same + 1].changed) ++same;
  const double unchanged = (points_[same].time - points_[point].time).value;
  if (unchanged > 0 && unchanged < period_) {
    age.most = std::min(age.most, period_ - unchanged + slack);
  }
  // Neighbours that contradict each other show a sensor that does not keep its period.
  const double least_range = 0.2 * all;
  if (age.range() < 0) return {0.0, all};
  if (age.range() < least_range) {
    age.least = std::clamp(age.mean() - 0.5 * least_range, 0.0, all - least_range);
    age.most = age.least + least_range;
  }
  return age;
}

double CounterReader::typical_age() const {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!points_[i].changed) continue;
    sum += oldest(i);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : period_;
}

double CounterReader::joules(const CounterRun& run) const {
  return (points_[run.last].energy - points_[run.first].energy).value;
}

double CounterReader::seconds(const CounterRun& run) const {
  return (points_[run.last].time - points_[run.first].time).value - age(run.last).mean() +
         age(run.first).mean();
}

double CounterReader::power_before(const CounterRun& run) const {
  const CounterRun earlier{update_before(run.first), run.first};
  return earlier.first != run.first && seconds(earlier) > 0 ? power(earlier) : power(run);
}

double CounterReader::start_correction(const CounterRun& run, Seconds start) const {
  const Age first = age(run.first);
  const double inside = (points_[run.first].time - start).value;
  if (first.most <= inside) return 0.0;
  // The mean of what of the age lies before the start.
  const double nearest = std::max(0.0, first.least - inside);
  const double farthest = first.most - inside;
  const double share = (farthest - nearest) / std::max(first.range(), 1e-300);
  const double overlap = first.range() > 0 ? 0.5 * (nearest + farthest) * share : nearest;
  return (power(run) - power_before(run)) * overlap;
}

ErrorSum CounterReader::errors(const CounterRun& run, Seconds start, double spread) const {
  ErrorSum sum;
  const Age first = age(run.first);
  const double inside =
      std::clamp((points_[run.first].time - start).value, first.least, first.most) - first.least;
  sum.add_uniform(power(run) * inside + power_before(run) * (first.range() - inside), spread);
  sum.add_uniform(power(run) * age(run.last).range(), spread);
  sum.add_uniform(step_);
  sum.add_uniform(step_);
  return sum;
}

}  // namespace encore::energy
