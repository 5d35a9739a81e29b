#include "renderer/difference_image.h"
#include "ui/panels/histogram.h"
#include "ui/panels/pane_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/plot_colors.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace encore::ui {

namespace {

/// A card at the lower left of the room that holds `lines` lines of text and `more` pixels.
Rect legend_area(const Rect& room, std::size_t lines, float more) {
  const float em = ImGui::GetFontSize();
  const float line = em + ImGui::GetStyle().ItemSpacing.y;
  const float height = std::round(2.0F * card_padding() + static_cast<float>(lines) * line + more);
  const float width = std::round(std::min(em * 22.0F, room.width - em));
  return {std::round(room.x + em * 0.4F), std::round(room.bottom() - height - em * 0.4F), width,
          height};
}

bool fits(const Rect& room, const Rect& card) {
  return card.width > ImGui::GetFontSize() * 6.0F && card.height < room.height;
}

/// One line for why there is nothing to explain, or several where it is long.
void draw_reason(const Rect& room, const PaneContext& context, const std::string& reason) {
  const float em = ImGui::GetFontSize();
  const float inner = std::min(em * 22.0F, room.width - em) - 2.0F * card_padding();
  const float height = ImGui::CalcTextSize(reason.c_str(), nullptr, false, inner).y;
  const Rect area = legend_area(room, 0, height + 1.0F);
  if (!fits(room, area)) return;
  if (begin_card("legend", area)) {
    ImGui::PushTextWrapPos(0.0F);
    colored_text(theme_colors(context.state.preferences.theme).warning, reason);
    ImGui::PopTextWrapPos();
    note_widget(context.name("legend.reason"), reason);
  }
  end_card();
}

/// The two ends of a scale, left and right below it.
void draw_ends(float width, const std::string& low, const std::string& high) {
  const float x = ImGui::GetCursorPosX();
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine(x + width - ImGui::CalcTextSize(high.c_str()).x);
  ImGui::TextUnformatted(high.c_str());
}

std::string statistics_text(const HeatmapView& map) {
  return fmt::format(
      "A pixel's cost: smallest {}, median {}, 99 % are at most {}, largest {}, mean {}.\nAll "
      "pixels together: {}.\nThe bars' heights grow with the root of the number of pixels.",
      heatmap_text(map.min, map.unit), heatmap_text(map.median, map.unit),
      heatmap_text(map.percentile_99, map.unit), heatmap_text(map.max, map.unit),
      heatmap_text(map.mean, map.unit), heatmap_text(map.sum, map.unit));
}

std::string heatmap_title(const HeatmapView& map) {
  return map.unit == "J" ? "Joules a pixel" : fmt::format("{} a pixel", map.unit);
}

void draw_heatmap_legend(const Rect& room, const PaneContext& context, const HeatmapView& map) {
  if (map.unit.empty()) {
    return draw_reason(room, context,
                       map.provenance.detail.empty() ? "No costs are known of this picture."
                                                     : map.provenance.detail);
  }
  const float em = ImGui::GetFontSize();
  const bool energy = map.unit == "J";
  const float bars = map.bins.empty() ? 0.0F : em * 3.0F;
  const Rect area = legend_area(room, energy ? 3 : 2, bars + em * 1.4F);
  if (!fits(room, area)) return;
  HeatmapSettings& settings = context.state.settings.heatmap;
  if (begin_card("legend", area)) {
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::TextUnformatted(heatmap_title(map).c_str());
    note_widget(context.name("legend"), heatmap_title(map));
    tooltip(statistics_text(map));
    if (energy) {
      badge(map.provenance);
      note_widget(context.name("legend.badge"), energy::to_string(map.provenance.origin));
      ImGui::SameLine();
      const std::string rests = fitted(map.provenance.detail, ImGui::GetContentRegionAvail().x);
      colored_text(theme_colors(context.state.preferences.theme).dim_text, rests);
      tooltip(map.provenance.detail);
    }
    draw_heatmap_histogram(context.name("heatmap"), width, bars, map, settings);
    draw_palette_bar(width, em * 0.8F, settings.palette);
    draw_ends(width, heatmap_text(map.low, map.unit), heatmap_text(map.high, map.unit));
  }
  end_card();
}

std::vector<std::string> difference_lines(const DifferenceView& view) {
  const auto share = [&view](std::uint64_t count) {
    return view.pixels > 0 ? 100.0 * double(count) / double(view.pixels) : 0.0;
  };
  std::vector<std::string> lines{
      fmt::format("RMSE {:.3g}, largest {:.3g}", view.rmse, view.largest),
      fmt::format("differing pixels: {} of {} ({:.2g} %)", count_text(view.differing_pixels),
                  count_text(view.pixels), share(view.differing_pixels))};
  if (view.differing_hits) {
    lines.push_back(fmt::format("other triangle hit: {} ({:.2g} %)",
                                count_text(*view.differing_hits), share(*view.differing_hits)));
  } else {
    lines.emplace_back("hits are not compared: both panes must trace rays");
  }
  return lines;
}

void draw_difference_legend(const Rect& room, const PaneContext& context,
                            const DifferenceView& view) {
  const float em = ImGui::GetFontSize();
  const std::vector<std::string> lines = difference_lines(view);
  const Rect area = legend_area(room, lines.size() + 3, em * 1.4F);
  if (!fits(room, area)) return;
  if (begin_card("legend", area)) {
    const PaneDevice other = context.state.settings.panes.at(1 - context.pane).device;
    const std::string title = fmt::format("Difference from the {} pane", device_title(other));
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::TextUnformatted(title.c_str());
    note_widget(context.name("legend"), title);
    tooltip(
        "Of linear RGB, before it is brought to the screen. RMSE: root of the mean squared "
        "difference of a channel. Largest: of one channel of one pixel.");
    for (const std::string& line : lines) {
      ImGui::TextUnformatted(fitted(line, width).c_str());
      note_widget(context.name("legend.line"), line);
    }
    draw_palette_bar(width, em * 0.8F, 0);
    draw_ends(width, fmt::format("{:.0e}", renderer::kDifferenceFirst),
              fmt::format("{:.0f}", renderer::kDifferenceLast));
    colored_text(theme_colors(context.state.preferences.theme).dim_text,
                 fitted("black: same; magenta: other triangle", width));
    tooltip("Colours: the largest difference of a channel, on a logarithmic scale.");
  }
  end_card();
}

/// Why there is no difference to show.
std::string difference_reason(const PaneContext& context) {
  const std::size_t other = 1 - context.pane;
  const PaneDevice device = context.state.settings.panes.at(other).device;
  const PaneView& mine = context.shown();
  const PaneView& theirs = context.view.panes.at(other);
  if (device == PaneDevice::off) {
    return "No difference: the other pane is off. Switch it on to compare with it.";
  }
  if (mine.width != theirs.width || mine.height != theirs.height) {
    return fmt::format(
        "No difference: this picture has {} pixels, the other one {}. Set the same size for both.",
        size_text(mine.width, mine.height), size_text(theirs.width, theirs.height));
  }
  if (theirs.state == PaneState::failed || theirs.state == PaneState::cancelled) {
    return "No difference: the other pane has no picture.";
  }
  return "No difference yet: both pictures have to be there.";
}

/// Beside the mouse's half of the room, at its foot or, if the mouse is there, at its top.
Rect hover_area(const Rect& room, const std::vector<std::string>& lines) {
  const float em = ImGui::GetFontSize();
  float width = 0.0F;
  for (const std::string& line : lines) {
    width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
  }
  width = std::round(width + em);
  const float height = std::round(em * 1.2F * static_cast<float>(lines.size()) + em * 0.7F);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool near =
      mouse.x > room.right() - width - 2.0F * em && mouse.y > room.bottom() - height - 2.0F * em;
  const float y = near ? room.y + em * 0.4F : room.bottom() - height - em * 0.4F;
  return {std::round(room.right() - width - em * 0.4F), std::round(y), width, height};
}

}  // namespace

void draw_pane_legend(const Rect& room, const PaneContext& context) {
  const PaneView& shown = context.shown();
  switch (context.settings().content) {
    case PaneContent::picture:
      return;
    case PaneContent::heatmap:
      if (shown.heatmap) draw_heatmap_legend(room, context, *shown.heatmap);
      return;
    case PaneContent::difference:
      if (shown.difference) return draw_difference_legend(room, context, *shown.difference);
      return draw_reason(room, context, difference_reason(context));
  }
}

void draw_hover_box(const Rect& room, const PixelView& pixel) {
  std::vector<std::string> lines{fmt::format("pixel {}, {}", pixel.x, pixel.y)};
  if (pixel.found) {
    lines.push_back(fmt::format("distance {:.5g}", pixel.distance));
    lines.push_back(fmt::format("triangle {}", count_text(pixel.triangle)));
    if (!pixel.material.empty()) lines.push_back("material " + pixel.material);
  } else {
    lines.emplace_back("hits nothing");
  }
  lines.push_back(fmt::format("{} steps", count_text(pixel.steps)));
  lines.push_back(fmt::format("{} box tests", count_text(pixel.box_tests)));
  lines.push_back(fmt::format("{} triangle tests", count_text(pixel.triangle_tests)));
  const Rect area = hover_area(room, lines);
  const float em = ImGui::GetFontSize();
  if (area.width > room.width - em || area.height > room.height - em) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_PopupBg);
  ground.w = 0.9F;
  list.AddRectFilled({area.x, area.y}, {area.right(), area.bottom()}, ImGui::GetColorU32(ground),
                     em * 0.3F);
  list.AddRect({area.x, area.y}, {area.right(), area.bottom()}, frame_color(), em * 0.3F);
  float y = area.y + em * 0.35F;
  std::string all;
  for (const std::string& line : lines) {
    list.AddText({area.x + em * 0.5F, y}, text_color(), line.c_str());
    y += em * 1.2F;
    all += (all.empty() ? "" : "; ") + line;
  }
  note_area("pane.hover", area.x, area.y, area.width, area.height, all);
}

}  // namespace encore::ui
