#include "energy/attribution/busy_timeline.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace encore::energy {

void BusyTimeline::Line::add(Seconds start, Seconds end, double amount, Seconds resolution,
                             std::size_t most) {
  const double before = knots.empty() ? 0.0 : knots.back().total;
  if (end < start || (!knots.empty() && start < knots.back().time)) {
    throw std::logic_error("busy spans of one column must follow each other in time");
  }
  if (end == start && amount == 0.0) return;
  // Short spans that follow each other closely become one line that still rises by their sum: the
  // last knot moves instead of two new ones being added.
  const std::size_t n = knots.size();
  if (n >= 2 && end - knots[n - 2].time <= resolution) {
    knots[n - 1] = {end, before + amount};
    return;
  }
  if (n == 0 || start > knots.back().time) knots.push_back({start, before});
  knots.push_back({end, before + amount});
  if (knots.size() > most) thin();
}

void BusyTimeline::Line::thin() {
  const std::size_t older = knots.size() / 2;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (i < older && i % 2 == 1) continue;
    knots[kept++] = knots[i];
  }
  knots.resize(kept);
}

double BusyTimeline::Line::at(Seconds time) const {
  const auto next = std::upper_bound(knots.begin(), knots.end(), time,
                                     [](Seconds t, const Knot& knot) { return t < knot.time; });
  if (next == knots.begin()) return 0.0;
  const Knot& a = *(next - 1);
  if (next == knots.end()) return a.total;
  return a.total + (next->total - a.total) * ((time - a.time) / (next->time - a.time));
}

BusyTimeline::BusyTimeline(std::vector<std::string> columns, Seconds resolution,
                           std::size_t most_knots)
    : columns_(std::move(columns)),
      resolution_(resolution),
      most_knots_(std::max<std::size_t>(most_knots, 8)),
      lines_(columns_.size()) {}

BusyTimeline BusyTimeline::of_phases(Seconds resolution) {
  std::vector<std::string> names;
  for (const Phase phase : kPhases) names.emplace_back(to_string(phase));
  return BusyTimeline(std::move(names), resolution);
}

void BusyTimeline::add(std::size_t column, Seconds start, Seconds end) {
  lines_.at(column).add(start, end, (end - start).value, resolution_, most_knots_);
}

void BusyTimeline::add_operations(double count, Seconds start, Seconds end) {
  operations_.add(start, end, count, resolution_, most_knots_);
}

Seconds BusyTimeline::busy(std::size_t column, Seconds from, Seconds to) const {
  const Line& line = lines_.at(column);
  return Seconds(line.at(to) - line.at(from));
}

double BusyTimeline::operations(Seconds from, Seconds to) const {
  return operations_.at(to) - operations_.at(from);
}

std::vector<BusyTimeline::Piece> BusyTimeline::pieces(std::size_t column, Seconds from,
                                                      Seconds to) const {
  std::vector<Piece> found;
  const std::vector<Knot>& knots = lines_.at(column).knots;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Knot& a = knots[i - 1];
    const Knot& b = knots[i];
    if (b.total <= a.total || b.time <= from || a.time >= to) continue;
    found.push_back({a.time, b.time, (b.total - a.total) / (b.time - a.time).value});
  }
  return found;
}

LiveBusyTime::LiveBusyTime(std::size_t history) : history_(std::max<std::size_t>(history, 1)) {
  knots_.push_back({});
}

void LiveBusyTime::remember(Knot knot) {
  knots_.push_back(std::move(knot));
  if (knots_.size() > history_) knots_.pop_front();
}

void LiveBusyTime::begin(Phase phase, Seconds now) {
  const std::lock_guard lock(mutex_);
  remember({now, knots_.back().done, phase});
}

void LiveBusyTime::end(Seconds now) {
  const std::lock_guard lock(mutex_);
  Knot knot{now, knots_.back().done, std::nullopt};
  if (const auto open = knots_.back().open) knot.done[*open] += now - knots_.back().time;
  remember(std::move(knot));
}

PerPhase<Seconds> LiveBusyTime::busy(Seconds time) const {
  const std::lock_guard lock(mutex_);
  auto after = std::upper_bound(knots_.begin(), knots_.end(), time,
                                [](Seconds t, const Knot& knot) { return t < knot.time; });
  if (after == knots_.begin()) return knots_.front().done;
  const Knot& knot = *(after - 1);
  PerPhase<Seconds> busy = knot.done;
  if (knot.open) busy[*knot.open] += time - knot.time;
  return busy;
}

}  // namespace encore::energy
