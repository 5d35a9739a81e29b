#include "ui/plot/plot_colors.h"
#include "ui/plot/plot_draw.h"
#include "ui/widget_map.h"

#include <fmt/format.h>

#include <algorithm>

namespace encore::ui {

namespace {

using energy::Origin;

/// Measured numbers are the rule; the others are told apart by hue and by an empty frame.
std::uint32_t badge_color(Origin origin) {
  switch (origin) {
    case Origin::measured:
      return plot_color(PlotColor::animate);
    case Origin::modelled:
      return plot_color(PlotColor::build);
    case Origin::simulated:
      return plot_color(PlotColor::transfer);
    case Origin::unavailable:
      break;
  }
  return plot_color(PlotColor::idle);
}

float swatch_width() {
  return 1.1F * em();
}

float entry_width(const LegendEntry& entry) {
  float width = swatch_width() + 0.4F * em() + text_width(entry.name);
  if (!entry.value.empty()) width += 0.5F * em() + text_width(entry.value);
  if (entry.provenance) width += 0.5F * em() + badge_width(entry.provenance->origin);
  return width + 0.4F * em();
}

void draw_entry(ImDrawList& list, const LegendEntry& entry, ImVec2 at, bool hovered) {
  const float y = at.y + 0.15F * em();
  const float faded = entry.hidden ? 0.35F : 1.0F;
  const PlotRect swatch{at.x, y + 0.1F * em(), at.x + swatch_width(), y + 0.9F * em()};
  if (entry.hidden) {
    list.AddRect({swatch.x0, swatch.y0}, {swatch.x1, swatch.y1}, text_color(0.35F), 0.15F * em());
  } else {
    list.AddRectFilled({swatch.x0, swatch.y0}, {swatch.x1, swatch.y1}, entry.color, 0.15F * em());
    if (entry.hatched) hatch(list, swatch, ImGui::GetColorU32(ImGuiCol_WindowBg, 0.75F));
  }
  float x = swatch.x1 + 0.4F * em();
  draw_text(list, x, y, text_color(faded), entry.name);
  const float name_end = x + text_width(entry.name);
  if (hovered) list.AddLine({x, y + 1.1F * em()}, {name_end, y + 1.1F * em()}, text_color(0.6F));
  x = name_end + 0.5F * em();
  if (!entry.value.empty()) {
    draw_text(list, x, y, text_color(0.75F * faded), entry.value);
    x += text_width(entry.value) + 0.5F * em();
  }
  if (entry.provenance) draw_badge(list, x, y, entry.provenance->origin);
}

void entry_tooltip(const LegendEntry& entry) {
  if (!entry.provenance && entry.tooltip.empty()) return;
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(entry.name.c_str());
  if (entry.provenance) ImGui::TextUnformatted(provenance_text(*entry.provenance).c_str());
  if (!entry.tooltip.empty()) ImGui::TextUnformatted(entry.tooltip.c_str());
  ImGui::EndTooltip();
}

}  // namespace

std::string provenance_text(const energy::Provenance& provenance) {
  if (provenance.detail.empty()) return std::string(energy::to_string(provenance.origin));
  return fmt::format("{}: {}", energy::to_string(provenance.origin), provenance.detail);
}

float badge_width(Origin origin) {
  return text_width(energy::to_string(origin)) + 0.6F * em();
}

float draw_badge(ImDrawList& list, float x, float y, Origin origin) {
  const float width = badge_width(origin);
  const std::uint32_t color = badge_color(origin);
  const ImVec2 from{x, y - 0.05F * em()};
  const ImVec2 to{x + width, y + 1.1F * em()};
  const bool filled = origin == Origin::measured;
  if (filled) list.AddRectFilled(from, to, (color & 0x00FFFFFFU) | 0x38000000U, 0.35F * em());
  list.AddRect(from, to, color, 0.35F * em());
  draw_text(list, x + 0.3F * em(), y, text_color(0.9F), energy::to_string(origin));
  return width;
}

std::optional<std::size_t> draw_legend(std::string_view plot, std::span<const LegendEntry> entries,
                                       float width) {
  std::optional<std::size_t> clicked;
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float line = 1.4F * em();
  float x = 0.0F;
  float y = 0.0F;
  ImGui::PushID("legend");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const LegendEntry& entry = entries[i];
    const float size = entry_width(entry);
    if (x > 0.0F && x + size > width) {
      x = 0.0F;
      y += line;
    }
    const ImVec2 at{start.x + x, start.y + y};
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::InvisibleButton("entry", {size, line})) clicked = i;
    const bool hovered = ImGui::IsItemHovered();
    if (widget_map_enabled()) {
      note_widget(fmt::format("{}.legend.{}", plot, entry.name), entry.hidden ? "off" : "on");
    }
    draw_entry(*ImGui::GetWindowDrawList(), entry, at, hovered);
    if (hovered) entry_tooltip(entry);
    ImGui::PopID();
    x += size + 0.8F * em();
  }
  ImGui::PopID();
  ImGui::SetCursorScreenPos({start.x, start.y + (entries.empty() ? 0.0F : y + line)});
  return clicked;
}

}  // namespace encore::ui
