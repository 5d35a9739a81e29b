#include "app/session_input.h"
#include "app/window/opened_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace encore::app {

namespace {

template <class Unit>
std::optional<BarFigure> figure_of(const std::optional<Unit>& value,
                                   const std::optional<Unit>& half_width) {
  if (!value) return std::nullopt;
  BarFigure figure{value->value, std::nullopt};
  if (half_width) figure.half_width = half_width->value;
  return figure;
}

std::string name_of(const std::vector<energy::KeyValue>& configuration) {
  std::string name = configuration_name(configuration);
  const std::string repeat = configuration_value(configuration, "repeat");
  if (!repeat.empty() && repeat != "1") name += ", repeat " + repeat;
  return name;
}

void take_energy(const energy::PhaseRow& row, PhaseBar& bar) {
  bar.joules = figure_of(row.joules, row.joules_ci95);
  bar.net_joules = figure_of(row.net_joules, row.net_joules_ci95);
  bar.method = row.method;
  bar.note = row.note;
}

/// The phases that ran, then what is left of the total.
std::vector<PhaseBar> phases_of(const energy::SummaryRow& summary,
                                const std::vector<const energy::PhaseRow*>& rows) {
  std::vector<PhaseBar> bars;
  for (const energy::Phase phase : energy::kPhases) {
    if (!summary.shares[phase]) continue;
    PhaseBar bar;
    bar.phase = std::string(energy::to_string(phase));
    bar.seconds = summary.mean.value * *summary.shares[phase];
    for (const energy::PhaseRow* row : rows) {
      if (row->phase == bar.phase) take_energy(*row, bar);
    }
    bars.push_back(std::move(bar));
  }
  for (const energy::PhaseRow* row : rows) {
    if (row->phase != "remainder" || !row->joules) continue;
    PhaseBar bar;
    bar.phase = row->phase;
    take_energy(*row, bar);
    bars.push_back(std::move(bar));
  }
  return bars;
}

energy::Provenance energy_of(const energy::SummaryRow& summary, const energy::Provenance& sensor,
                             const std::vector<const energy::PhaseRow*>& rows) {
  if (summary.joules) {
    return {summary.origin, summary.source.empty() ? sensor.detail : summary.source};
  }
  std::string why = sensor.detail;
  if (sensor.origin != energy::Origin::unavailable) {
    why = "the sensor could not tell it: too little was measured";
    for (const energy::PhaseRow* row : rows) {
      if (!row->note.empty()) why = row->note;
    }
  }
  return {energy::Origin::unavailable, why};
}

ComparedConfiguration::Change change_of(const FigureChange& change) {
  ComparedConfiguration::Change shown;
  shown.a = change.a;
  shown.b = change.b;
  shown.percent = 100.0 * (change.ratio - 1.0);
  if (change.low && change.high) {
    shown.interval = {100.0 * (*change.low - 1.0), 100.0 * (*change.high - 1.0)};
  }
  shown.verdict = change.verdict;
  return shown;
}

}  // namespace

std::vector<ConfigurationBars> bars_of(const std::vector<energy::SummaryRow>& summaries,
                                       const std::vector<energy::PhaseRow>& phases,
                                       const energy::Provenance& sensor) {
  std::vector<ConfigurationBars> all;
  for (const energy::SummaryRow& summary : summaries) {
    std::vector<const energy::PhaseRow*> rows;
    for (const energy::PhaseRow& row : phases) {
      if (row.source == "total" && row.configuration == summary.configuration) rows.push_back(&row);
    }
    ConfigurationBars bars;
    bars.configuration = summary.configuration;
    bars.name = name_of(summary.configuration);
    bars.seconds = *figure_of(std::optional(summary.mean), summary.ci95);
    bars.joules = figure_of(summary.joules, summary.joules_ci95);
    bars.net_joules = figure_of(summary.net_joules, summary.net_joules_ci95);
    bars.mrays_per_s = counter_value(summary, "mrays_per_s");
    bars.energy = energy_of(summary, sensor, rows);
    bars.phases = phases_of(summary, rows);
    all.push_back(std::move(bars));
  }
  return all;
}

OpenedComparison compare_opened(const OpenedSession& a, const OpenedSession& b) {
  const Comparison comparison = compare_sessions(a.session, b.session, std::nullopt);
  OpenedComparison shown;
  for (const ConfigurationChange& change : comparison.matched) {
    ComparedConfiguration one;
    one.name = configuration_name(change.configuration);
    one.seconds = change_of(change.seconds);
    if (change.joules) one.joules = change_of(*change.joules);
    shown.matched.push_back(std::move(one));
  }
  for (const auto& only : comparison.only_a) shown.only_a.push_back(configuration_name(only));
  for (const auto& only : comparison.only_b) shown.only_b.push_back(configuration_name(only));
  shown.warnings = comparison.warnings;
  return shown;
}

}  // namespace encore::app
