#include "app/window/heatmap_colors.h"

#include "renderer/heatmap_style.h"
#include "renderer/heatmap_values.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace encore::app {

namespace {

constexpr std::size_t kBins = 64;

std::optional<renderer::HeatmapValues> values_of(std::span<const accel::TraceCounters> counters,
                                                 const ui::HeatmapSettings& settings,
                                                 std::optional<double> frame_joules,
                                                 const energy::Provenance& frame_energy) {
  switch (settings.cost) {
    case ui::HeatmapCost::steps:
      return renderer::count_values(counters, renderer::HeatmapQuantity::steps);
    case ui::HeatmapCost::triangle_tests:
      return renderer::count_values(counters, renderer::HeatmapQuantity::triangle_tests);
    case ui::HeatmapCost::box_tests:
      return renderer::count_values(counters, renderer::HeatmapQuantity::box_tests);
    case ui::HeatmapCost::energy:
      break;
  }
  const renderer::CostWeights weights{double(settings.step_weight), double(settings.box_weight),
                                      double(settings.triangle_weight)};
  const bool any = weights.step > 0.0 || weights.box_test > 0.0 || weights.triangle_test > 0.0;
  if (!frame_joules || !any) return std::nullopt;
  return renderer::shared_energy_values(counters, weights, *frame_joules, frame_energy.detail);
}

renderer::HeatmapRange range_of(const ui::HeatmapSettings& settings,
                                const renderer::ValueStatistics& statistics) {
  const renderer::HeatmapScale scale =
      settings.logarithmic ? renderer::HeatmapScale::logarithmic : renderer::HeatmapScale::linear;
  renderer::HeatmapRange range = renderer::default_range(statistics, scale);
  if (settings.automatic_range) return range;
  range.low = double(settings.low);
  range.high = std::max(double(settings.high), range.low);
  if (range.low <= 0.0) range.scale = renderer::HeatmapScale::linear;
  return range;
}

}  // namespace

ui::HeatmapView heatmap_colors(std::span<const accel::TraceCounters> counters,
                               const ui::HeatmapSettings& settings,
                               std::optional<double> frame_joules,
                               const energy::Provenance& frame_energy, ScreenPicture& screen) {
  ui::HeatmapView view;
  view.provenance = frame_energy;
  const auto values = values_of(counters, settings, frame_joules, frame_energy);
  const auto statistics = values ? renderer::value_statistics(values->values)
                                 : std::optional<renderer::ValueStatistics>{};
  if (!statistics) {
    for (std::size_t i = 0; i < screen.rgba.size(); ++i) screen.rgba[i] = i % 4 == 3 ? 255 : 0;
    return view;
  }
  renderer::HeatmapStyle style;
  const auto palettes = static_cast<int>(std::size(renderer::kPalettes));
  style.palette = renderer::kPalettes[std::clamp(settings.palette, 0, palettes - 1)];
  style.range = range_of(settings, *statistics);
  renderer::draw_heatmap(values->values, style, std::span<std::uint8_t>(screen.rgba));
  view.min = double(statistics->min);
  view.median = double(statistics->median);
  view.percentile_99 = double(statistics->percentile_99);
  view.max = double(statistics->max);
  view.mean = statistics->mean;
  view.sum = statistics->sum;
  view.low = style.range.low;
  view.high = style.range.high;
  view.unit = values->unit;
  if (view.max > view.min) {
    const renderer::HeatmapRange whole{view.min, view.max, renderer::HeatmapScale::linear};
    view.bins = renderer::heatmap_histogram(values->values, whole, kBins).bins;
    view.bins_low = whole.low;
    view.bins_high = whole.high;
  }
  return view;
}

}  // namespace encore::app
