#include "ui/panels/session_parts.h"

#include "ui/panels/change_text.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>

#include <filesystem>

namespace encore::ui {

namespace {

constexpr const char* kVerdictHelp =
    "B against A in %, with its 95 % interval; lower and higher are said only where the whole "
    "interval lies on one side of 0.";

const ImVec4& verdict_color(const std::string& verdict, const ThemeColors& colors) {
  if (verdict == "lower") return colors.good;
  if (verdict == "higher") return colors.problem;
  return colors.dim_text;
}

void text_cell(const std::string& text) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(text.c_str());
}

void verdict_cell(const std::string& change, const std::string& verdict,
                  const ThemeColors& colors) {
  ImGui::TableNextColumn();
  const bool known = !verdict.empty();
  const std::string text = known ? fmt::format("{}, {}", change, verdict_text(verdict)) : change;
  colored_text(verdict_color(verdict, colors), text);
  tooltip(kVerdictHelp);
}

void note_row(const char* name, std::size_t row, const ChangeView& change) {
  if (!widget_map_enabled()) return;
  note_widget(fmt::format("{}.row.{}", name, row),
              fmt::format("{}; {}; {}", change.label, change.time_verdict, change.joules_verdict));
}

void draw_change(const char* name, std::size_t row, const ChangeView& change,
                 const ThemeColors& colors) {
  text_cell(change.label);
  note_row(name, row, change);
  tooltip(change.label);
  text_cell(value_text(change.a_s, "s"));
  text_cell(value_text(change.b_s, "s"));
  verdict_cell(change_text(change.time_percent, change.time_low, change.time_high),
               change.time_verdict, colors);
  text_cell(value_text(change.a_joules, "J"));
  text_cell(value_text(change.b_joules, "J"));
  verdict_cell(change_text(change.joules_percent, change.joules_low, change.joules_high),
               change.joules_percent ? change.joules_verdict : "", colors);
}

/// "90.0 ms → 81.0 ms", the change, the verdict: a line each, broken where they must be.
void change_cell(const std::string& a, const std::string& b, const std::string& change,
                 const std::string& verdict, const ThemeColors& colors) {
  ImGui::TableNextColumn();
  wrapped_text(fmt::format("{} → {}", a, b));
  tooltip("Session A → session B.");
  wrapped_text(verdict_color(verdict, colors), change);
  tooltip(kVerdictHelp);
  if (verdict.empty()) return;
  wrapped_text(verdict_color(verdict, colors), verdict_text(verdict));
  tooltip(kVerdictHelp);
}

/// Three columns that break their lines, where seven have no room.
void draw_narrow(const char* name, const std::vector<ChangeView>& changes,
                 const ThemeColors& colors, float height) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                     ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_Resizable |
                                     ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable(name, 3, kFlags, {0.0F, height})) return;
  ImGui::TableSetupColumn("configuration", 0, 1.0F);
  ImGui::TableSetupColumn("time", 0, 1.4F);
  ImGui::TableSetupColumn("energy", 0, 1.4F);
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableHeadersRow();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const ChangeView& change = changes[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    wrapped_text(change.label);
    note_row(name, i, change);
    tooltip(change.label);
    change_cell(value_text(change.a_s, "s"), value_text(change.b_s, "s"),
                change_text(change.time_percent, change.time_low, change.time_high),
                change.time_verdict, colors);
    change_cell(value_text(change.a_joules, "J"), value_text(change.b_joules, "J"),
                change_text(change.joules_percent, change.joules_low, change.joules_high),
                change.joules_percent ? change.joules_verdict : "", colors);
  }
  ImGui::EndTable();
}

}  // namespace

void draw_changes(const char* name, const std::vector<ChangeView>& changes, Theme theme,
                  float height) {
  const ThemeColors& colors = theme_colors(theme);
  if (ImGui::GetContentRegionAvail().x < 60.0F * ImGui::GetFontSize()) {
    draw_narrow(name, changes, colors, height);
    return;
  }
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                     ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_Resizable;
  if (!ImGui::BeginTable(name, 7, kFlags, {0.0F, height})) return;
  for (const char* column : {"configuration", "time A", "time B", "time, B against A", "energy A",
                             "energy B", "energy, B against A"}) {
    ImGui::TableSetupColumn(column);
  }
  ImGui::TableSetupScrollFreeze(1, 1);
  ImGui::TableHeadersRow();
  for (std::size_t i = 0; i < changes.size(); ++i) {
    ImGui::TableNextRow();
    draw_change(name, i, changes[i], colors);
  }
  ImGui::EndTable();
}

std::string session_name(const std::string& folder) {
  std::filesystem::path path(folder);
  if (!path.has_filename()) path = path.parent_path();
  return path.filename().string();
}

void wrapped_text(const std::string& text) {
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void wrapped_text(const ImVec4& color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  wrapped_text(text);
  ImGui::PopStyleColor();
}

}  // namespace encore::ui
