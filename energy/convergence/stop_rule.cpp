#include "energy/convergence/stop_rule.h"

#include "energy/student_t.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace encore::energy {

namespace {

/// The second assessment comes when a tenth more has passed.
constexpr double kSecondLook = 1.1;

std::string percent(double share) {
  return fmt::format("±{:.3g} %", 100.0 * share);
}

/// How far a half-width from so few samples must stay below the target.
double spare(double effective_samples) {
  return 1.0 + std::sqrt(1.25 / effective_samples);
}

bool meets(const StopRule& rule, const std::optional<Assessment>& assessment) {
  if (!assessment) return false;
  const ConvergencePoint& point = assessment->point;
  return point.relative && point.effective_samples >= rule.least_effective_samples &&
         *point.relative * spare(point.effective_samples) <= rule.target;
}

/// Where a drift's share of the error overtakes the scatter's.
struct DriftLimit {
  Seconds beyond;         ///< of measuring time
  double best = 0.0;      ///< relative half-width there
  double a_minute = 0.0;  ///< relative
};
std::optional<DriftLimit> drift_limit(const Assessment& now) {
  // Three half-widths: who looks often sees a drift by chance now and then.
  if (!now.drift || now.point.mean == 0.0 ||
      std::fabs(now.drift->per_second) < 3.0 * now.drift->half_width) {
    return std::nullopt;
  }
  const double mean = std::fabs(now.point.mean);
  const double slope = std::fabs(now.drift->per_second) / mean;
  const double window = now.point.elapsed.value / now.pauses;
  // Scatter about the line: half-width^2 = a / T. The drift moves the mean by slope * T / 2.
  const double a =
      std::pow(kNormal95 * now.drift->deviation / mean, 2) * window / now.drift->effective_samples;
  DriftLimit limit;
  limit.beyond = Seconds(std::cbrt(4.0 * a / (slope * slope)));
  limit.best = std::hypot(slope * limit.beyond.value / 2.0, std::sqrt(a / limit.beyond.value));
  limit.a_minute = 60.0 * now.drift->per_second / mean;
  return limit;
}

StopOutlook out_of_reach(std::string words) {
  return {StopState::out_of_reach, std::nullopt, std::move(words)};
}

/// What the rule asks of the time, all of it.
Seconds predict(const StopRule& rule, const Assessment& now) {
  const Pilot& pilot = *now.pilot;
  const Seconds independent = pilot.spacing * pilot.inflation;  // time of one sample
  Seconds measuring = independent * rule.least_effective_samples;
  measuring = std::max(measuring, required_time(pilot, rule.target));
  // With so many samples as there will be then.
  const double target = rule.target / spare(measuring / independent);
  measuring = std::max(measuring, required_time(pilot, target));
  return std::max(measuring * now.pauses, now.point.elapsed) * kSecondLook;
}

StopOutlook still_measuring(const StopRule& rule, const Assessment& now) {
  const Pilot& pilot = *now.pilot;
  const std::string wanted = percent(rule.target);
  const Seconds predicted = predict(rule, now);
  if (!std::isfinite(predicted.value)) {
    return out_of_reach(
        fmt::format("the sensor's steps are too coarse: {} is out of reach, {} at best", wanted,
                    percent(kNormal95 * pilot.floor)));
  }
  std::string words = fmt::format("{} needs about {:.3g} s", wanted, predicted.value);
  const Seconds edges = edge_bound(pilot.edge, rule.target / kNormal95) * now.pauses;
  if (edges * 2.0 > predicted) {
    words += fmt::format(" (the sensor updates every {:.3g} s: at least {:.3g} s)",
                         now.shortest.value, edges.value);
  }
  if (rule.limit && predicted > *rule.limit) {
    const Seconds used = *rule.limit / now.pauses;
    words += fmt::format(", more than the limit of {:.4g} s, which gives about {}",
                         rule.limit->value, percent(expected_half_width(pilot, used)));
    return out_of_reach(std::move(words));
  }
  return {StopState::measuring, predicted, std::move(words)};
}

}  // namespace

StopOutlook outlook(const StopRule& rule, const ConvergenceTracker& tracker) {
  const auto& latest = tracker.latest(rule.quantity);
  if (!latest) return {StopState::measuring, std::nullopt, "nothing has been measured yet"};
  const Assessment& now = *latest;
  if (meets(rule, latest) && meets(rule, tracker.previous(rule.quantity))) {
    return {
        StopState::reached, now.point.elapsed,
        fmt::format("{} after {:.3g} s", percent(*now.point.relative), now.point.elapsed.value)};
  }
  if (rule.limit && now.point.elapsed >= *rule.limit) {
    return out_of_reach(fmt::format(
        "the limit of {:.4g} s is over: {}", rule.limit->value,
        now.point.relative ? percent(*now.point.relative) : std::string("too little to tell")));
  }
  const auto drift = drift_limit(now);
  // The line explains nothing that matters where the target lies above what it spoils.
  if (drift && drift->best > rule.target) {
    return out_of_reach(fmt::format(
        "a drift of {:+.2g} %/min outweighs averaging beyond {:.3g} s: {} is out of reach, {} at "
        "best; warm up longer, or measure in shorter windows",
        100.0 * drift->a_minute, drift->beyond.value, percent(rule.target), percent(drift->best)));
  }
  if (!now.pilot || now.point.effective_samples < 3.0) {
    return {StopState::measuring, std::nullopt, "too few independent samples to tell how long"};
  }
  return still_measuring(rule, now);
}

}  // namespace encore::energy
