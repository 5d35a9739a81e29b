#include "ui/panels/bar_data.h"
#include "ui/panels/change_text.h"
#include "ui/panels/panels.h"
#include "ui/panels/plot_parts.h"
#include "ui/panels/session_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/plot_export.h"
#include "ui/plot/stacked_bars.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace encore::ui {

namespace {

constexpr const char* kHelp =
    "What one operation (a frame with all that it needs) cost in each configuration so far: energy "
    "in J, gross, and beside it, hatched, time in s; a colour a phase. Point at a bar for its "
    "figures; the wheel scrolls; a click selects.";
constexpr const char* kCompareHelp =
    "Session A beside session B (hatched): energy in J and time in s of one operation. The table "
    "says how far they differ in %, with the 95 % interval, and whether that is more than noise.";

bool any_energy(const BarData& data) {
  for (const BarGroup& group : data.groups) {
    for (const Bar& bar : group.bars) {
      if (bar.unit != "J") continue;
      if (std::any_of(bar.parts.begin(), bar.parts.end(),
                      [](const BarPart& part) { return part.value.has_value(); })) {
        return true;
      }
    }
  }
  return false;
}

/// Why there are no joules at all; empty if there are some, or nothing was measured.
std::string no_energy(const BarData& data, const PlotData& plots) {
  if (data.groups.empty() || any_energy(data)) return {};
  if (!plots.no_power.empty()) return "Energy unavailable: " + plots.no_power;
  for (const ConfigurationView& one : plots.configurations) {
    if (!one.joules.provenance.detail.empty()) {
      return "Energy unavailable: " + one.joules.provenance.detail;
    }
  }
  return "Energy unavailable";
}

std::string first_csv_file(const UiState& state) {
  const std::string& last = state.preferences.last_folder;
  const std::filesystem::path folder = last.empty() ? home_folder() : std::filesystem::path(last);
  return (folder / "encore-bars.csv").string();
}

/// Where the bars are to be saved. The name is the user's, so nothing is overwritten unasked.
void draw_save(const std::string& csv, UiState& state, Commands& commands) {
  if (!ImGui::BeginPopup("save csv")) return;
  std::string& file = state.plots.csv_file;
  if (ImGui::IsWindowAppearing()) {
    if (file.empty()) file = first_csv_file(state);
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(26.0F * ImGui::GetFontSize());
  bool save = ImGui::InputText("##file", &file, ImGuiInputTextFlags_EnterReturnsTrue);
  note_widget("bars.csv_file", file);
  tooltip("The file to write, with its folder. A file of that name is replaced.");
  ImGui::SameLine();
  ImGui::BeginDisabled(file.empty());
  save = ImGui::Button("Save") || save;
  ImGui::EndDisabled();
  note_widget("bars.csv_save", file.empty() ? "disabled" : "");
  tooltip("Writes the bars as CSV: s and J, with their intervals and provenance.");
  if (save && !file.empty()) {
    commands.push_back(SaveText{typed_path(file, home_folder()), csv});
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

/// What the title row switches: the scale, and where there is room for one only, chart or table.
void draw_switches(bool choose, UiState& state) {
  std::vector<PlotTool> tools{{.name = "normalised",
                               .label = "%",
                               .help = "Bars in % of the largest one of their unit, instead of "
                                       "joules and seconds as they are.",
                               .on = state.bars_normalised}};
  bool& table = state.plots.comparison_table;
  if (choose) {
    tools.push_back({.name = "table",
                     .label = "Table",
                     .help = "The figures with their intervals, instead of the chart.",
                     .on = table});
  }
  ImGui::SameLine();
  const auto pressed = draw_tools("bars", tools);
  if (pressed == std::size_t{0}) state.bars_normalised = !state.bars_normalised;
  if (pressed == std::size_t{1}) table = !table;
}

/// Whether chart and table of a comparison have room beside or above each other.
bool room_for_both(const Rect& area) {
  const float em = ImGui::GetFontSize();
  return area.width > 50.0F * em || area.height > 26.0F * em;
}

/// Chart and table of a comparison, or one of them.
void draw_comparison(const BarData& data, const View& view, bool both, UiState& state) {
  const float em = ImGui::GetFontSize();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const auto table = [&] {
    draw_changes("bars.changes", view.session.changes, state.preferences.theme, 0.0F);
  };
  if (!both && state.plots.comparison_table) {
    table();
    return;
  }
  const bool beside = both && room.x > 50.0F * em;
  ImVec2 chart = room;
  if (beside) chart.x = 0.45F * room.x;
  if (both && !beside) {
    const float rows = static_cast<float>(view.session.changes.size()) * 3.0F + 2.0F;
    chart.y -= std::min(0.45F * room.y, rows * ImGui::GetTextLineHeightWithSpacing()) + 0.4F * em;
  }
  BarState& bars = state.plots.comparison;
  bars.mode = state.bars_normalised ? BarMode::percent_of_largest : BarMode::absolute;
  bars.show_differences = !both;  // else the table has them with their intervals
  stacked_bars("bars.chart", data, bars, {std::max(1.0F, chart.x), std::max(1.0F, chart.y)});
  if (!both) return;
  if (beside) ImGui::SameLine();
  table();
}

}  // namespace

void draw_bars_plot(const Rect& area, const View& view, UiState& state, Commands& commands) {
  if (begin_part("##bars plot", area)) {
    const ShownPlots shown = shown_plots(view, state);
    const bool compare = comparing(view, state);
    const BarData data =
        compare ? comparison_bars(view.session) : configuration_bars(shown.data.configurations);
    plot_title("bars", compare ? "A beside B" : "Costs", compare ? kCompareHelp : kHelp);
    const bool both = compare && room_for_both(area);
    draw_switches(compare && !both, state);
    const bool any = !data.groups.empty();
    const std::array<PlotTool, 3> tools{
        {{.name = "copy_csv",
          .label = "Copy",
          .help = "Copies the bars as CSV: s and J with their intervals and provenance.",
          .enabled = any},
         {.name = "save_csv",
          .label = "CSV",
          .help = "Asks for a file and writes the bars to it as CSV.",
          .enabled = any},
         {.name = "save_png",
          .label = "PNG",
          .help = "Saves a picture of the three plots; a notice names the file."}}};
    const auto pressed = draw_end_tools("bars", tools);
    const auto csv = [&] { return compare ? changes_csv(view.session.changes) : bars_csv(data); };
    if (pressed == std::size_t{0}) commands.push_back(CopyText{csv(), "bars copied as CSV"});
    if (pressed == std::size_t{1}) ImGui::OpenPopup("save csv");
    if (pressed == std::size_t{2}) commands.push_back(SavePicture{PictureOf::plots, {}});
    if (ImGui::IsPopupOpen("save csv")) draw_save(csv(), state, commands);

    const std::string problem = no_energy(data, shown.data);
    // In a low plot the bars alone say it.
    if (!problem.empty() && ImGui::GetContentRegionAvail().y > 12.0F * ImGui::GetFontSize()) {
      ImGui::TextDisabled("%s", fitted(problem, ImGui::GetContentRegionAvail().x).c_str());
      note_widget("bars.no_energy", problem);
      tooltip(problem);
    }
    if (compare) {
      draw_comparison(data, view, both, state);
    } else {
      BarState& bars = shown.charts.bars;
      bars.mode = state.bars_normalised ? BarMode::percent_of_largest : BarMode::absolute;
      stacked_bars("bars.chart", data, bars, {0.0F, 0.0F},
                   shown.session ? "the session has no configurations"
                                 : "nothing measured yet: start measure mode");
    }
  }
  ImGui::End();
}

}  // namespace encore::ui
