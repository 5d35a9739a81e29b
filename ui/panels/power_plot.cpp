#include "ui/panels/panels.h"
#include "ui/panels/plot_parts.h"
#include "ui/panels/session_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/plot_draw.h"
#include "ui/plot/plot_export.h"
#include "ui/plot/strip_chart.h"
#include "ui/plot/value_text.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace encore::ui {

namespace {

constexpr const char* kHelp =
    "Discharge rate: the electric power in W that each source reports, over time in s. Steps are "
    "samples as they came in: a flat stretch is a source that repeats its value. Drag to select a "
    "range and see its mean, its energy in J and its spread; the wheel zooms, the right button "
    "moves, a double click shows everything.";

PlotColor slot_color(SlotView::Kind kind) {
  switch (kind) {
    case SlotView::Kind::idle:
      return PlotColor::idle;
    case SlotView::Kind::cpu:
      return PlotColor::cpu;
    case SlotView::Kind::gpu:
      return PlotColor::gpu;
    case SlotView::Kind::raster:
      return PlotColor::raster;
    case SlotView::Kind::build:
      return PlotColor::build;
  }
  return PlotColor::remainder;
}

const char* slot_name(SlotView::Kind kind) {
  switch (kind) {
    case SlotView::Kind::idle:
      return "idle";
    case SlotView::Kind::cpu:
      return "CPU";
    case SlotView::Kind::gpu:
      return "GPU";
    case SlotView::Kind::raster:
      return "raster";
    case SlotView::Kind::build:
      return "build";
  }
  return "";
}

/// The slots near what is in sight, and the first and last one, by which everything is fitted. What
/// goes on at the same time gets lanes of its own.
std::vector<StripSpan> spans_of(const PlotData& plots, const Axis& x) {
  std::vector<const SlotView*> slots;
  const double margin = x.high - x.low;
  for (std::size_t i = 0; i < plots.slots.size(); ++i) {
    const SlotView& slot = plots.slots[i];
    const bool near = slot.to_s >= x.low - margin && slot.from_s <= x.high + margin;
    if (near || i == 0 || i + 1 == plots.slots.size()) slots.push_back(&slot);
  }
  std::stable_sort(slots.begin(), slots.end(),
                   [](const SlotView* a, const SlotView* b) { return a->from_s < b->from_s; });
  std::array<double, 8> taken;
  taken.fill(-1e300);
  std::vector<StripSpan> spans;
  for (const SlotView* slot : slots) {
    std::size_t lane = 0;
    while (lane + 1 < taken.size() && taken.at(lane) > slot->from_s + 1e-9) ++lane;
    taken.at(lane) = std::max(taken.at(lane), slot->to_s);
    spans.push_back({.t0 = slot->from_s,
                     .t1 = slot->to_s,
                     .lane = static_cast<int>(lane),
                     .color = slot_color(slot->kind),
                     .name = slot_name(slot->kind),
                     .tooltip = slot->label});
  }
  return spans;
}

std::string why_empty(const PowerSeriesView& power, const PlotData& plots) {
  if (power.provenance.origin == energy::Origin::unavailable && !power.provenance.detail.empty()) {
    return power.provenance.detail;
  }
  return plots.no_power.empty() ? "no samples yet" : plots.no_power;
}

StripData strip_of(const ShownPlots& shown) {
  const PlotData& plots = shown.data;
  StripData strip;
  const auto in_total = std::count_if(plots.power.begin(), plots.power.end(),
                                      [](const PowerSeriesView& power) { return power.in_total; });
  for (std::size_t i = 0; i < plots.power.size(); ++i) {
    const PowerSeriesView& power = plots.power[i];
    StripSeries series;
    series.name = power.lost ? power.name + " (lost)" : power.name;
    series.color = series_color(i);
    series.history = power.history;
    series.provenance = power.provenance;
    series.reason = power.includes;
    if (power.history == nullptr || power.history->empty()) series.reason = why_empty(power, plots);
    // The idle level is the total's: a line can only show it where it is the whole total.
    if (power.in_total && in_total == 1 && plots.idle_watts) {
      series.idle = Level{*plots.idle_watts, plots.idle_half_width};
    }
    strip.series.push_back(std::move(series));
  }
  if (strip.series.empty()) {
    StripSeries none;  // no name, no entry in the legend: there is nothing to tell apart
    none.reason = plots.no_power.empty() ? "no power source is open" : plots.no_power;
    none.provenance = {energy::Origin::unavailable, none.reason};
    // Of the present, the words above the chart say why.
    if (!shown.session && !plots.no_power.empty()) none.reason = "no watts";
    strip.series.push_back(std::move(none));
  }
  strip.spans = spans_of(plots, shown.charts.power.x);
  for (const AnnotationView& note : plots.annotations) {
    strip.flags.push_back({note.time_s, note.text});
  }
  if (!shown.session) strip.now_s = plots.now_s;
  return strip;
}

/// The present or the opened session.
void draw_switch(const View& view, UiState& state) {
  if (view.session.folder.empty()) return;
  const std::string name = "Session " + session_name(view.session.folder);
  const std::string label = fitted(name, 14.0F * ImGui::GetFontSize());
  const std::string help = "All three plots show the session in " + view.session.folder;
  const std::array<PlotTool, 2> tools{{{.name = "now",
                                        .label = "Now",
                                        .help = "All three plots show what goes on.",
                                        .on = !state.show_session},
                                       {.name = "session",
                                        .label = label.c_str(),
                                        .help = help.c_str(),
                                        .on = state.show_session}}};
  ImGui::SameLine();
  if (const auto pressed = draw_tools("power", tools)) state.show_session = *pressed == 1;
}

std::string idle_words(const PlotData& plots) {
  if (!plots.idle_watts) return {};
  return "idle " + value_text(*plots.idle_watts, plots.idle_half_width, "W");
}

const std::array<PlotTool, 2> kWaysOut{
    {{.name = "doctor",
      .label = "Sensor doctor",
      .help = "Lists this machine's sensors, what is in the way of each, and the way out."},
     {.name = "watts",
      .label = "Enter idle and busy watts",
      .help = "With two readings of a meter, watts and joules are computed from busy times and "
              "marked as modelled."}}};

/// The ways out, and why there are no watts, in full where half of the height is enough.
void draw_ways_out(const PlotData& plots, UiState& state) {
  const auto pressed = draw_tools("power", kWaysOut);
  if (pressed == std::size_t{0}) state.doctor_open = true;
  if (pressed == std::size_t{1}) state.dialog = Dialog::energy;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (room.x < 4.0F * ImGui::GetFontSize()) return;
  const float lines = std::floor(0.55F * room.y / ImGui::GetTextLineHeight());
  const PlacedLabel words =
      fit_label(plots.no_power, room.x, static_cast<int>(std::clamp(lines, 1.0F, 12.0F)),
                [](std::string_view text) { return text_width(text); });
  std::string text;
  for (const std::string& one : words.lines) text += (text.empty() ? "" : "\n") + one;
  ImGui::TextDisabled("%s", text.c_str());
  note_widget("power.problem", plots.no_power);
  tooltip(plots.no_power);
}

void run_tool(std::string_view name, const ShownPlots& shown, const StripData& strip,
              UiState& state, Commands& commands) {
  StripState& chart = shown.charts.power;
  if (name == "annotate") state.dialog = Dialog::annotate;
  if (name == "copy_range") {
    commands.push_back(CopyText{selection_csv(strip, chart), "statistics of the range copied"});
  }
  if (name == "copy_csv") {
    commands.push_back(CopyText{strip_csv(strip, chart, 4000), "discharge rate copied as CSV"});
  }
  if (name == "save_png") commands.push_back(SavePicture{PictureOf::plots, {}});
}

}  // namespace

void draw_power_plot(const Rect& area, const View& view, UiState& state, Commands& commands) {
  if (begin_part("##power plot", area)) {
    const ShownPlots shown = shown_plots(view, state);
    const StripData strip = strip_of(shown);
    plot_title("power", "Discharge rate", kHelp);
    draw_switch(view, state);
    std::vector<PlotTool> tools;
    if (shown.charts.power.selection) {
      tools.push_back({.name = "copy_range",
                       .label = "Copy range",
                       .help = "Copies the statistics of the selected range as CSV: W, J, s."});
    }
    if (!shown.session) {
      tools.push_back({.name = "annotate",
                       .label = "Annotate",
                       .help = "Puts words at this moment: a flag here, a row in the session."});
    }
    const bool samples = std::any_of(strip.series.begin(), strip.series.end(), [](const auto& s) {
      return s.history != nullptr && !s.history->empty();
    });
    tools.push_back({.name = "copy_csv",
                     .label = "Copy",
                     .help = "Copies what is in sight as CSV: time in s, power in W, energy in J.",
                     .enabled = samples});
    tools.push_back({.name = "save_png",
                     .label = "PNG",
                     .help = "Saves a picture of the three plots; a notice names the file."});
    const float reserved = tools_width(tools);
    plot_words("power.idle", idle_words(shown.data),
               "Power while nothing runs, W, with its 95 % interval: the dashed line.", reserved);
    const auto pressed = draw_end_tools("power", tools);
    if (!shown.session && !shown.data.no_power.empty()) draw_ways_out(shown.data, state);
    strip_chart("power.chart", strip, shown.charts.power);
    if (pressed) run_tool(tools[*pressed].name, shown, strip, state, commands);
  }
  ImGui::End();
}

}  // namespace encore::ui
