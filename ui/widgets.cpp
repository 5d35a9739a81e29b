#include "ui/widgets.h"

#include "ui/plot/plot_colors.h"
#include "ui/plot/value_text.h"
#include "ui/style.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>

namespace encore::ui {

namespace {

ImVec2 word_size(std::string_view word) {
  return ImGui::CalcTextSize(word.data(), word.data() + word.size());
}

/// Whether the mouse has been over the last item for a moment. An item is known by its place: its
/// text may change from frame to frame.
bool hovered_long_enough() {
  constexpr float kDelay_s = 0.35F;
  const ImVec2 at = ImGui::GetItemRectMin();
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID item =
      ImGui::GetID(fmt::format("hovered {:.0f} {:.0f}", double(at.x), double(at.y)).c_str());
  const ImGuiID frame = item + 1;
  const ImGuiID waited = item + 2;
  const int now = ImGui::GetFrameCount();
  // Two calls for one item in a frame do not count twice.
  const int last = storage.GetInt(frame, -9);
  float so_far = last >= now - 1 ? storage.GetFloat(waited, 0.0F) : 0.0F;
  if (last == now - 1) so_far += ImGui::GetIO().DeltaTime;
  storage.SetInt(frame, now);
  storage.SetFloat(waited, so_far);
  return so_far >= kDelay_s;
}

}  // namespace

void tooltip(const char* text) {
  if (text == nullptr || *text == '\0') return;
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || !hovered_long_enough()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0F);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void tooltip(const std::string& text) {
  tooltip(text.c_str());
}

float badge_width(const energy::Provenance& provenance) {
  return word_size(energy::to_string(provenance.origin)).x + ImGui::GetFontSize() * 1.4F;
}

void badge(const energy::Provenance& provenance) {
  const std::string_view word = energy::to_string(provenance.origin);
  const ImVec4 color = origin_color(dark_style() ? Theme::dark : Theme::light, provenance.origin);
  const float em = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = em + ImGui::GetStyle().FramePadding.y;
  const ImVec2 end{at.x + badge_width(provenance), at.y + height};
  ImGui::Dummy({end.x - at.x, height});
  ImVec4 ground = color;
  ground.w = 0.18F;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, end, ImGui::GetColorU32(ground), em * 0.27F);
  list.AddCircleFilled({at.x + em * 0.5F, (at.y + end.y) * 0.5F}, em * 0.2F,
                       ImGui::GetColorU32(color));
  list.AddText({at.x + em * 0.95F, at.y + (height - em) * 0.5F}, ImGui::GetColorU32(color),
               word.data(), word.data() + word.size());
  const std::string_view detail = provenance.detail;
  tooltip(detail.empty() ? std::string(word) : fmt::format("{}: {}", word, detail));
}

std::string figure_text(const EnergyFigure& figure, const char* unit) {
  if (!figure.value) return "unavailable";
  return value_text(*figure.value, figure.half_width, unit);
}

std::string count_text(std::uint64_t count) {
  std::string text = fmt::format("{}", count);
  for (std::size_t place = text.size(); place > 3;) {
    place -= 3;
    text.insert(place, ",");
  }
  return text;
}

std::string bytes_text(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> kUnits{"KiB", "MiB", "GiB", "TiB"};
  if (bytes < 1024) return fmt::format("{} bytes", bytes);
  double value = static_cast<double>(bytes) / 1024.0;
  std::size_t unit = 0;
  while (value >= 1023.95 && unit + 1 < kUnits.size()) {
    value /= 1024.0;
    ++unit;
  }
  return fmt::format("{:.{}f} {}", value, value < 10.0 ? 2 : 1, kUnits.at(unit));
}

std::string size_text(int width, int height) {
  return fmt::format("{} × {}", width, height);
}

}  // namespace encore::ui
