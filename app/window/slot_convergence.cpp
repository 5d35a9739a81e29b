#include "app/window/slot_convergence.h"

#include "app/convergence_log.h"

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

/// Rows that wait for a sensor that may never tell again.
constexpr std::size_t kMostWaiting = 4096;

/// How far all sources of the total have got; nothing before their first readings.
std::optional<energy::Seconds> reached_by(const PowerSet& power) {
  std::optional<energy::Seconds> reached;
  for (const std::size_t source : power.total) {
    const auto latest = power.sampler->trace(source).latest();
    if (!latest) return std::nullopt;
    reached = std::min(reached.value_or(latest->time), latest->time);
  }
  return reached;
}

bool has_energy(const SlotRow& row) {
  return row.power && row.power->sampler && !row.power->total.empty();
}

}  // namespace

void SlotConvergence::add(SlotRow row) {
  if (!time_) time_.emplace(row.end - row.per_operation * row.operations);
  time_->add_row(row.end, row.operations, row.per_operation);
  if (!has_energy(row)) return;
  waiting_.push_back(std::move(row));
  if (waiting_.size() > kMostWaiting) {
    add_energy(waiting_.front());
    waiting_.pop_front();
  }
}

void SlotConvergence::update() {
  while (!waiting_.empty()) {
    const auto reached = reached_by(*waiting_.front().power);
    if (!reached || *reached < waiting_.front().end) return;
    add_energy(waiting_.front());
    waiting_.pop_front();
  }
}

void SlotConvergence::begin_slot(const SlotRow& row) {
  if (power_ != row.power) energy_.reset();
  slot_ = row.slot;
  power_ = row.power;
  points_.clear();
  sum_.emplace(*power_->sampler, power_->total, row.slot_start);
  if (!energy_) {
    energy_.emplace(row.end - row.per_operation * row.operations, sum_->slowest());
  }
}

void SlotConvergence::add_energy(const SlotRow& row) {
  if (slot_ != row.slot || power_ != row.power) begin_slot(row);
  sum_->tell_new([this](const energy::TracePoint& point) { points_.push_back(point); });
  for (; !points_.empty() && points_.front().time <= row.end; points_.pop_front()) {
    energy_->add_energy(points_.front());
  }
  energy_->add_row(row.end, row.operations, row.per_operation);
}

std::vector<energy::ConvergenceRow> SlotConvergence::rows(
    const std::vector<energy::KeyValue>& configuration) const {
  std::vector<energy::ConvergenceRow> rows;
  if (time_) {
    for (const auto& point : time_->points()) rows.push_back(convergence_row(point, configuration));
  }
  if (energy_) {
    for (const auto& point : energy_->points()) {
      const bool time = point.quantity == energy::ConvergenceQuantity::time_per_operation;
      if (!time) rows.push_back(convergence_row(point, configuration));
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.elapsed < b.elapsed; });
  return rows;
}

}  // namespace encore::app
