#include "ui/panels/bar_data.h"

#include "ui/panels/plot_parts.h"
#include "ui/panels/session_parts.h"
#include "ui/plot/value_text.h"

#include <fmt/format.h>

#include <utility>

namespace encore::ui {

namespace {

constexpr const char* kRest = "not told apart";
constexpr const char* kWhole = "all phases";

BarPart energy_part(const PhaseFigure& phase) {
  return {.name = phase.phase,
          .color = phase_color(phase.phase),
          .value = phase.joules.value,
          .half_width = phase.joules.half_width,
          .provenance = phase.joules.provenance};
}

/// "65,536 rays an operation in 0.42 ms, 12 mJ".
std::string rays_text(const RayKindCost& cost) {
  std::string text = value_text(*cost.rays, "", 4) + " rays an operation";
  if (cost.seconds) text += " in " + value_text(*cost.seconds, "s", 3);
  if (cost.joules.value) text += ", " + value_text(*cost.joules.value, "J", 3);
  return text;
}

/// Rendering's part in as many parts as there were kinds of rays; itself where there was one, or
/// they are not told apart. `value_of`: what of a kind is shown.
template <class ValueOf>
std::vector<BarPart> split_render(const BarPart& whole, const std::vector<RayKindCost>& rays,
                                  const ValueOf& value_of) {
  std::vector<BarPart> parts;
  for (const RayKindCost& kind : rays) {
    const std::optional<double> value = value_of(kind);
    if (!value) return {whole};
    BarPart part = whole;
    part.name = fmt::format("render: {} rays", scene::to_string(kind.kind));
    part.value = value;
    part.half_width.reset();
    part.color = ray_color(kind.kind);
    part.detail = rays_text(kind);
    parts.push_back(std::move(part));
  }
  if (parts.size() < 2) return {whole};
  return parts;
}

BarPart whole_part(const EnergyFigure& figure) {
  return {.name = kWhole,
          .color = PlotColor::remainder,
          .value = figure.value,
          .half_width = figure.half_width,
          .provenance = figure.provenance};
}

/// Puts one part in the place of those whose energy is unknown, as large as what they leave of the
/// total. Nothing changes where noise leaves less than nothing.
void join_unknown(const EnergyFigure& total, std::vector<BarPart>& parts) {
  double known = 0.0;
  std::string unknown;
  for (const BarPart& part : parts) {
    if (part.value) {
      known += *part.value;
    } else {
      unknown += (unknown.empty() ? "" : ", ") + part.name;
    }
  }
  if (!total.value || unknown.empty() || *total.value < known) return;
  std::erase_if(parts, [](const BarPart& part) { return !part.value; });
  BarPart rest = whole_part(total);
  rest.name = kRest;
  rest.value = *total.value - known;
  rest.half_width.reset();
  rest.provenance.detail += fmt::format("; {} together, what the total leaves", unknown);
  parts.push_back(std::move(rest));
}

Bar energy_bar(const ConfigurationView& configuration) {
  Bar bar{.name = "energy", .unit = "J", .half_width = {}, .parts = {}};
  for (const PhaseFigure& phase : configuration.phases) {
    const BarPart part = energy_part(phase);
    if (phase.phase != "render" || !part.value) {
      bar.parts.push_back(part);
      continue;
    }
    for (BarPart& kind : split_render(part, configuration.rays,
                                      [](const RayKindCost& cost) { return cost.joules.value; })) {
      bar.parts.push_back(std::move(kind));
    }
  }
  join_unknown(configuration.joules, bar.parts);
  if (bar.parts.empty()) bar.parts.push_back(whole_part(configuration.joules));
  if (configuration.joules.value) bar.half_width = configuration.joules.half_width;
  return bar;
}

Bar time_bar(const ConfigurationView& configuration) {
  Bar bar{
      .name = "time", .unit = "s", .pale = true, .half_width = configuration.ci95_s, .parts = {}};
  const energy::Provenance clock{energy::Origin::measured, "clock"};
  for (const PhaseFigure& phase : configuration.phases) {
    if (!phase.seconds) continue;
    const BarPart part{.name = phase.phase,
                       .color = phase_color(phase.phase),
                       .value = phase.seconds,
                       .half_width = {},
                       .provenance = clock};
    if (phase.phase != "render") {
      bar.parts.push_back(part);
      continue;
    }
    for (BarPart& kind : split_render(part, configuration.rays,
                                      [](const RayKindCost& cost) { return cost.seconds; })) {
      bar.parts.push_back(std::move(kind));
    }
  }
  if (!bar.parts.empty()) return bar;
  const energy::Provenance none{energy::Origin::unavailable, "no operation has ended yet"};
  bar.parts.push_back({.name = kWhole,
                       .color = PlotColor::remainder,
                       .value = configuration.mean_s,
                       .half_width = {},
                       .provenance = configuration.mean_s ? clock : none});
  return bar;
}

Bar plain_bar(std::string name, const char* unit, PlotColor color, std::optional<double> value,
              energy::Provenance provenance) {
  Bar bar{.name = std::move(name), .unit = unit, .half_width = {}, .parts = {}};
  bar.parts.push_back({.name = unit == std::string_view("J") ? "energy" : "time",
                       .color = color,
                       .value = value,
                       .half_width = {},
                       .provenance = std::move(provenance)});
  return bar;
}

/// Joules are compared only where both sessions have them from the same kind of origin.
energy::Provenance compared_energy(const SessionView& session, const ChangeView& change) {
  if (!change.a_joules || !change.b_joules) {
    return {energy::Origin::unavailable, "not in both sessions from the same kind of origin"};
  }
  for (const ConfigurationView& one : session.plots.configurations) {
    if (one.label == change.label && one.joules.value) return one.joules.provenance;
  }
  for (const ConfigurationView& one : session.plots.configurations) {
    if (one.joules.value) return one.joules.provenance;
  }
  return {energy::Origin::unavailable, "the sessions do not say what they rest on"};
}

}  // namespace

BarData configuration_bars(const std::vector<ConfigurationView>& configurations) {
  BarData data;
  for (const ConfigurationView& configuration : configurations) {
    data.groups.push_back(
        {configuration.label, {energy_bar(configuration), time_bar(configuration)}});
  }
  return data;
}

BarData comparison_bars(const SessionView& session) {
  const energy::Provenance clock{energy::Origin::measured, "clock"};
  const std::string a = "A: " + session_name(session.folder);
  const std::string b = "B: " + session_name(session.other_folder);
  BarData data;
  for (const ChangeView& change : session.changes) {
    const energy::Provenance origin = compared_energy(session, change);
    energy::Provenance other = origin;
    if (other.origin != energy::Origin::unavailable) other.detail = "as session B says";
    BarGroup group{change.label,
                   {plain_bar(a, "J", PlotColor::render, change.a_joules, origin),
                    plain_bar(b, "J", PlotColor::render, change.b_joules, other),
                    plain_bar(a, "s", PlotColor::build, change.a_s, clock),
                    plain_bar(b, "s", PlotColor::build, change.b_s, clock)}};
    group.bars[1].pale = true;
    group.bars[3].pale = true;
    data.groups.push_back(std::move(group));
  }
  return data;
}

}  // namespace encore::ui
