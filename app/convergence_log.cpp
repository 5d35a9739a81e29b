#include "app/convergence_log.h"

#include <fmt/format.h>

#include <utility>

namespace encore::app {

namespace {

using energy::ConvergenceQuantity;
using energy::Seconds;
using energy::StopState;

std::optional<energy::SourceInfo> slowest_of(const std::optional<TotalEnergy>& total) {
  if (!total) return std::nullopt;
  return total->slowest();
}

std::optional<energy::StopRule> rule_of(const energy::Plan& plan, bool has_energy) {
  if (!plan.until) return std::nullopt;
  energy::StopRule rule;
  rule.quantity = has_energy ? ConvergenceQuantity::joules_per_operation
                             : ConvergenceQuantity::time_per_operation;
  rule.target = *plan.until;
  // The runner keeps the plan's limit: a prediction beyond it may still come true earlier, so only
  // what no time could mend (drift, the sensor's steps) ends the run before.
  return rule;
}

}  // namespace

TotalEnergy::TotalEnergy(const energy::Sampler& sampler, std::vector<std::size_t> total,
                         Seconds start)
    : sampler_(sampler), total_(std::move(total)), reached_(start) {
  for (std::size_t i = 1; i < total_.size(); ++i) {
    const Seconds period = sampler.info(total_[i]).update_period;
    if (period > sampler.info(total_[slowest_]).update_period) slowest_ = i;
  }
}

const energy::SourceInfo& TotalEnergy::slowest() const {
  return sampler_.info(total_[slowest_]);
}

void TotalEnergy::tell_new(const std::function<void(const energy::TracePoint&)>& tell) {
  // As far as every source of the sum has got.
  std::optional<Seconds> until;
  for (const std::size_t source : total_) {
    const auto latest = sampler_.trace(source).latest();
    if (!latest) return;
    until = std::min(until.value_or(latest->time), latest->time);
  }
  const energy::TraceView beat = sampler_.trace(total_[slowest_]).view(reached_, *until);
  for (const energy::TracePoint& point : beat.points()) {
    if (point.time > *until || point.time < reached_ || (!first_ && point.time == reached_)) {
      continue;
    }
    energy::TracePoint sum{point.time, {}, std::nullopt, point.changed, first_};
    for (const std::size_t source : total_) {
      if (first_) break;
      const auto part =
          sampler_.trace(source).view(reached_, point.time).energy_between(reached_, point.time);
      sum.starts_stretch = sum.starts_stretch || !part;
      if (part) sum_ += *part;
    }
    sum.energy = sum_;
    tell(sum);
    reached_ = point.time;
    first_ = false;
  }
}

ConvergenceLog::ConvergenceLog(const energy::Plan& plan, const energy::Sampler* sampler,
                               const std::vector<std::size_t>& total, Seconds start)
    : start_(start),
      rule_(rule_of(plan, sampler != nullptr && !total.empty())),
      energy_(sampler != nullptr && !total.empty()
                  ? std::optional<TotalEnergy>(std::in_place, *sampler, total, start)
                  : std::nullopt),
      tracker_(start, slowest_of(energy_)) {}

bool ConvergenceLog::add(const energy::FrameRow& row, Seconds now) {
  if (energy_) {
    energy_->tell_new([this](const energy::TracePoint& point) { tracker_.add_energy(point); });
  }
  const bool news = tracker_.add_row(now, static_cast<double>(row.operations), row.total());
  if (!news || !rule_) return news;
  outlook_ = energy::outlook(*rule_, tracker_);
  words_ = outlook_.words;
  if (!first_prediction_) first_prediction_ = outlook_.predicted;
  if (outlook_.state != StopState::out_of_reach) {
    hopeless_since_.reset();
  } else if (!hopeless_since_) {
    hopeless_since_ = now - start_;
  }
  return news;
}

bool ConvergenceLog::enough(Seconds now) {
  if (!rule_) return true;
  if (outlook_.state == StopState::reached) return true;
  // What looks hopeless early may not be: it has to stay so for as long again.
  return hopeless_since_ && now - start_ >= *hopeless_since_ * 2.0;
}

std::optional<Seconds> ConvergenceLog::new_prediction() {
  if (!first_prediction_ || prediction_told_) return std::nullopt;
  prediction_told_ = true;
  return first_prediction_;
}

std::string ConvergenceLog::verdict(Seconds now) const {
  if (!rule_) return {};
  const double elapsed = (now - start_).value;
  const std::string target =
      fmt::format("±{:g} % of {}", 100.0 * rule_->target, energy::to_string(rule_->quantity));
  const std::string prediction =
      first_prediction_ ? fmt::format(" (first predicted: {:.3g} s)", first_prediction_->value)
                        : std::string();
  if (outlook_.state == StopState::reached) {
    return fmt::format("{} was reached after {:.3g} s{}", target, elapsed, prediction);
  }
  return fmt::format("{} was not reached in {:.3g} s{}: {}", target, elapsed, prediction,
                     outlook_.words.empty() ? "too little was seen" : outlook_.words);
}

energy::ConvergenceRow convergence_row(const energy::ConvergencePoint& point,
                                       const std::vector<energy::KeyValue>& configuration) {
  energy::ConvergenceRow row;
  row.configuration = configuration;
  row.elapsed = point.elapsed;
  row.quantity = std::string(energy::to_string(point.quantity));
  row.mean = point.mean;
  row.ci95 = point.half_width;
  row.relative_ci95 = point.relative;
  row.effective_samples = point.effective_samples;
  row.allan_deviation = point.allan_deviation;
  row.allan_window = point.allan_window;
  row.drift_per_s = point.drift_per_second;
  return row;
}

std::vector<energy::ConvergenceRow> ConvergenceLog::rows(
    const std::vector<energy::KeyValue>& configuration) const {
  std::vector<energy::ConvergenceRow> rows;
  for (const energy::ConvergencePoint& point : tracker_.points()) {
    rows.push_back(convergence_row(point, configuration));
  }
  return rows;
}

}  // namespace encore::app
