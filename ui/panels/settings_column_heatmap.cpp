#include "renderer/heatmap_palette.h"
#include "ui/panels/settings_column.h"
#include "ui/plot/value_text.h"
#include "ui/widget_map.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace encore::ui {

namespace {

constexpr std::array<ValueChoice<HeatmapCost>, 4> kCosts{{
    {HeatmapCost::steps, "steps", "nodes or cells that the ray entered"},
    {HeatmapCost::triangle_tests, "triangle tests", "ray-triangle tests"},
    {HeatmapCost::box_tests, "box tests", "ray-box tests, which only hierarchies make"},
    {HeatmapCost::energy, "energy", "the frame's joules, shared by weights: modelled"},
}};

bool shows_heatmap(const PaneSettings& pane) {
  return traces(pane.device) && pane.content == PaneContent::heatmap;
}

/// Of the panes that show one, the first that has figures.
const HeatmapView* figures_of(const ColumnContext& context) {
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) {
    const auto& heatmap = context.view.panes[pane].heatmap;
    if (shows_heatmap(context.state.settings.panes[pane]) && heatmap) return &*heatmap;
  }
  return nullptr;
}

void draw_cost(const UiState& state, HeatmapSettings& heatmap) {
  bool boxes = false;
  bool steps = false;
  for (const PaneSettings& pane : state.settings.panes) {
    if (!shows_heatmap(pane)) continue;
    boxes = boxes || pane.structure.kind == accel::StructureKind::bvh_median ||
            pane.structure.kind == accel::StructureKind::bvh_sah;
    steps = steps || pane.structure.kind != accel::StructureKind::brute;
  }
  std::vector<ValueChoice<HeatmapCost>> costs;
  for (const auto& cost : kCosts) {
    const bool there = (cost.value != HeatmapCost::box_tests || boxes) &&
                       (cost.value != HeatmapCost::steps || steps);
    if (there || cost.value == heatmap.cost) costs.push_back(cost);
  }
  value_choice_row({"settings.heatmap.cost", "Cost", "What a pixel's colour says of its ray."},
                   heatmap.cost, costs);
}

void draw_weights(HeatmapSettings& heatmap) {
  hint_line(
      "Modelled: the joules of the frame are shared among the pixels in proportion to their "
      "weighted counts. No sensor sees a single pixel.");
  const HeatmapSettings usual;
  const auto weight = [&](const char* name, const char* label, float& value, float standard) {
    number_row(NumberRow<float>{.row = {fmt::format("settings.heatmap.{}", name), label,
                                        "How much one of them weighs against the others; only the "
                                        "proportions count."},
                                .high = 1e9F,
                                .usual = standard,
                                .most_slid = 10.0F,
                                .commit = Commit::at_once},
               value);
  };
  weight("step_weight", "Step", heatmap.step_weight, usual.step_weight);
  weight("box_weight", "Box test", heatmap.box_weight, usual.box_weight);
  weight("triangle_weight", "Triangle test", heatmap.triangle_weight, usual.triangle_weight);
}

void draw_palette(const HeatmapView* figures, HeatmapSettings& heatmap) {
  std::array<ValueChoice<int>, std::size(renderer::kPalettes)> palettes{};
  constexpr std::array<const char*, 4> kTips{
      "dark violet over green to light yellow; lightness alone tells the order", "black to white",
      "blue over a light grey to red, for values to both sides of a middle",
      "many hues, for finding equal values; its order is not told by lightness alone"};
  for (std::size_t i = 0; i < palettes.size(); ++i) {
    palettes[i] = {static_cast<int>(i), renderer::to_string(renderer::kPalettes[i]),
                   i < kTips.size() ? kTips[i] : ""};
  }
  value_choice_row({"settings.heatmap.palette", "Palette", "How values become colours."},
                   heatmap.palette, palettes);
  std::string low;
  std::string high;
  if (figures != nullptr && !figures->unit.empty()) {
    low = value_text(figures->low, figures->unit, 3);
    high = value_text(figures->high, figures->unit, 3);
  }
  draw_palette_band("settings.heatmap.preview", heatmap.palette, low, high,
                    "The palette, and the values that its ends stand for.");
}

void draw_range(const HeatmapView* figures, HeatmapSettings& heatmap) {
  if (toggle_row({"settings.heatmap.automatic", "Automatic range",
                  "From 0 to the 99th percentile of each picture. Off: a range that stays, so that "
                  "pictures can be compared."},
                 heatmap.automatic_range) &&
      !heatmap.automatic_range && figures != nullptr && figures->high > figures->low) {
    // The range by hand begins as it was.
    heatmap.low = static_cast<float>(figures->low);
    heatmap.high = static_cast<float>(figures->high);
  }
  if (!heatmap.automatic_range) {
    double low = heatmap.low;
    double high = heatmap.high;
    const double most = std::max({figures != nullptr ? figures->max : 0.0, high, 1e-30});
    if (range_row({.row = {"settings.heatmap.range", "Range",
                           "Values of the palette's first and last colour."},
                   .high = most,
                   .unit = figures != nullptr ? figures->unit : std::string()},
                  low, high)) {
      heatmap.low = static_cast<float>(low);
      heatmap.high = static_cast<float>(high);
    }
  }
  toggle_row({"settings.heatmap.logarithmic", "Logarithmic",
              "Equal ratios look equally far apart; what is 0 has the first colour."},
             heatmap.logarithmic);
}

/// How many pixels cost how much: square roots of the counts, so that rare ones are seen.
void draw_histogram(const HeatmapView& figures) {
  if (figures.bins.empty()) return;
  const std::uint64_t most = *std::max_element(figures.bins.begin(), figures.bins.end());
  if (most == 0) return;
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = std::round(ImGui::GetFontSize() * 3.0F);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  note_widget("settings.heatmap.histogram");
  tooltip(fmt::format(
      "Pixels by cost, from {} to {}; heights are square roots of counts, so that "
      "rare costs are seen.\nmedian {}, mean {}, 99 % {}, sum {}",
      value_text(figures.bins_low, figures.unit, 3), value_text(figures.bins_high, figures.unit, 3),
      value_text(figures.median, figures.unit, 3), value_text(figures.mean, figures.unit, 3),
      value_text(figures.percentile_99, figures.unit, 3),
      value_text(figures.sum, figures.unit, 3)));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  const float step = width / static_cast<float>(figures.bins.size());
  for (std::size_t i = 0; i < figures.bins.size(); ++i) {
    const double share = std::sqrt(double(figures.bins[i]) / double(most));
    const float x = at.x + step * static_cast<float>(i);
    list.AddRectFilled({x, at.y + height * (1.0F - static_cast<float>(share))},
                       {x + std::max(step - 1.0F, 1.0F), at.y + height},
                       ImGui::GetColorU32(ImGuiCol_PlotHistogram));
  }
}

}  // namespace

void draw_heatmap_section(const ColumnContext& context) {
  const auto& panes = context.state.settings.panes;
  if (std::none_of(panes.begin(), panes.end(), shows_heatmap)) return;
  if (!section("settings.heatmap", "Heatmap", "What each pixel's ray cost.")) return;
  HeatmapSettings& heatmap = context.state.settings.heatmap;
  const HeatmapView* figures = figures_of(context);
  draw_cost(context.state, heatmap);
  if (heatmap.cost == HeatmapCost::energy) {
    if (figures != nullptr) badge(figures->provenance);
    if (figures != nullptr && figures->unit.empty()) hint_line(figures->provenance.detail);
    draw_weights(heatmap);
  }
  draw_palette(figures, heatmap);
  if (figures != nullptr) draw_histogram(*figures);
  draw_range(figures, heatmap);
}

}  // namespace encore::ui
