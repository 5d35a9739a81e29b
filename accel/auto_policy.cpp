#include "accel/auto_policy.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encore::accel {

namespace {

bool measured(double cost) {
  return std::isfinite(cost) && cost > 0.0;
}

}  // namespace

void RecentMedian::add(double value) {
  values_[count_++ % kKept] = value;
}

std::optional<double> RecentMedian::value() const {
  if (count_ == 0) return std::nullopt;
  const std::size_t held = std::min(count_, kKept);
  std::array<double, kKept> sorted = values_;
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(held);
  std::sort(sorted.begin(), end);
  return 0.5 * (sorted[(held - 1) / 2] + sorted[held / 2]);
}

void SteadyRate::add(double factor, std::uint64_t steps) {
  if (!measured(factor) || steps == 0) return;
  const double rate = std::log(factor) / static_cast<double>(steps);
  const bool agree = (rate > 0.0) == (last_ > 0.0);
  rate_ = agree ? std::copysign(std::min(std::abs(rate), std::abs(last_)), rate) : 0.0;
  last_ = rate;
}

double SteadyRate::over(std::uint64_t steps) const {
  return std::clamp(std::exp(rate_ * static_cast<double>(steps)), 0.5, 2.0);
}

double AutoPolicy::growth(double decay) const {
  return 1.0 + slope() * std::max(0.0, decay - 1.0);
}

double AutoPolicy::decay_of(std::optional<double> tree_cost) const {
  if (!tree_cost || !built_tree_) return 1.0;
  // A tree that was flat has no ratio; anything large says the same.
  constexpr double kMost = 1e3;
  if (!measured(*built_tree_)) return *tree_cost > 0.0 ? kMost : 1.0;
  return std::clamp(*tree_cost / (*built_tree_ * tree_drift_.over(cycle_updates_)), 0.0, kMost);
}

void AutoPolicy::observe_build(double cost) {
  ++rebuilds_;
  if (const auto frames = break_even_frames(); frames && frames_ > 1) break_even_.add(*frames);
  if (measured(cost)) {
    build_.add(cost);
    since_update_ += cost;
  }
  // Of a tree that was never updated there is nothing to learn about updates.
  before_ = {frames_ > 1 ? traced_ : 0.0, tree_cost_, built_tree_, built_trace_, cycle_updates_};
  frames_ = cycle_updates_ = 0;
  sum_ = excess_ = previous_excess_ = since_build_ = 0.0;
  built_trace_ = 0.0;
  built_tree_.reset();
  tree_cost_.reset();
  decay_ = 1.0;
}

void AutoPolicy::observe_update(double cost) {
  ++updates_;
  ++cycle_updates_;
  if (measured(cost)) {
    update_.add(cost);
    since_build_ += cost;
  }
  since_update_ = 0.0;
  updated_ = true;
}

void AutoPolicy::begin_cycle(double cost, std::optional<double> tree_cost) {
  built_trace_ = cost;
  built_tree_ = tree_cost;
  const std::uint64_t steps = before_.updates + 1;  // the build followed a change as well
  if (measured(before_.fresh_trace)) trace_drift_.add(cost / before_.fresh_trace, steps);
  if (!tree_cost || !before_.fresh_tree || !before_.tree_cost) return;
  tree_drift_.add(*tree_cost / *before_.fresh_tree, steps);
  if (!measured(before_.traced)) return;
  // What a fresh tree would have been, and cost, a frame ago.
  const double fresh_tree = *tree_cost / tree_drift_.over(1);
  const double fresh_trace = cost / trace_drift_.over(1);
  learn_slope(*before_.tree_cost / fresh_tree, before_.traced / fresh_trace);
}

void AutoPolicy::learn_slope(double decay, double ratio) {
  constexpr double kFade = 0.9;
  constexpr double kLeastDecay = 0.005;  // less says nothing beside the noise
  const double x = decay - 1.0;
  if (!std::isfinite(x) || x < kLeastDecay) return;
  const double line = slope() * x;
  const double off = ratio - 1.0 - line;
  const double y = line + std::clamp(off, -2.0 * misfit_, 2.0 * misfit_);
  misfit_ += 0.2 * (std::min(std::abs(off), 4.0 * misfit_) - misfit_);
  misfit_ = std::max(misfit_, 0.01);
  // A decay beyond all bounds must not outweigh everything that comes after it.
  const double weight = std::min(1.0, 1.0 / (x * x));
  slope_over_ = kFade * slope_over_ + weight * x * y;
  slope_under_ = kFade * slope_under_ + weight * x * x;
  // The start value fades to a tenth, so that one sample of hardly any decay never decides alone.
  if (slope_under_ < 0.1 * kStartWeight) {
    const double now = slope();
    slope_under_ = 0.1 * kStartWeight;
    slope_over_ = now * slope_under_;
  }
  slope_over_ = std::clamp(slope_over_, 0.02 * slope_under_, 4.0 * slope_under_);
}

void AutoPolicy::observe_frame(double cost, std::optional<double> tree_cost) {
  const bool updated = std::exchange(updated_, false);
  if (!measured(cost)) return;
  if (frames_ == 0) begin_cycle(cost, tree_cost);
  traced_ = cost;
  since_build_ += cost;
  since_update_ += cost;
  tree_cost_ = tree_cost;
  if (updated) decay_ = decay_of(tree_cost);
  fresh_trace_.add(cost / growth(decay_));
  previous_excess_ = excess_;
  excess_ = *fresh_trace_.value() * (growth(decay_) - 1.0);
  if (frames_ == 1 && updated) first_excess_.add(excess_);
  sum_ += excess_;
  ++frames_;
}

std::optional<double> AutoPolicy::build_surplus() const {
  const auto build = build_.value();
  const auto update = update_.value();
  if (!build || !update) return std::nullopt;
  return *build - *update;
}

std::optional<double> AutoPolicy::excess() const {
  if (!fresh_trace_.value()) return std::nullopt;
  return excess_;
}

double AutoPolicy::next_excess() const {
  if (frames_ <= 1) return first_excess_.value().value_or(0.0);
  return excess_ + std::max(0.0, excess_ - previous_excess_);
}

std::optional<bool> AutoPolicy::builds_next() const {
  if (rule_ == AutoRule::quality || !build_.value() || !fresh_trace_.value()) return std::nullopt;
  const auto surplus = build_surplus();
  if (!surplus) return false;  // the first update is the one that is measured
  const double n = static_cast<double>(frames_);
  const double next = next_excess();
  const bool pays = *surplus <= 0.0 || n * next >= *surplus + sum_;
  if (pays && frames_ <= 1) {
    // Both regimes of building each frame stand on an update of long ago.
    const double loss = next - *surplus;
    return loss > kTrialShare * since_update_;
  }
  if (pays) return true;
  return decay_ != 1.0 && *surplus <= kTrialShare * since_build_;
}

std::optional<double> AutoPolicy::break_even_frames() const {
  const auto surplus = build_surplus();
  if (!surplus || !fresh_trace_.value()) return std::nullopt;
  if (*surplus <= 0.0) return 0.0;
  if (!(excess_ > 0.0)) return std::nullopt;
  return *surplus / excess_;
}

AutoFigures AutoPolicy::figures() const {
  return {rebuilds_, updates_, break_even_frames(), break_even_.value()};
}

}  // namespace encore::accel
