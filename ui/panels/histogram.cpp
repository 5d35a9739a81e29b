#include "ui/panels/histogram.h"

#include "renderer/heatmap_palette.h"
#include "ui/plot/plot_colors.h"
#include "ui/plot/value_text.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace encore::ui {

namespace {

/// One end of the palette's range as a line to be taken hold of.
struct Handle {
  const char* id;
  const char* tip;
  double value;
};

double value_at(const HeatmapView& heatmap, const Rect& area, float x) {
  const double share = std::clamp(double(x - area.x) / double(area.width), 0.0, 1.0);
  return heatmap.bins_low + share * (heatmap.bins_high - heatmap.bins_low);
}

/// The new value while it is dragged.
std::optional<double> draw_handle(const std::string& name, const Handle& handle, const Rect& area,
                                  const HeatmapView& heatmap) {
  const double extent = heatmap.bins_high - heatmap.bins_low;
  const double share = std::clamp((handle.value - heatmap.bins_low) / extent, 0.0, 1.0);
  const float x = area.x + static_cast<float>(share) * area.width;
  const float grip = std::round(ImGui::GetFontSize() * 0.5F);
  ImGui::SetCursorScreenPos({x - grip * 0.5F, area.y});
  ImGui::InvisibleButton(handle.id, {grip, area.height});
  note_widget(name + "." + handle.id, heatmap_text(handle.value, heatmap.unit));
  const bool active = ImGui::IsItemActive();
  const bool hovered = ImGui::IsItemHovered();
  if (hovered || active) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (hovered && !active) {
    tooltip(fmt::format("{} {} Drag it.", handle.tip, heatmap_text(handle.value, heatmap.unit)));
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::uint32_t color = hovered || active ? accent_color() : text_color(0.8F);
  list.AddLine({x, area.y}, {x, area.bottom()}, color, 2.0F);
  const float foot = grip * 0.5F;
  list.AddTriangleFilled({x - foot, area.y}, {x + foot, area.y}, {x, area.y + foot}, color);
  if (!active || !ImGui::IsMouseDragging(ImGuiMouseButton_Left, 1.0F)) return std::nullopt;
  return value_at(heatmap, area, ImGui::GetIO().MousePos.x);
}

void draw_bars(const Rect& area, const HeatmapView& heatmap) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::uint64_t most = *std::max_element(heatmap.bins.begin(), heatmap.bins.end());
  const float step = area.width / static_cast<float>(heatmap.bins.size());
  for (std::size_t i = 0; i < heatmap.bins.size(); ++i) {
    if (heatmap.bins[i] == 0) continue;
    // The root lets rare values be seen beside common ones.
    const double share = std::sqrt(double(heatmap.bins[i]) / double(most));
    const float top = area.bottom() - std::max(1.0F, static_cast<float>(share) * area.height);
    const float left = area.x + static_cast<float>(i) * step;
    list.AddRectFilled({left, top}, {left + std::max(1.0F, step - 0.5F), area.bottom()},
                       text_color(0.55F));
  }
}

}  // namespace

std::string heatmap_text(double value, const std::string& unit) {
  if (unit == "J") return value_text(value, unit, 3);
  return fmt::format("{:.4g} {}", value, unit);
}

void draw_palette_bar(float width, float height, int palette) {
  const auto last = static_cast<int>(std::size(renderer::kPalettes)) - 1;
  const auto codes = renderer::palette_codes(renderer::kPalettes[std::clamp(palette, 0, last)]);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  constexpr std::size_t kParts = 32;
  for (std::size_t i = 0; i < kParts; ++i) {
    const std::uint32_t from = codes[i * 255 / kParts];
    const std::uint32_t to = codes[(i + 1) * 255 / kParts];
    const float left = at.x + width * static_cast<float>(i) / kParts;
    const float right = at.x + width * static_cast<float>(i + 1) / kParts;
    list.AddRectFilledMultiColor({left, at.y}, {right, at.y + height}, from, to, to, from);
  }
  list.AddRect(at, {at.x + width, at.y + height}, frame_color());
}

void draw_heatmap_histogram(const std::string& name, float width, float height,
                            const HeatmapView& heatmap, HeatmapSettings& settings) {
  if (heatmap.bins.empty() || !(heatmap.bins_high > heatmap.bins_low)) return;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float grip = std::round(ImGui::GetFontSize() * 0.25F);
  const Rect area{at.x + grip, at.y, width - 2.0F * grip, height};
  draw_bars(area, heatmap);
  note_area(name + ".histogram", area.x, area.y, area.width, area.height);
  const auto high = draw_handle(name, {"high", "The palette ends at", heatmap.high}, area, heatmap);
  const auto low = draw_handle(name, {"low", "The palette begins at", heatmap.low}, area, heatmap);
  if (low || high) {
    settings.automatic_range = false;
    settings.low = static_cast<float>(low ? std::min(*low, heatmap.high) : heatmap.low);
    settings.high = static_cast<float>(high ? std::max(*high, heatmap.low) : heatmap.high);
  }
  ImGui::SetCursorScreenPos({at.x, at.y + height});
}

}  // namespace encore::ui
