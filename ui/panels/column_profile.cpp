#include "accel/inspect/node_measures.h"
#include "ui/panels/column_parts.h"
#include "ui/panels/shell_parts.h"
#include "ui/plot/plot_colors.h"
#include "ui/style.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace encore::ui {

namespace {

struct Part {
  std::uint64_t count = 0;
  std::uint32_t color = 0;
};

/// A column of a chart: its parts from the bottom, and what it says of itself.
struct Bar {
  std::vector<Part> parts;
  std::string tip;
};

std::uint64_t total_of(const Bar& bar) {
  std::uint64_t total = 0;
  for (const Part& part : bar.parts) total += part.count;
  return total;
}

/// Bars side by side, whose heights grow with the root of the counts, so that few are seen beside
/// many.
void draw_bars(const char* name, const std::vector<Bar>& bars) {
  const float em = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = std::round(em * 4.5F);
  ImGui::InvisibleButton(name, {std::max(width, 1.0F), height});
  note_widget(std::string("statistics.") + name, fmt::format("{}", bars.size()));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, ground_color());
  std::uint64_t most = 1;
  for (const Bar& bar : bars) most = std::max(most, total_of(bar));
  const float step = width / static_cast<float>(std::max<std::size_t>(bars.size(), 1));
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const std::uint64_t total = total_of(bars[i]);
    if (total == 0) continue;
    const float full =
        std::max(1.0F, height * static_cast<float>(std::sqrt(double(total) / double(most))));
    const float left = at.x + static_cast<float>(i) * step;
    const float right = left + std::max(1.0F, step - 1.0F);
    float foot = at.y + height;
    for (const Part& part : bars[i].parts) {
      const float part_height = full * static_cast<float>(double(part.count) / double(total));
      list.AddRectFilled({left, foot - part_height}, {right, foot}, part.color);
      foot -= part_height;
    }
  }
  list.AddLine({at.x, at.y + height}, {at.x + width, at.y + height}, frame_color());
  if (!ImGui::IsItemHovered() || bars.empty()) return;
  const auto under = static_cast<std::size_t>(std::clamp(
      (ImGui::GetIO().MousePos.x - at.x) / step, 0.0F, static_cast<float>(bars.size() - 1)));
  list.AddRect({at.x + static_cast<float>(under) * step, at.y},
               {at.x + static_cast<float>(under + 1) * step, at.y + height}, text_color(0.6F));
  tooltip(bars[under].tip);
}

std::array<std::uint32_t, 3> part_colors() {
  return {plot_color(PlotColor::cpu), plot_color(PlotColor::update), plot_color(PlotColor::idle)};
}

void draw_key(const char* word, std::uint32_t color, bool first) {
  const float em = ImGui::GetFontSize();
  if (!first) ImGui::SameLine(0.0F, em);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + em * 0.25F},
                                            {at.x + em * 0.7F, at.y + em * 0.95F}, color);
  ImGui::Dummy({em * 0.7F, em});
  ImGui::SameLine(0.0F, em * 0.35F);
  ImGui::TextUnformatted(word);
}

void draw_title(const char* title, const ThemeColors& colors) {
  ImGui::PushStyleColor(ImGuiCol_Text, colors.dim_text);
  cut_text(title);
  ImGui::PopStyleColor();
}

void draw_depths(const accel::StructureProfile& profile, const ThemeColors& colors) {
  draw_title("Nodes a depth, the root at the left", colors);
  const auto part = part_colors();
  std::vector<Bar> bars;
  for (std::size_t depth = 0; depth < profile.depths.size(); ++depth) {
    const accel::DepthProfile& at = profile.depths[depth];
    const std::uint64_t filled = at.leaves - std::min(at.leaves, at.empty_leaves);
    Bar bar{
        {{at.inner, part[0]}, {filled, part[1]}, {at.empty_leaves, part[2]}},
        fmt::format("depth {}: {} inner nodes, {} leaves, {} of them empty\n{} references, at "
                    "most {} in one leaf",
                    depth, count_text(at.inner), count_text(at.leaves), count_text(at.empty_leaves),
                    count_text(at.references), count_text(at.largest_leaf))};
    if (std::isfinite(at.area_share)) {
      bar.tip +=
          fmt::format("\na random ray through the whole enters {:.3g} of them", at.area_share);
    }
    bars.push_back(std::move(bar));
  }
  draw_bars("depths", bars);
  draw_key("inner", part[0], true);
  draw_key("leaves", part[1], false);
  draw_key("empty", part[2], false);
}

std::string size_range(std::size_t i) {
  const auto range = accel::leaf_size_range(i);
  return range[0] == range[1] ? count_text(range[0])
                              : count_text(range[0]) + " to " + count_text(range[1]);
}

void draw_sizes(const accel::StructureProfile& profile, bool cells, const ThemeColors& colors) {
  draw_title(cells ? "Cells by triangles, few at the left" : "Leaves by triangles, few at the left",
             colors);
  const auto part = part_colors();
  std::vector<Bar> bars;
  for (std::size_t i = 0; i < profile.leaf_sizes.size(); ++i) {
    bars.push_back({{{profile.leaf_sizes[i], i == 0 ? part[2] : part[1]}},
                    fmt::format("{} triangles: {} {}", size_range(i),
                                count_text(profile.leaf_sizes[i]), cells ? "cells" : "leaves")});
  }
  draw_bars("leaf_sizes", bars);
  if (!bars.empty()) {
    const std::string last = size_range(bars.size() - 1);
    ImGui::TextUnformatted("0");
    ImGui::SameLine(std::max(ImGui::GetFontSize(), ImGui::GetContentRegionAvail().x -
                                                       ImGui::CalcTextSize(last.c_str()).x));
    ImGui::TextUnformatted(last.c_str());
  }
}

}  // namespace

void draw_profile(const ColumnContext& context) {
  const PaneView& shown = context.shown();
  if (!shown.profile) return;
  const ThemeColors& colors = theme_colors(context.state.preferences.theme);
  const bool cells = shown.stats && shown.stats->grid_size[0] > 0;
  if (!cells) draw_depths(*shown.profile, colors);
  ImGui::Spacing();
  draw_sizes(*shown.profile, cells, colors);
}

}  // namespace encore::ui
