#include "ui/panels/shell_parts.h"
#include "ui/plot/plot_colors.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

/// Share of the column that labels take.
constexpr float kLabelShare = 0.42F;

const ThemeColors& colors_now() {
  return theme_colors(dark_style() ? Theme::dark : Theme::light);
}

/// Where the column ends, in the window.
float right_end() {
  return ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
}

float button_width(const char* label) {
  return ImGui::CalcTextSize(label, nullptr, true).x + 2.0F * ImGui::GetStyle().FramePadding.x;
}

/// The label; where the control begins, in the window.
float place_label(const Row& row) {
  const float begin = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMin().x;
  const float control = std::round(begin + (right_end() - begin) * kLabelShare);
  const float room = control - ImGui::GetCursorScreenPos().x - ImGui::GetStyle().ItemInnerSpacing.x;
  colored_text(colors_now().dim_text, fitted(row.label, std::max(room, ImGui::GetFontSize())));
  tooltip(row.tip);
  ImGui::SameLine();
  ImGui::SetCursorScreenPos({control, ImGui::GetCursorScreenPos().y});
  return control;
}

void wrapped(const ImVec4& color, const std::string& text) {
  if (text.empty()) return;
  ImGui::PushTextWrapPos(0.0F);
  colored_text(color, text);
  ImGui::PopTextWrapPos();
}

}  // namespace

bool section(const std::string& name, const std::string& title, const char* tip,
             bool open_at_first) {
  ImGui::Dummy({0.0F, std::round(ImGui::GetFontSize() * 0.1F)});
  const bool open = ImGui::CollapsingHeader((title + "###" + name).c_str(),
                                            open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  note_widget(name, open ? "open" : "closed");
  tooltip(tip);
  return open;
}

bool begin_group(const std::string& name, const std::string& title, const char* tip,
                 bool open_at_first) {
  ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanAvailWidth;
  if (open_at_first) flags |= ImGuiTreeNodeFlags_DefaultOpen;
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0.0F, 0.0F, 0.0F, 0.0F));
  const bool open = ImGui::TreeNodeEx((title + "###" + name).c_str(), flags);
  ImGui::PopStyleColor();
  note_widget(name, open ? "open" : "closed");
  tooltip(tip);
  return open;
}

void begin_row(const Row& row, float kept_right) {
  ImGui::AlignTextToFramePadding();
  const float control = place_label(row);
  ImGui::SetNextItemWidth(
      std::max(right_end() - control - kept_right, ImGui::GetFontSize() * 3.0F));
}

void end_row(const Row& row, std::string_view state) {
  note_widget(row.name, state);
  if (!ImGui::IsItemActive()) tooltip(row.tip);
}

void figure_row(const Row& row, const std::string& text) {
  const std::string shown = fitted(text, right_end() - place_label(row));
  ImGui::TextUnformatted(shown.c_str());
  note_widget(row.name, text);
  tooltip(shown == text ? row.tip : fmt::format("{}\n{}", text, row.tip));
}

bool toggle_row(const Row& row, bool& value) {
  const bool changed = ImGui::Checkbox(fmt::format("{}###{}", row.label, row.name).c_str(), &value);
  end_row(row, value ? "on" : "off");
  return changed;
}

bool text_button(const Row& row, bool enabled) {
  // In a very narrow column words are cut; the tooltip has them all.
  const float room = ImGui::GetContentRegionAvail().x - 2.0F * ImGui::GetStyle().FramePadding.x;
  const std::string label = fitted(row.label, std::max(room, ImGui::GetFontSize()));
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(fmt::format("{}###{}", label, row.name).c_str());
  end_row(row, enabled ? "" : "disabled");
  ImGui::EndDisabled();
  return pressed;
}

bool text_button_beside(const Row& row, bool enabled) {
  const float room = right_end() - ImGui::GetItemRectMax().x - ImGui::GetStyle().ItemSpacing.x;
  if (room >= button_width(row.label)) ImGui::SameLine();
  return text_button(row, enabled);
}

bool progress_row(const std::string& name, const WorkView& work) {
  std::string text = work.doing.empty() ? "working" : work.doing;
  if (work.progress) text += fmt::format(", {:.0f} %", *work.progress * 100.0);
  const std::string shown = fitted(text, right_end() - ImGui::GetCursorScreenPos().x);
  ImGui::TextUnformatted(shown.c_str());
  note_widget(name, text);
  tooltip(fmt::format("{}; so far {}", text, duration_text(std::floor(work.elapsed_s))));
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float kept = work.cancellable ? button_width("Cancel") + spacing : 0.0F;
  const float width = right_end() - ImGui::GetCursorScreenPos().x - kept;
  progress_bar(std::max(width, spacing), work.progress ? &*work.progress : nullptr);
  if (!work.cancellable) return false;
  ImGui::SameLine();
  return text_button({.name = name + ".cancel",
                      .label = "Cancel",
                      .tip = "Ends this work; what was there before stays. Escape does the same."});
}

void problem_line(const std::string& text) {
  wrapped(colors_now().problem, text);
}

void hint_line(const std::string& text) {
  wrapped(colors_now().dim_text, text);
}

}  // namespace encore::ui
