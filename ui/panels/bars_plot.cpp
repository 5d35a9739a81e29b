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

void draw_scale_switch(UiState& state) {
  const std::array<PlotTool, 2> tools{{{.name = "absolute",
                                        .label = "Absolute",
                                        .help = "Joules and seconds as they are.",
                                        .on = !state.bars_normalised},
                                       {.name = "normalised",
                                        .label = "Normalised",
                                        .help = "In % of the largest bar of its unit.",
                                        .on = state.bars_normalised}}};
  ImGui::SameLine();
  if (const auto pressed = draw_tools("bars", tools)) state.bars_normalised = *pressed == 1;
}

/// Chart and table of a comparison: beside each other where that is wide enough.
void draw_comparison(const BarData& data, const View& view, UiState& state) {
  const float em = ImGui::GetFontSize();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const bool low = room.y < 16.0F * em;
  const bool beside = room.x > (low ? 28.0F : 50.0F) * em;
  if (!beside && low) {  // room for one: that with the intervals
    draw_changes("bars.changes", view.session.changes, state.preferences.theme, 0.0F);
    return;
  }
  const float rows = static_cast<float>(view.session.changes.size()) + 2.0F;
  const float table =
      std::min(0.45F * room.y, rows * ImGui::GetTextLineHeightWithSpacing() + 0.5F * em);
  const ImVec2 chart = beside ? ImVec2{0.45F * room.x, room.y}
                              : ImVec2{room.x, std::max(1.0F, room.y - table - 0.4F * em)};
  BarState& bars = state.plots.comparison;
  bars.mode = state.bars_normalised ? BarMode::percent_of_largest : BarMode::absolute;
  bars.show_differences = false;  // the table has them with their intervals
  stacked_bars("bars.chart", data, bars, chart);
  if (beside) ImGui::SameLine();
  draw_changes("bars.changes", view.session.changes, state.preferences.theme, 0.0F);
}

}  // namespace

void draw_bars_plot(const Rect& area, const View& view, UiState& state, Commands& commands) {
  if (begin_part("##bars plot", area)) {
    const ShownPlots shown = shown_plots(view, state);
    const bool compare = comparing(view, state);
    const BarData data =
        compare ? comparison_bars(view.session) : configuration_bars(shown.data.configurations);
    plot_title("bars", compare ? "A beside B" : "Costs", compare ? kCompareHelp : kHelp);
    draw_scale_switch(state);
    const bool any = !data.groups.empty();
    const std::array<PlotTool, 3> tools{
        {{.name = "copy_csv",
          .label = "Copy CSV",
          .help = "Copies the bars: s and J with their intervals and provenance.",
          .enabled = any},
         {.name = "save_csv",
          .label = "Save CSV",
          .help = "Asks for a file and writes the bars to it.",
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
      draw_comparison(data, view, state);
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
