#include "ui/panels/panels.h"
#include "ui/panels/shell_parts.h"
#include "ui/style.h"
#include "ui/widget_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace encore::ui {

namespace {

constexpr double kSeconds = 5.0;
constexpr double kProblemSeconds = 14.0;
constexpr double kFadeSeconds = 0.4;

double lasts(const Notice& notice) {
  return notice.problem ? kProblemSeconds : kSeconds;
}

/// Draws one above `bottom`; returns its top, and whether it was clicked away.
float draw_notice(const Notice& notice, std::size_t place, const Layout& layout, float bottom,
                  const ThemeColors& colors, bool& gone) {
  const float em = ImGui::GetFontSize();
  const double age = ImGui::GetTime() - notice.since_s;
  const double left = lasts(notice) - age;
  const auto alpha = static_cast<float>(std::clamp(left / kFadeSeconds, 0.05, 1.0));
  const float width = std::max(1.0F, std::min(em * 30.0F, layout.status.width - 2.0F * em));
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, alpha);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(em * 0.7F, em * 0.5F));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  ImGui::PushStyleColor(ImGuiCol_Border, notice.problem ? colors.problem : colors.accent);
  ImGui::SetNextWindowPos({layout.status.right() - em, bottom}, ImGuiCond_Always, {1.0F, 1.0F});
  const std::string id = fmt::format("##notice {}", place);
  ImGui::Begin(id.c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(width);
  if (notice.problem) {
    colored_text(colors.problem, notice.text);
  } else {
    ImGui::TextUnformatted(notice.text.c_str());
  }
  ImGui::PopTextWrapPos();
  const ImVec2 at = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  note_area("notice", at.x, at.y, size.x, size.y, notice.text);
  gone = left <= 0.0 || (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(0));
  ImGui::End();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar(2);
  return bottom - size.y - em * 0.4F;
}

}  // namespace

void draw_notices(const Layout& layout, UiState& state) {
  const ThemeColors& colors = theme_colors(state.preferences.theme);
  const float em = ImGui::GetFontSize();
  float bottom = layout.status.y - em * 0.6F;
  // The newest is the lowest.
  for (std::size_t i = state.notices.size(); i-- > 0;) {
    Notice& notice = state.notices[i];
    if (notice.since_s <= 0.0) notice.since_s = std::max(1e-6, ImGui::GetTime());
    bool gone = false;
    bottom = draw_notice(notice, i, layout, bottom, colors, gone);
    if (gone) state.notices.erase(state.notices.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace encore::ui
