#include "ui/panels/manual_view.h"

#include "ui/manual_text.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <string_view>

namespace encore::ui {

namespace {

/// Sets words one after the other and breaks lines between them, with code on a ground of its own.
class WordSetter {
 public:
  WordSetter(float left, float width) : left_(left), width_(width), x_(0.0F) {}

  void set(const ManualLine& line) {
    for (const ManualSpan& span : line) {
      if (span.code) ImGui::PushFont(mono_font());
      std::string_view rest = span.text;
      while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        word(rest.substr(0, end), span.code);
        const bool space = end < rest.size();
        if (space) x_ += ImGui::CalcTextSize(" ").x;
        rest.remove_prefix(std::min(end + 1, rest.size()));
      }
      if (span.code) ImGui::PopFont();
    }
  }

 private:
  void word(std::string_view text, bool code) {
    if (text.empty()) return;
    const float wide = ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
    if (!first_ && x_ + wide > width_) {
      x_ = 0.0F;
      first_ = true;
      line_y_ += ImGui::GetTextLineHeightWithSpacing();
    }
    ImGui::SetCursorPos({left_ + x_, start_y_ + line_y_});
    if (code) {
      const ImVec2 at = ImGui::GetCursorScreenPos();
      ImGui::GetWindowDrawList()->AddRectFilled(
          {at.x - 2.0F, at.y}, {at.x + wide + 2.0F, at.y + ImGui::GetTextLineHeight() + 1.0F},
          ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0F);
    }
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    x_ += wide;
    first_ = false;
  }

  float left_;
  float width_;
  float x_;
  float start_y_ = ImGui::GetCursorPosY();
  float line_y_ = 0.0F;
  bool first_ = true;
};

void draw_line(const ManualLine& line, float indent) {
  const float left = ImGui::GetCursorPosX() + indent;
  WordSetter setter(left, ImGui::GetContentRegionAvail().x - indent);
  setter.set(line);
}

void draw_table(const ManualBlock& block, std::size_t place) {
  if (block.rows.empty() || block.rows.front().empty()) return;
  const auto columns = static_cast<int>(block.rows.front().size());
  const std::string id = fmt::format("table {}", place);
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_BordersOuter |
                                     ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable(id.c_str(), columns, kFlags)) return;
  // The last column has the sentences.
  for (int c = 0; c < columns; ++c) {
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, c + 1 == columns ? 2.0F : 1.0F);
  }
  for (std::size_t r = 0; r < block.rows.size(); ++r) {
    ImGui::TableNextRow(r == 0 ? ImGuiTableRowFlags_Headers : 0);
    for (const ManualLine& cell : block.rows[r]) {
      ImGui::TableNextColumn();
      draw_line(cell, 0.0F);
    }
  }
  ImGui::EndTable();
}

void draw_heading(const ManualBlock& block, const ThemeColors& colors) {
  ImGui::Dummy({0.0F, ImGui::GetFontSize() * (block.level == 3 ? 0.2F : 0.6F)});
  if (block.level < 3) ImGui::PushFont(heading_font());
  const std::string text = plain_text(block.line);
  ImGui::PushTextWrapPos(0.0F);
  colored_text(block.level == 1 ? colors.text : colors.accent, text);
  ImGui::PopTextWrapPos();
  if (block.level < 3) ImGui::PopFont();
}

void draw_block(const ManualBlock& block, std::size_t place, const ThemeColors& colors) {
  const float em = ImGui::GetFontSize();
  switch (block.kind) {
    case ManualBlock::Kind::heading:
      draw_heading(block, colors);
      break;
    case ManualBlock::Kind::paragraph:
      draw_line(block.line, 0.0F);
      ImGui::Dummy({0.0F, em * 0.25F});
      break;
    case ManualBlock::Kind::bullet: {
      const ImVec2 at = ImGui::GetCursorScreenPos();
      ImGui::GetWindowDrawList()->AddCircleFilled({at.x + em * 0.5F, at.y + em * 0.6F}, em * 0.14F,
                                                  ImGui::GetColorU32(ImGuiCol_TextDisabled));
      draw_line(block.line, em * 1.1F);
      break;
    }
    case ManualBlock::Kind::table:
      draw_table(block, place);
      ImGui::Dummy({0.0F, em * 0.25F});
      break;
  }
}

void show_match(ManualState& manual, std::size_t at) {
  if (manual.found.empty()) return;
  manual.at = at % manual.found.size();
  manual.scroll_to = manual.found[manual.at];
}

void draw_search(ManualState& manual) {
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14.0F);
  if (ImGui::InputTextWithHint("##words", "search", &manual.words)) {
    manual.found = search_manual(manual.manual, manual.words);
    show_match(manual, 0);
  }
  note_widget("manual.search", fmt::format("{}", manual.found.size()));
  hint("Words to look for, capitals or not.");
  if (manual.words.empty()) return;
  ImGui::SameLine();
  if (ImGui::Button("Next")) show_match(manual, manual.at + 1);
  note_widget("manual.next");
  hint("The next place with these words.");
  ImGui::SameLine();
  if (manual.found.empty()) {
    ImGui::TextDisabled("not in the manual");
  } else {
    ImGui::TextDisabled("%zu of %zu", manual.at + 1, manual.found.size());
  }
}

void draw_chapters(ManualState& manual) {
  for (const std::size_t place : manual.manual.chapters) {
    const ManualBlock& block = manual.manual.blocks[place];
    const std::string title = plain_text(block.line);
    const float indent = block.level == 3 ? ImGui::GetFontSize() : 0.0F;
    if (indent > 0.0F) ImGui::Indent(indent);
    if (ImGui::Selectable(fmt::format("{}##{}", title, place).c_str())) manual.scroll_to = place;
    note_widget("manual.chapter." + title);
    if (indent > 0.0F) ImGui::Unindent(indent);
  }
}

void draw_text(ManualState& manual, const ThemeColors& colors) {
  const bool searching = !manual.found.empty();
  for (std::size_t i = 0; i < manual.manual.blocks.size(); ++i) {
    if (manual.scroll_to == i) {
      ImGui::SetScrollHereY(0.0F);
      manual.scroll_to.reset();
    }
    const ImVec2 from = ImGui::GetCursorScreenPos();
    draw_block(manual.manual.blocks[i], i, colors);
    const bool match = searching && std::binary_search(manual.found.begin(), manual.found.end(), i);
    if (!match) continue;
    // A bar beside what was found, brighter where we are.
    ImVec4 color = colors.warning;
    if (manual.found[manual.at] != i) color.w = 0.4F;
    const float to = ImGui::GetCursorScreenPos().y - ImGui::GetStyle().ItemSpacing.y;
    ImGui::GetWindowDrawList()->AddRectFilled({from.x - 7.0F, from.y}, {from.x - 4.0F, to},
                                              ImGui::GetColorU32(color));
  }
}

}  // namespace

void draw_manual(UiState& state) {
  ManualState& manual = state.shell.manual;
  if (manual.manual.blocks.empty()) manual.manual = parse_manual(manual_text());
  const float em = ImGui::GetFontSize();
  draw_search(manual);
  const bool wide = ImGui::GetContentRegionAvail().x > em * 34.0F;
  if (wide) {
    ImGui::BeginChild("chapters", {em * 13.0F, 0.0F}, true);
    draw_chapters(manual);
    ImGui::EndChild();
    ImGui::SameLine();
  }
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(em, em * 0.4F));
  ImGui::BeginChild("text", {0.0F, 0.0F}, true);
  draw_text(manual, theme_colors(state.preferences.theme));
  ImGui::Dummy({0.0F, em * 4.0F});
  ImGui::EndChild();
  ImGui::PopStyleVar();
}

}  // namespace encore::ui
