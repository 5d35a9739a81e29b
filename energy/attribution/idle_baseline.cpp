#include "energy/attribution/idle_baseline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace encore::energy {

namespace {

/// Idle power at one side of the load, and the middle of its time.
struct Side {
  MeanPower power;
  double middle = 0.0;
};

double middle_of(const std::vector<Window>& windows) {
  double weighted = 0.0;
  for (const Window& w : windows) {
    weighted += 0.5 * (w.from + w.to).value * (w.to - w.from).value;
  }
  return weighted / length_of(windows).value;
}

std::optional<Side> side_of(const SourceInfo& source, const TraceView& trace,
                            const std::vector<Window>& windows, std::string& why) {
  if (windows.empty()) return std::nullopt;
  const auto power = mean_power(source, trace, windows, why);
  if (!power) return std::nullopt;
  return Side{*power, middle_of(windows)};
}

/// The windows up to `time` and those from it on; one that holds it is cut.
std::pair<std::vector<Window>, std::vector<Window>> cut_at(const std::vector<Window>& windows,
                                                           Seconds time) {
  std::pair<std::vector<Window>, std::vector<Window>> sides;
  for (const Window& w : windows) {
    if (w.from < time) sides.first.push_back({w.from, std::min(w.to, time)});
    if (w.to > time) sides.second.push_back({std::max(w.from, time), w.to});
  }
  return sides;
}

/// The time by which half of the windows' length has passed.
Seconds half_time(const std::vector<Window>& windows) {
  double left = 0.5 * length_of(windows).value;
  for (const Window& w : windows) {
    const double length = (w.to - w.from).value;
    if (left <= length) return w.from + Seconds(left);
    left -= length;
  }
  return windows.back().to;
}

void set_drift(IdleBaseline& idle, const Side& early, const Side& late) {
  const std::array<Chance, 2> parts{early.power.long_run, late.power.long_run};
  const Chance chance = combined(parts);
  const double difference = late.power.watts - early.power.watts;
  const double rounding = 1e-9 * std::fabs(late.power.watts);
  idle.drift = Uncertain{difference, chance.half_width, chance.half_width};
  idle.drifted = std::fabs(difference) > std::max(rounding, 3.0 * chance.standard_error);
}

}  // namespace

std::optional<IdleEstimate> idle_baseline(const SourceInfo& source, const TraceView& trace,
                                          const std::vector<Window>& idle, Seconds at,
                                          std::string& why) {
  const std::vector<Window> windows = join_windows(idle);
  if (windows.empty()) {
    why = "no idle windows were recorded";
    return std::nullopt;
  }
  const auto [before, after] = cut_at(windows, at);
  std::string side_why;
  const auto pre = side_of(source, trace, before, side_why);
  const auto post = side_of(source, trace, after, side_why);
  IdleBaseline baseline;
  baseline.length = length_of(windows);
  baseline.measured_at = Seconds(middle_of(windows));
  double value = 0.0;
  Chance chance;
  if (pre && post) {
    const double share = (at.value - pre->middle) / (post->middle - pre->middle);
    value = pre->power.watts + share * (post->power.watts - pre->power.watts);
    const std::array<Chance, 2> parts{pre->power.long_run.scaled(1 - share),
                                      post->power.long_run.scaled(share)};
    chance = combined(parts);
    set_drift(baseline, *pre, *post);
  } else {
    const auto all = mean_power(source, trace, windows, why);
    if (!all) return std::nullopt;
    value = all->watts;
    chance = all->long_run;
    const auto [earlier, later] = cut_at(windows, half_time(windows));
    const auto first = side_of(source, trace, earlier, side_why);
    const auto second = side_of(source, trace, later, side_why);
    if (first && second) set_drift(baseline, *first, *second);
  }
  if (baseline.drifted) {
    ErrorSum way;
    way.add_uniform(baseline.drift->value);
    const std::array<Chance, 2> parts{chance, way.chance()};
    chance = combined(parts);
  }
  baseline.watts = with_gain(value, chance.half_width, source.gain_uncertainty);
  return IdleEstimate{baseline, chance};
}

}  // namespace encore::energy
