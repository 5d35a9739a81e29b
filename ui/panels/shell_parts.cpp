#include "ui/panels/shell_parts.h"

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

ImVec2 text_size(std::string_view text) {
  return ImGui::CalcTextSize(text.data(), text.data() + text.size());
}

/// Where a UTF-8 character begins at or before `place`.
std::size_t character_start(std::string_view text, std::size_t place) {
  while (place > 0 && (static_cast<unsigned char>(text[place]) & 0xC0U) == 0x80U) --place;
  return place;
}

}  // namespace

bool begin_part(const char* id, const Rect& area, ImGuiWindowFlags more) {
  ImGui::SetNextWindowPos({area.x, area.y});
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0F, 1.0F));
  const bool shown = ImGui::Begin(id, nullptr,
                                  ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_NoBringToFrontOnFocus | more);
  ImGui::PopStyleVar(3);
  return shown;
}

void hint(std::string_view text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0F);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool begin_dialog(const char* title, float width, float height, bool& open, ImGuiWindowFlags more) {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  const ImVec2 size{std::min(width * em, room.x - em), std::min(height * em, room.y - em)};
  ImGui::SetNextWindowSize(size, ImGuiCond_Appearing);
  ImGui::SetNextWindowPos({room.x * 0.5F, room.y * 0.5F}, ImGuiCond_Appearing, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({std::min(12.0F * em, size.x), std::min(6.0F * em, size.y)},
                                      room);
  return ImGui::Begin(title, &open,
                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | more);
}

void progress_bar(float width, const double* share) {
  const float height = std::round(ImGui::GetFontSize() * 0.4F);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = at.y + std::round((ImGui::GetFrameHeight() - height) * 0.5F);
  ImGui::Dummy({width, ImGui::GetFrameHeight()});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float rounding = height * 0.5F;
  list.AddRectFilled({at.x, top}, {at.x + width, top + height},
                     ImGui::GetColorU32(ImGuiCol_FrameBgActive), rounding);
  float from = 0.0F;
  float to = share != nullptr ? std::clamp(static_cast<float>(*share), 0.0F, 1.0F) : 0.0F;
  if (share == nullptr) {
    const auto phase = static_cast<float>(std::fmod(ImGui::GetTime(), 2.0));
    from = 0.7F * (phase < 1.0F ? phase : 2.0F - phase);
    to = from + 0.3F;
  }
  if (to <= from) return;
  list.AddRectFilled({at.x + from * width, top}, {at.x + to * width, top + height},
                     ImGui::GetColorU32(ImGuiCol_SliderGrabActive), rounding);
}

bool badge(const char* id, std::string_view text, const ImVec4& color) {
  const float em = ImGui::GetFontSize();
  const float dot = std::round(em * 0.22F);
  const ImVec2 words = text_size(text);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  const float width = words.x + em * 1.5F;
  const bool pressed = ImGui::InvisibleButton(id, {width, height});
  ImVec4 ground = color;
  ground.w = ImGui::IsItemHovered() ? 0.32F : 0.18F;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float inset = std::round(em * 0.1F);
  list.AddRectFilled({at.x, at.y + inset}, {at.x + width, at.y + height - inset},
                     ImGui::GetColorU32(ground), em * 0.27F);
  list.AddCircleFilled({at.x + em * 0.6F, at.y + height * 0.5F}, dot, ImGui::GetColorU32(color));
  list.AddText({at.x + em * 1.05F, at.y + (height - words.y) * 0.5F}, ImGui::GetColorU32(color),
               text.data(), text.data() + text.size());
  return pressed;
}

void colored_text(const ImVec4& color, std::string_view text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
}

std::string fitted(std::string_view text, float width) {
  if (text_size(text).x <= width) return std::string(text);
  const std::string_view dots = "…";
  const float room = width - text_size(dots).x;
  std::size_t low = 0;
  std::size_t high = text.size();
  while (low < high) {
    const std::size_t middle = (low + high + 1) / 2;
    if (text_size(text.substr(0, middle)).x <= room) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return std::string(text.substr(0, low == text.size() ? low : character_start(text, low))) +
         std::string(dots);
}

}  // namespace encore::ui
