#include "ui/plot/plot_colors.h"
#include "ui/plot/plot_draw.h"
#include "ui/widget_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

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

/// What an entry takes besides its name.
float other_width(const LegendEntry& entry) {
  float width = swatch_width() + 0.4F * em();
  if (!entry.value.empty()) width += 0.5F * em() + text_width(entry.value);
  if (entry.provenance) width += 0.5F * em() + badge_width(entry.provenance->origin);
  return width + 0.3F * em();
}

float line_height() {
  return 1.4F * em();
}

struct PlacedEntry {
  ImVec2 at;
  float width = 0.0F;
  std::string name;  ///< as long as there is room for it
};

std::string more_text(std::size_t left_over) {
  return fmt::format("+{} more", left_over);
}

/// Entries in rows from (0, 0) on, as many as there is room for.
std::vector<PlacedEntry> place_entries(std::span<const LegendEntry> entries, float width,
                                       std::size_t most_rows) {
  const float gap = 0.6F * em();
  std::vector<PlacedEntry> placed;
  ImVec2 at{0.0F, 0.0F};
  std::size_t row = 0;
  for (const LegendEntry& entry : entries) {
    const float others = other_width(entry);
    PlacedEntry one{at, others + text_width(entry.name), entry.name};
    if (one.width > width) {
      const auto measure = [](std::string_view text) { return text_width(text); };
      const PlacedLabel label = fit_label(entry.name, std::max(width - others, em()), 1, measure);
      one.name = label.lines.empty() ? std::string() : label.lines.front();
      one.width = others + text_width(one.name);
    }
    if (at.x > 0.0F && at.x + one.width > width) {
      if (++row >= most_rows) break;
      at = {0.0F, at.y + line_height()};
    }
    one.at = at;
    at.x += one.width + gap;
    placed.push_back(std::move(one));
  }
  // The last ones give way to the words that stand for what is left over.
  while (placed.size() > 1 && placed.size() < entries.size()) {
    const PlacedEntry& last = placed.back();
    const float words = text_width(more_text(entries.size() - placed.size()));
    if (last.at.x == 0.0F || last.at.x + last.width + gap + words <= width) break;
    placed.pop_back();
  }
  return placed;
}

void draw_entry(ImDrawList& list, const LegendEntry& entry, const std::string& name, ImVec2 at,
                bool hovered) {
  const float y = at.y + 0.15F * em();
  const float faded = entry.hidden ? 0.35F : 1.0F;
  const PlotRect swatch{at.x, y + 0.1F * em(), at.x + swatch_width(), y + 0.9F * em()};
  if (entry.mark != LegendEntry::Mark::box) {
    const float middle = 0.5F * (swatch.y0 + swatch.y1);
    const float thickness = std::max(1.5F, 0.14F * em());
    const std::uint32_t color = entry.hidden ? text_color(0.35F) : entry.color;
    if (entry.mark == LegendEntry::Mark::line) {
      list.AddLine({swatch.x0, middle}, {swatch.x1, middle}, color, thickness);
    } else {
      dashed_line(list, {swatch.x0, middle}, {swatch.x1, middle}, color, thickness);
    }
  } else if (entry.hidden) {
    list.AddRect({swatch.x0, swatch.y0}, {swatch.x1, swatch.y1}, text_color(0.35F), 0.15F * em());
  } else {
    list.AddRectFilled({swatch.x0, swatch.y0}, {swatch.x1, swatch.y1}, entry.color, 0.15F * em());
    if (entry.hatched) hatch(list, swatch, ImGui::GetColorU32(ImGuiCol_WindowBg, 0.75F));
  }
  float x = swatch.x1 + 0.4F * em();
  draw_text(list, x, y, text_color(faded), name);
  const float name_end = x + text_width(name);
  if (hovered) list.AddLine({x, y + 1.1F * em()}, {name_end, y + 1.1F * em()}, text_color(0.6F));
  x = name_end + 0.5F * em();
  if (!entry.value.empty()) {
    draw_text(list, x, y, text_color(0.75F * faded), entry.value);
    x += text_width(entry.value) + 0.5F * em();
  }
  if (entry.provenance) draw_badge(list, x, y, entry.provenance->origin);
}

void entry_tooltip(const LegendEntry& entry, bool shortened) {
  if (!entry.provenance && entry.tooltip.empty() && !shortened) return;
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(entry.name.c_str());
  if (entry.provenance) ImGui::TextUnformatted(provenance_text(*entry.provenance).c_str());
  if (!entry.tooltip.empty()) ImGui::TextUnformatted(entry.tooltip.c_str());
  ImGui::EndTooltip();
}

/// Words for the entries that have no room.
void draw_more(std::string_view plot, std::span<const LegendEntry> left_over, ImVec2 at) {
  const std::string words = more_text(left_over.size());
  ImGui::SetCursorScreenPos(at);
  ImGui::InvisibleButton("more", {text_width(words), line_height()});
  if (widget_map_enabled()) note_widget(fmt::format("{}.legend_more", plot), words);
  draw_text(*ImGui::GetWindowDrawList(), at.x, at.y + 0.15F * em(), text_color(0.65F), words);
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  for (const LegendEntry& entry : left_over) ImGui::TextUnformatted(entry.name.c_str());
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
                                       float width, std::size_t most_rows) {
  std::optional<std::size_t> clicked;
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float line = line_height();
  const std::vector<PlacedEntry> placed = place_entries(entries, width, most_rows);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::PushID("legend");
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const LegendEntry& entry = entries[i];
    const ImVec2 at{start.x + placed[i].at.x, start.y + placed[i].at.y};
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::InvisibleButton("entry", {std::max(1.0F, placed[i].width), line})) clicked = i;
    const bool hovered = ImGui::IsItemHovered();
    if (widget_map_enabled()) {
      note_widget(fmt::format("{}.legend.{}", plot, entry.name), entry.hidden ? "off" : "on");
    }
    draw_entry(list, entry, placed[i].name, at, hovered);
    if (hovered) entry_tooltip(entry, placed[i].name != entry.name);
    ImGui::PopID();
  }
  if (placed.size() < entries.size() && !placed.empty()) {
    const PlacedEntry& last = placed.back();
    const ImVec2 at{start.x + last.at.x + last.width + 0.6F * em(), start.y + last.at.y};
    draw_more(plot, entries.subspan(placed.size()), at);
  }
  ImGui::PopID();
  ImGui::SetCursorScreenPos(
      {start.x, start.y + (placed.empty() ? 0.0F : placed.back().at.y + line)});
  return clicked;
}

}  // namespace encore::ui
