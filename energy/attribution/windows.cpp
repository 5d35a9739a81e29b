#include "energy/attribution/windows.h"

#include "energy/attribution/batches.h"
#include "energy/attribution/counter_reader.h"
#include "energy/attribution/gauge_updates.h"
#include "energy/student_t.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace encore::energy {

namespace {

constexpr double kAges = 5;
constexpr double kLeastCoveredByCounter = 0.5;
constexpr double kLeastCoveredByGauge = 0.25;

/// Fluctuation of power about the mean of its window, between updates so far apart that their ages
/// do not hide it.
struct Fluctuation {
  double variance = 0.0;  ///< W^2, of the mean over `interval`
  double interval = 0.0;  ///< s
  double relative = 0.0;  ///< its standard deviation, by the mean power
  /// Variance of the joules in a stretch that was not seen, if its mean power is taken for it. The
  /// shorter it is, the more its power can differ, as for independent increments.
  [[nodiscard]] double unseen(double seconds) const {
    return seconds * std::max(seconds, interval) * variance;
  }
};

Fluctuation fluctuation(const CounterReader& reader,
                        const std::vector<std::vector<CounterRun>>& windows) {
  const double least = std::max(1e-9, kAges * reader.typical_age());
  double time = 0.0;
  double squares = 0.0;
  double count = 0.0;
  double total = 0.0;
  for (const std::vector<CounterRun>& runs : windows) {
    double joules = 0.0;
    double seconds = 0.0;
    for (const CounterRun& run : runs) {
      joules += reader.joules(run);
      seconds += reader.seconds(run);
    }
    for (const CounterRun& run : runs) {
      std::size_t last = run.first;
      for (std::size_t i = run.first + 1; i <= run.last; ++i) {
        if (!reader.points()[i].changed) continue;
        const CounterRun part{last, i};
        if (reader.seconds(part) < least) continue;
        last = i;
        const double length = reader.seconds(part);
        const double off = reader.joules(part) / length - joules / seconds;
        // Less what the unknown ages of the two updates alone make of it.
        squares += off * off * length -
                   reader.errors(part, reader.points()[part.first].time).variance() / length;
        time += length;
        total += reader.joules(part);
        count += 1;
      }
    }
  }
  if (count == 0) return {};
  const double variance = std::max(0.0, squares) / time;
  const double mean = total / time;
  return {variance, time / count, mean > 0 ? std::sqrt(variance) / mean : 0.0};
}

/// The sums over all windows that mean_power() rests on.
struct Sums {
  double joules = 0.0;
  double covered = 0.0;
  double length = 0.0;
  ErrorSum errors;
};

Sums sum_windows(const CounterReader& reader, const std::vector<Window>& windows,
                 const std::vector<std::vector<CounterRun>>& runs) {
  const Fluctuation spread = fluctuation(reader, runs);
  Sums sums;
  double unseen_windows = 0.0;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const double length = (windows[w].to - windows[w].from).value;
    sums.length += length;
    double joules = 0.0;
    double seconds = 0.0;
    double unseen = 0.0;
    ErrorSum errors;
    Seconds edge = windows[w].from;
    for (const CounterRun& run : runs[w]) {
      joules += reader.joules(run) + reader.start_correction(run, windows[w].from);
      seconds += reader.seconds(run);
      errors.add(reader.errors(run, windows[w].from, spread.relative), 1.0);
      unseen += spread.unseen((reader.points()[run.first].time - edge).value);
      edge = reader.points()[run.last].time;
    }
    if (seconds <= 0) {
      unseen_windows += length;
      sums.errors.add_normal(spread.unseen(length));
      continue;
    }
    unseen += spread.unseen((windows[w].to - edge).value);
    const double scale = length / seconds;
    sums.joules += joules * scale;
    sums.errors.add(errors, scale);
    sums.errors.add_normal(unseen);
    sums.covered += std::min(seconds, length);
  }
  // A window between two updates: its power is taken as that of the others.
  const double seen = sums.length - unseen_windows;
  if (seen > 0) sums.joules *= sums.length / seen;
  return sums;
}

std::string too_little(const SourceInfo& source, double covered, double length) {
  return fmt::format(
      "only {:.3g} s of {:.3g} s lie between updates of {} (one each {:.3g} s) in one window; "
      "measure for longer at a time",
      covered, length, source.name, source.update_period.value);
}

std::optional<MeanPower> gauge_mean(const SourceInfo& source, const TraceView& trace,
                                    const std::vector<Window>& joined, std::string& why) {
  const double length = length_of(joined).value;
  auto mean =
      mean_of_updates(source, gauge_period(source, trace), settled_updates(source, trace, joined));
  if (!mean || mean->covered.value < kLeastCoveredByGauge * length) {
    why = fmt::format(
        "{} has too few independent settled updates in {:.3g} s (one each {:.3g} s, the "
        "first {:.3g} s of a window left out); measure for longer at a time",
        source.name, length, gauge_period(source, trace).value, settling_time(source, trace).value);
    return std::nullopt;
  }
  mean->length = Seconds(length);
  return mean;
}

std::optional<MeanPower> counter_mean(const SourceInfo& source, const TraceView& trace,
                                      const std::vector<Window>& joined, std::string& why) {
  const double length = length_of(joined).value;
  const CounterReader reader(source, trace);
  std::vector<std::vector<CounterRun>> runs;
  double updates = 0.0;
  for (const Window& window : joined) {
    runs.push_back(reader.runs(window));
    for (const CounterRun& run : runs.back()) updates += static_cast<double>(run.last - run.first);
  }
  const Sums sums = sum_windows(reader, joined, runs);
  if (sums.covered < kLeastCoveredByCounter * length) {
    why = too_little(source, sums.covered, length);
    return std::nullopt;
  }
  MeanPower mean;
  mean.length = Seconds(length);
  mean.covered = Seconds(sums.covered);
  mean.watts = sums.joules / length;
  mean.realised = sums.errors.chance().scaled(1.0 / length);
  mean.long_run = mean.realised;
  mean.effective_samples = updates;
  if (const auto batches = batches_of(source, trace, nullptr, joined)) {
    const std::array<Chance, 2> parts{mean.realised, batches->relative.scaled(mean.watts)};
    mean.long_run = combined(parts);
    mean.effective_samples = batches->effective;
  }
  return mean;
}

}  // namespace

std::vector<Window> join_windows(std::vector<Window> windows) {
  std::erase_if(windows, [](const Window& w) { return w.to <= w.from; });
  std::sort(windows.begin(), windows.end(),
            [](const Window& a, const Window& b) { return a.from < b.from; });
  std::vector<Window> joined;
  constexpr Seconds kNoBreak(1e-6);
  for (const Window& window : windows) {
    if (!joined.empty() && window.from - joined.back().to <= kNoBreak) {
      joined.back().to = std::max(joined.back().to, window.to);
    } else {
      joined.push_back(window);
    }
  }
  return joined;
}

Seconds length_of(const std::vector<Window>& windows) {
  Seconds sum;
  for (const Window& window : windows) sum += window.to - window.from;
  return sum;
}

Uncertain with_gain(double value, double half_width, double gain) {
  return {value, std::hypot(half_width, kNormal95 * gain * value), half_width};
}

std::optional<MeanPower> mean_power(const SourceInfo& source, const TraceView& trace,
                                    const std::vector<Window>& windows, std::string& why) {
  const std::vector<Window> joined = join_windows(windows);
  if (joined.empty() || trace.empty()) {
    why = trace.empty() ? source.name + " gave no reading" : "there is no window to measure";
    return std::nullopt;
  }
  return source.is_counter ? counter_mean(source, trace, joined, why)
                           : gauge_mean(source, trace, joined, why);
}

}  // namespace encore::energy
