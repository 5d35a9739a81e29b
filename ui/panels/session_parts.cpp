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
  tooltip(
      "B against A in %, with its 95 % interval; lower and higher are said only where the whole "
      "interval lies on one side of 0.");
}

void draw_change(const char* name, std::size_t row, const ChangeView& change,
                 const ThemeColors& colors) {
  text_cell(change.label);
  if (widget_map_enabled()) {
    note_widget(
        fmt::format("{}.row.{}", name, row),
        fmt::format("{}; {}; {}", change.label, change.time_verdict, change.joules_verdict));
  }
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

}  // namespace

void draw_changes(const char* name, const std::vector<ChangeView>& changes, Theme theme,
                  float height) {
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
  const ThemeColors& colors = theme_colors(theme);
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
