#include "ui/panels/accuracy_parts.h"
#include "ui/plot/value_text.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace encore::ui {

namespace {

/// A column's head, and what it holds.
struct Head {
  AccuracyColumn column;
  const char* name;  ///< in the widget map
  const char* label;
  const char* tip;
  float ems;
};

constexpr std::array<Head, 12> kHeads{{
    {AccuracyColumn::device, "device", "device", "Where the rays were traced.", 3.5F},
    {AccuracyColumn::structure, "structure", "structure", "By which structure.", 6.2F},
    {AccuracyColumn::mode, "mode", "mode", "By which intersection arithmetic.", 8.0F},
    {AccuracyColumn::samples, "samples", "samples", "Camera rays a pixel.", 4.6F},
    {AccuracyColumn::rmse, "rmse", "RMSE",
     "Root mean square over the picture's channels (linear RGB) against the reference, in % of "
     "white.",
     5.0F},
    {AccuracyColumn::missed, "missed", "missed",
     "Rays through pixels' centres that should hit and do not.", 4.0F},
    {AccuracyColumn::invented, "invented", "invented",
     "Rays through pixels' centres that hit and should not.", 4.6F},
    {AccuracyColumn::wrong, "wrong", "wrong", "Rays that hit another triangle than they should.",
     4.0F},
    {AccuracyColumn::largest_t, "largest_t", "t error",
     "Largest relative error of a hit's distance where the triangle is right.", 4.5F},
    {AccuracyColumn::time, "time", "time", "A frame; the median of all that were timed.", 4.8F},
    {AccuracyColumn::energy, "energy", "energy", "A frame, of the whole machine.", 4.8F},
    {AccuracyColumn::pareto, "pareto", "Pareto",
     "Nothing else costs no more and errs no more: in time, or in energy.", 6.5F},
}};

double number_of(const AccuracyResult& one, AccuracyColumn column) {
  switch (column) {
    case AccuracyColumn::device:
      return double(one.device);
    case AccuracyColumn::structure:
      return double(one.structure);
    case AccuracyColumn::mode:
      return double(one.intersection);
    case AccuracyColumn::samples:
      return one.samples;
    case AccuracyColumn::rmse:
      return one.rmse;
    case AccuracyColumn::missed:
      return double(one.missed);
    case AccuracyColumn::invented:
      return double(one.invented);
    case AccuracyColumn::wrong:
      return double(one.wrong_triangle);
    case AccuracyColumn::pareto:
      return (one.best_by_time ? 2.0 : 0.0) + (one.best_by_energy ? 1.0 : 0.0);
    default:
      return 0.0;
  }
}

std::optional<double> key_of(const AccuracyResult& one, AccuracyColumn column) {
  if (column == AccuracyColumn::largest_t) return one.largest_t;
  if (column == AccuracyColumn::time) return one.seconds;
  if (column == AccuracyColumn::energy) return one.joules;
  return number_of(one, column);
}

std::string percent(double rmse) {
  return value_text(100.0 * rmse, "%", 3);
}

std::string pareto_text(const AccuracyResult& one) {
  std::string text = one.best_by_time ? "time" : "";
  if (one.best_by_energy) text += text.empty() ? "energy" : ", energy";
  return text;
}

std::string cell_text(const AccuracyResult& one, AccuracyColumn column) {
  switch (column) {
    case AccuracyColumn::device:
      return std::string(to_string(one.device));
    case AccuracyColumn::structure:
      return std::string(accel::to_string(one.structure));
    case AccuracyColumn::mode:
      return std::string(accel::to_string(one.intersection));
    case AccuracyColumn::samples:
      return std::to_string(one.samples);
    case AccuracyColumn::rmse:
      return percent(one.rmse);
    case AccuracyColumn::missed:
      return count_text(one.missed);
    case AccuracyColumn::invented:
      return count_text(one.invented);
    case AccuracyColumn::wrong:
      return count_text(one.wrong_triangle);
    case AccuracyColumn::largest_t:
      if (!one.largest_t) return "";
      return *one.largest_t > 0.0 ? fmt::format("{:.1e}", *one.largest_t) : "0";
    case AccuracyColumn::time:
      return one.seconds ? value_text(*one.seconds, "s", 3) : "";
    case AccuracyColumn::energy:
      return one.joules ? value_text(*one.joules, "J", 3) : "";
    case AccuracyColumn::pareto:
      return pareto_text(one);
  }
  return {};
}

bool is_word(AccuracyColumn column) {
  return column <= AccuracyColumn::mode || column == AccuracyColumn::pareto;
}

void draw_heads(const std::vector<const Head*>& heads) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (std::size_t i = 0; i < heads.size(); ++i) {
    ImGui::TableSetColumnIndex(static_cast<int>(i));
    ImGui::TableHeader(heads[i]->label);
    if (widget_map_enabled()) note_widget(fmt::format("accuracy.sort.{}", heads[i]->name));
    tooltip(heads[i]->tip);
  }
}

void draw_result(const AccuracyResult& one, const std::vector<const Head*>& heads) {
  ImGui::TableNextRow();
  for (const Head* head : heads) {
    ImGui::TableNextColumn();
    const std::string text = cell_text(one, head->column);
    if (!is_word(head->column)) {
      const float left = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
      ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, left));
    }
    ImGui::TextUnformatted(text.c_str());
  }
}

/// Ring for the graphics device, disc for the CPU.
ScatterSeries& series_of(ScatterData& data, const AccuracyResult& one) {
  const std::string name =
      fmt::format("{}, {}", to_string(one.device), accel::to_string(one.intersection));
  const auto found = std::find_if(data.series.begin(), data.series.end(),
                                  [&](const ScatterSeries& s) { return s.name == name; });
  if (found != data.series.end()) return *found;
  const bool gpu = one.device == PaneDevice::gpu;
  ScatterSeries series;
  series.name = name;
  series.mark = gpu ? ScatterSeries::Mark::ring : ScatterSeries::Mark::disc;
  // A configuration keeps its colour whatever else is shown.
  series.color = series_color(static_cast<std::size_t>(one.intersection) + (gpu ? 3 : 0));
  data.series.push_back(std::move(series));
  return data.series.back();
}

std::string label_of(const AccuracyView& view, const AccuracyResult& one) {
  std::string label =
      fmt::format("{}\nRMSE {} of white\n{} of the centres' rays wrong", result_name(one),
                  percent(one.rmse), count_text(one.missed + one.invented + one.wrong_triangle));
  if (one.seconds) label += "\n" + value_text(*one.seconds, "s", 3) + " a frame";
  if (one.joules) {
    label += fmt::format("\n{} a frame, {}", value_text(*one.joules, "J", 3),
                         energy::to_string(view.energy.origin));
  }
  return label;
}

}  // namespace

std::string result_name(const AccuracyResult& result) {
  return fmt::format("{}, {}, {}, {} sample{}", accel::to_string(result.structure),
                     to_string(result.device), accel::to_string(result.intersection),
                     result.samples, result.samples == 1 ? "" : "s");
}

bool knows_joules(const AccuracyView& view) {
  return std::any_of(view.results.begin(), view.results.end(),
                     [](const AccuracyResult& one) { return one.joules.has_value(); });
}

std::vector<std::size_t> sorted_results(const std::vector<AccuracyResult>& results,
                                        AccuracyColumn column, bool descending) {
  std::vector<std::size_t> order(results.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto left = key_of(results[a], column);
    const auto right = key_of(results[b], column);
    if (!left || !right) return left.has_value() && !right;
    return descending ? *left > *right : *left < *right;
  });
  return order;
}

ScatterData accuracy_scatter(const AccuracyView& view, bool by_joules) {
  ScatterData data;
  data.x_unit = by_joules ? "J" : "s";
  data.x_origin = by_joules ? view.energy : energy::Provenance{energy::Origin::measured, "clock"};
  if (view.reference_error && *view.reference_error > 0.0) {
    data.floor = 100.0 * *view.reference_error;
    data.floor_label = fmt::format("the reference's own error, {}", percent(*view.reference_error));
  }
  for (const AccuracyResult& one : view.results) {
    const auto& cost = by_joules ? one.joules : one.seconds;
    ScatterSeries& series = series_of(data, one);
    if (!cost) continue;
    series.points.push_back({*cost, 100.0 * one.rmse, label_of(view, one),
                             by_joules ? one.best_by_energy : one.best_by_time});
  }
  return data;
}

void draw_accuracy_table(const AccuracyView& view, float height) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                     ImGuiTableFlags_Sortable | ImGuiTableFlags_Resizable |
                                     ImGuiTableFlags_SizingFixedFit;
  std::vector<const Head*> heads;
  const bool joules = knows_joules(view);
  for (const Head& head : kHeads) {
    if (head.column != AccuracyColumn::energy || joules) heads.push_back(&head);
  }
  // Another number of columns is another table to Dear ImGui.
  const char* name = joules ? "accuracy with joules" : "accuracy";
  if (!ImGui::BeginTable(name, static_cast<int>(heads.size()), kFlags, {0.0F, height})) return;
  for (const Head* head : heads) {
    const bool first = head->column == AccuracyColumn::rmse;
    ImGui::TableSetupColumn(head->label, first ? ImGuiTableColumnFlags_DefaultSort : 0,
                            head->ems * ImGui::GetFontSize(), static_cast<ImGuiID>(head->column));
  }
  ImGui::TableSetupScrollFreeze(0, 1);
  draw_heads(heads);
  AccuracyColumn column = AccuracyColumn::rmse;
  bool descending = false;
  if (const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
      specs != nullptr && specs->SpecsCount > 0) {
    column = static_cast<AccuracyColumn>(specs->Specs[0].ColumnUserID);
    descending = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
  }
  std::size_t row = 0;
  for (const std::size_t place : sorted_results(view.results, column, descending)) {
    draw_result(view.results[place], heads);
    if (widget_map_enabled()) {
      note_widget(fmt::format("accuracy.row.{}", row), result_name(view.results[place]));
    }
    ++row;
  }
  ImGui::EndTable();
}

}  // namespace encore::ui
