#include "app/window/figures_view.h"

#include "app/session_input.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace encore::app {

namespace {

ui::EnergyFigure figure(const std::optional<double>& value, const std::optional<double>& half_width,
                        const energy::Provenance& provenance) {
  ui::EnergyFigure figure;
  figure.value = value;
  figure.half_width = half_width;
  figure.provenance = provenance;
  if (!value && provenance.origin != energy::Origin::unavailable) {
    figure.provenance = {energy::Origin::unavailable, provenance.detail};
  }
  return figure;
}

template <class Quantity>
std::optional<double> value_of(const std::optional<Quantity>& quantity) {
  if (!quantity) return std::nullopt;
  return quantity->value;
}

std::vector<ui::PhaseFigure> phases_of(const ConfigurationBars& bars) {
  std::vector<ui::PhaseFigure> phases;
  for (const PhaseBar& bar : bars.phases) {
    ui::PhaseFigure phase;
    phase.phase = bar.phase;
    phase.seconds = bar.seconds;
    energy::Provenance provenance = bars.energy;
    if (!bar.joules) {
      provenance = {energy::Origin::unavailable, bar.note.empty() ? provenance.detail : bar.note};
    }
    phase.joules = figure(bar.joules ? std::optional(bar.joules->value) : std::nullopt,
                          bar.joules ? bar.joules->half_width : std::nullopt, provenance);
    phases.push_back(std::move(phase));
  }
  return phases;
}

void add_errors(const std::vector<energy::ConvergenceRow>& rows,
                const std::vector<energy::KeyValue>& configuration, ui::ConfigurationView& view) {
  for (const energy::ConvergenceRow& row : rows) {
    if (row.configuration != configuration || !row.relative_ci95) continue;
    const ui::ErrorPoint point{row.elapsed.value, *row.relative_ci95, row.effective_samples};
    if (row.quantity == "time_per_operation") view.time_error.push_back(point);
    if (row.quantity == "joules_per_operation") view.joules_error.push_back(point);
  }
}

/// The render phase's joules, shared out by time.
ui::EnergyFigure share_of(const ui::ConfigurationView& view, double share) {
  ui::EnergyFigure joules;
  joules.provenance = {energy::Origin::unavailable, "rendering is not told apart from the rest"};
  for (const ui::PhaseFigure& phase : view.phases) {
    if (phase.phase != "render") continue;
    joules = phase.joules;
    if (!joules.value) continue;
    *joules.value *= share;
    if (joules.half_width) *joules.half_width *= share;
    joules.provenance.detail += "; render's joules, split by the time of each kind of ray";
  }
  return joules;
}

void add_ray_kinds(const energy::SummaryRow& summary, ui::ConfigurationView& view) {
  double all_ms = 0.0;
  for (std::size_t i = 0; i < scene::kRayKinds; ++i) {
    const auto kind = static_cast<scene::RayKind>(i);
    const std::string name(scene::to_string(kind));
    const auto rays = counter_value(summary, name + "_rays");
    if (rays.value_or(0.0) <= 0.0) continue;
    ui::RayKindCost cost;
    cost.kind = kind;
    cost.rays = rays;
    if (const auto ms = counter_value(summary, name + "_ms")) {
      cost.seconds = *ms / 1e3;
      all_ms += *ms;
    }
    view.rays.push_back(cost);
  }
  for (ui::RayKindCost& cost : view.rays) {
    if (cost.seconds && all_ms > 0.0) {
      cost.joules = share_of(view, *cost.seconds * 1e3 / all_ms);
    } else {
      cost.joules.provenance = {energy::Origin::unavailable,
                                "the time of this kind of ray is not told apart"};
    }
  }
}

ui::ConfigurationView view_of(const energy::SummaryRow& summary, const ConfigurationBars& bars) {
  ui::ConfigurationView view;
  view.label = bars.name;
  view.operations = static_cast<double>(summary.operations);
  view.measured_s = summary.seconds.value;
  view.mean_s = summary.mean.value;
  view.median_s = value_of(summary.median);
  view.ci95_s = value_of(summary.ci95);
  if (bars.mrays_per_s) view.rays_per_s = *bars.mrays_per_s * 1e6;
  view.watts = figure(value_of(summary.watts), value_of(summary.watts_ci95), bars.energy);
  view.joules = figure(value_of(summary.joules), value_of(summary.joules_ci95), bars.energy);
  view.net_joules =
      figure(value_of(summary.net_joules), value_of(summary.net_joules_ci95), bars.energy);
  view.phases = phases_of(bars);
  add_ray_kinds(summary, view);
  return view;
}

/// What a part of a configuration says to people; width and height are one.
std::string word_of(const std::vector<energy::KeyValue>& configuration, std::size_t i) {
  const energy::KeyValue& part = configuration[i];
  if (part.value.empty() || part.key == "height") return {};
  if (part.key == "width" && i + 1 < configuration.size()) {
    return part.value + "x" + configuration[i + 1].value;
  }
  if (part.key == "triangles") return part.value + " triangles";
  if (part.key == "repeat") return "repeat " + part.value;
  return part.value;
}

}  // namespace

std::vector<std::string> short_labels(
    const std::vector<std::vector<energy::KeyValue>>& configurations) {
  std::vector<std::string> labels;
  if (configurations.empty()) return labels;
  const auto& first = configurations.front();
  const auto differs = [&](std::size_t i) {
    return std::any_of(configurations.begin(), configurations.end(), [&](const auto& one) {
      return i < one.size() && one[i].value != first[i].value;
    });
  };
  for (const auto& configuration : configurations) {
    std::string label;
    for (std::size_t i = 0; i < configuration.size() && i < first.size(); ++i) {
      const std::string& key = configuration[i].key;
      const bool telling = key == "structure" || key == "device";
      const bool size = key == "width" && i + 1 < first.size() && differs(i + 1);
      if (!telling && !size && !differs(i)) continue;
      const std::string word = word_of(configuration, i);
      if (word.empty()) continue;
      if (!label.empty()) label += ", ";
      label += word;
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

namespace {

/// Where several configurations are shown together, what all have in common need not be said.
void shorten(const std::vector<std::vector<energy::KeyValue>>& configurations,
             std::vector<ui::ConfigurationView>& views) {
  const std::vector<std::string> labels = short_labels(configurations);
  for (std::size_t i = 0; i < views.size() && i < labels.size(); ++i) {
    if (!labels[i].empty()) views[i].label = labels[i];
  }
}

}  // namespace

std::vector<ui::ConfigurationView> views_of(const Figures& figures) {
  std::vector<ui::ConfigurationView> views;
  std::vector<std::vector<energy::KeyValue>> configurations;
  for (const LiveFigures& live : figures.configurations) {
    const auto bars = bars_of({live.summary}, live.phases, live.energy);
    if (bars.empty()) continue;
    ui::ConfigurationView view = view_of(live.summary, bars.front());
    if (!live.name.empty()) view.label = live.name;
    if (live.mrays_per_s) view.rays_per_s = *live.mrays_per_s * 1e6;
    view.notes = live.notes;
    add_errors(live.convergence, live.configuration, view);
    views.push_back(std::move(view));
    configurations.push_back(live.configuration);
  }
  shorten(configurations, views);
  return views;
}

std::vector<ui::ConfigurationView> views_of(const OpenedSession& session) {
  std::vector<ui::ConfigurationView> views;
  std::vector<std::vector<energy::KeyValue>> configurations;
  const auto& summaries = session.session.summaries;
  for (std::size_t i = 0; i < session.bars.size() && i < summaries.size(); ++i) {
    ui::ConfigurationView view = view_of(summaries[i], session.bars[i]);
    add_errors(session.session.convergence, summaries[i].configuration, view);
    views.push_back(std::move(view));
    configurations.push_back(summaries[i].configuration);
  }
  shorten(configurations, views);
  return views;
}

std::vector<ui::ChangeView> views_of(const OpenedComparison& comparison) {
  std::vector<ui::ChangeView> views;
  for (const ComparedConfiguration& one : comparison.matched) {
    ui::ChangeView view;
    view.label = one.name;
    view.a_s = one.seconds.a;
    view.b_s = one.seconds.b;
    view.time_percent = one.seconds.percent;
    if (one.seconds.interval) {
      view.time_low = one.seconds.interval->first;
      view.time_high = one.seconds.interval->second;
    }
    view.time_verdict = to_string(one.seconds.verdict);
    if (one.joules) {
      view.a_joules = one.joules->a;
      view.b_joules = one.joules->b;
      view.joules_percent = one.joules->percent;
      if (one.joules->interval) {
        view.joules_low = one.joules->interval->first;
        view.joules_high = one.joules->interval->second;
      }
      view.joules_verdict = to_string(one.joules->verdict);
    }
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace encore::app
