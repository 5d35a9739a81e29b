#include "ui/panels/panels.h"
#include "ui/panels/plot_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/error_chart.h"
#include "ui/plot/plot_export.h"
#include "ui/plot/value_text.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace encore::ui {

namespace {

constexpr const char* kHelp =
    "How well time and energy of an operation are known, after how long: half the 95 % interval in "
    "% of the mean, over run time in s, both logarithmic. A colour a configuration; time is solid, "
    "energy dashed. The faint slope is that of 1/sqrt(t), by which the error of independent "
    "samples "
    "falls; the line across is the stop target. Intervals of fewer than 8 independent samples tell "
    "next to nothing and are left out.\n"
    "Pictures of several rays a pixel: the estimated error of the picture itself, as root mean "
    "square over its pixels in % of white, over the time spent drawing it.";

using Places = std::vector<std::size_t>;

/// The chosen configuration, else those that are set in the panes now and then the latest, as many
/// as their legend has room for.
Places shown_places(const PlotData& plots, const std::optional<std::string>& chosen, float height) {
  const auto& all = plots.configurations;
  for (std::size_t i = 0; i < all.size() && chosen; ++i) {
    if (all[i].label == *chosen) return {i};
  }
  const auto most =
      static_cast<std::size_t>(std::clamp(height / ImGui::GetFontSize() / 4.0F, 1.0F, 5.0F));
  Places places;
  for (const bool in_pane : {true, false}) {
    for (std::size_t i = all.size(); i-- > 0 && places.size() < most;) {
      if (all[i].pane.has_value() == in_pane) places.push_back(i);
    }
  }
  std::sort(places.begin(), places.end());
  return places;
}

template <class Points>
ErrorSeries series_of(std::string name, std::size_t color, const Points& points,
                      const energy::Provenance& provenance, std::string reason) {
  ErrorSeries series;
  series.name = std::move(name);
  series.color = series_color(color);
  series.provenance = provenance;
  for (const auto& point : points) {
    series.points.push_back({point.elapsed_s, point.relative, point.samples});
  }
  if (series.points.empty()) series.reason = std::move(reason);
  return series;
}

/// The pictures' own errors, in colours that the configurations have left.
void add_pictures(const PlotData& plots, std::size_t first_color, ErrorData& data) {
  for (std::size_t i = 0; i < plots.pictures.size(); ++i) {
    const PictureErrorView& picture = plots.pictures[i];
    ErrorSeries series;
    series.name = picture.label;
    series.group = picture.label;
    series.quantity = "picture";
    series.aims = false;
    series.color = series_color(first_color + i);
    series.provenance = {energy::Origin::measured,
                         "estimated from how far the picture's samples differ"};
    for (const PictureError& error : picture.errors) {
      series.points.push_back({error.elapsed_s, error.rmse});
    }
    data.series.push_back(std::move(series));
  }
}

ErrorData error_data(const PlotData& plots, const Places& places, float target_percent) {
  ErrorData data;
  if (target_percent > 0.0F) data.target = static_cast<double>(target_percent) / 100.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ConfigurationView& one = plots.configurations[places[i]];
    ErrorSeries time =
        series_of(one.label + ", time", i, one.time_error, {energy::Origin::measured, "clock"},
                  "time: not enough operations yet");
    const std::string& why = one.joules.provenance.detail;
    ErrorSeries energy =
        series_of(one.label + ", energy", i, one.joules_error, one.joules.provenance,
                  one.joules.value || why.empty() ? "energy: no interval yet" : "energy: " + why);
    time.quantity = "time";
    energy.quantity = "energy";
    energy.dashed = true;
    time.group = energy.group = one.label;
    data.series.push_back(std::move(time));
    data.series.push_back(std::move(energy));
  }
  add_pictures(plots, places.size(), data);
  return data;
}

/// "1 % in about 3 min": the last series to reach the target, if all of them will.
std::string estimate_text(const ErrorData& data) {
  if (!data.target) return {};
  std::optional<double> longest;
  bool all_reached = true;
  bool any = false;
  for (const ErrorSeries& series : data.series) {
    if (!series.aims) continue;
    const auto when = target_time(series, *data.target);
    if (!when) {
      if (!series.points.empty()) return {};  // of too few samples: it cannot be told
      continue;
    }
    any = true;
    if (when->reached) continue;
    all_reached = false;
    longest = std::max(longest.value_or(0.0), when->elapsed_s - series.points.back().elapsed_s);
  }
  if (!any) return {};
  const std::string target = fmt::format("{:.3g} %", 100.0 * *data.target);
  if (all_reached) return target + " reached";
  return fmt::format("{} in about {}", target, duration_text(*longest));
}

/// Which configuration is shown.
void draw_choice(const PlotData& plots, const Places& places, std::optional<std::string>& chosen) {
  if (plots.configurations.empty()) return;
  const bool known =
      chosen && places.size() == 1 && plots.configurations[places.front()].label == *chosen;
  const std::string now = places.size() == 1 ? plots.configurations[places.front()].label
                                             : fmt::format("the newest {}", places.size());
  ImGui::SameLine();
  const float em = ImGui::GetFontSize();
  const float width = std::min(ImGui::CalcTextSize(now.c_str()).x + 3.0F * em,
                               0.45F * ImGui::GetContentRegionAvail().x);
  ImGui::SetNextItemWidth(std::max(6.0F * em, width));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ImGui::GetStyle().FramePadding.x, 0.0F));
  const bool open = ImGui::BeginCombo("##configuration", now.c_str());
  ImGui::PopStyleVar();
  if (!open) {
    note_widget("error.configuration", now);
    tooltip(now + "\nThe configuration whose error is shown.");
    return;
  }
  if (ImGui::Selectable("the newest", !known)) chosen.reset();
  note_widget("error.configuration.newest");
  for (std::size_t i = 0; i < plots.configurations.size(); ++i) {
    const std::string& label = plots.configurations[i].label;
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(label.c_str(), known && label == *chosen)) chosen = label;
    ImGui::PopID();
    if (widget_map_enabled()) note_widget(fmt::format("error.configuration.{}", i), label);
  }
  ImGui::EndCombo();
}

}  // namespace

void draw_error_plot(const Rect& area, const View& view, UiState& state, Commands& commands) {
  if (begin_part("##error plot", area)) {
    const ShownPlots shown = shown_plots(view, state);
    plot_title("error", "Error", kHelp);
    std::optional<std::string>& chosen = shown.charts.configuration;
    const Places places = shown_places(shown.data, chosen, ImGui::GetContentRegionAvail().y);
    draw_choice(shown.data, places, chosen);
    const ErrorData data = error_data(shown.data, places, state.settings.measure.target_percent);
    const bool any = std::any_of(data.series.begin(), data.series.end(),
                                 [](const ErrorSeries& series) { return !series.points.empty(); });
    const std::array<PlotTool, 2> tools{
        {{.name = "copy_csv",
          .label = "Copy",
          .help =
              "Copies all points as CSV: run time in s, relative half-width of the 95 % interval, "
              "independent samples.",
          .enabled = any},
         {.name = "save_png",
          .label = "PNG",
          .help = "Saves a picture of the three plots; a notice names the file."}}};
    plot_words("error.estimate", estimate_text(data),
               "An estimate of the run time that is left: by the slope of 1/sqrt(t) from the last "
               "point on, for the slowest of time and energy. Run time counts from a "
               "configuration's first slot.",
               tools_width(tools));
    const auto pressed = draw_end_tools("error", tools);
    if (pressed == std::size_t{0}) {
      commands.push_back(CopyText{errors_csv(data), "error against run time copied as CSV"});
    }
    if (pressed == std::size_t{1}) commands.push_back(SavePicture{PictureOf::plots, {}});
    error_chart("error.chart", data, shown.charts.errors, {0.0F, 0.0F},
                shown.session ? "the session has no figures of convergence"
                              : "nothing measured yet: start measure mode");
  }
  ImGui::End();
}

}  // namespace encore::ui
