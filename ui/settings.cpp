#include "ui/settings.h"

#include <utility>

namespace encore::ui {

namespace {

template <class Enum, std::size_t N>
using Words = std::array<std::pair<Enum, std::string_view>, N>;

constexpr Words<PaneDevice, 4> kDevices{{{PaneDevice::off, "off"},
                                         {PaneDevice::cpu, "cpu"},
                                         {PaneDevice::gpu, "gpu"},
                                         {PaneDevice::raster, "raster"}}};
constexpr Words<PaneContent, 3> kContents{{{PaneContent::picture, "picture"},
                                           {PaneContent::heatmap, "heatmap"},
                                           {PaneContent::difference, "difference"}}};
constexpr Words<SizeChoice, 6> kSizes{{{SizeChoice::square_256, "256"},
                                       {SizeChoice::square_512, "512"},
                                       {SizeChoice::square_768, "768"},
                                       {SizeChoice::square_1024, "1024"},
                                       {SizeChoice::window, "window"},
                                       {SizeChoice::custom, "custom"}}};
constexpr Words<OverlayColor, 5> kColors{{{OverlayColor::depth, "depth"},
                                          {OverlayColor::leaf_size, "leaf-size"},
                                          {OverlayColor::sah, "sah"},
                                          {OverlayColor::overlap, "overlap"},
                                          {OverlayColor::decay, "decay"}}};
constexpr Words<HiddenLines, 3> kHidden{{{HiddenLines::hidden, "hidden"},
                                         {HiddenLines::dimmed, "dimmed"},
                                         {HiddenLines::x_ray, "x-ray"}}};
constexpr Words<HeatmapCost, 4> kCosts{{{HeatmapCost::steps, "steps"},
                                        {HeatmapCost::triangle_tests, "triangle-tests"},
                                        {HeatmapCost::box_tests, "box-tests"},
                                        {HeatmapCost::energy, "energy"}}};
constexpr Words<EnergySettings::From, 3> kFroms{{{EnergySettings::From::automatic, "automatic"},
                                                 {EnergySettings::From::chosen, "chosen"},
                                                 {EnergySettings::From::model, "model"}}};

template <class Enum, std::size_t N>
std::string_view word_of(const Words<Enum, N>& words, Enum value) {
  for (const auto& [candidate, word] : words) {
    if (candidate == value) return word;
  }
  return "unknown";
}

template <class Enum, std::size_t N>
std::optional<Enum> value_of(const Words<Enum, N>& words, std::string_view text) {
  for (const auto& [value, word] : words) {
    if (word == text) return value;
  }
  return std::nullopt;
}

}  // namespace

Settings default_settings() {
  Settings settings;
  settings.panes[1].device = PaneDevice::gpu;
  return settings;
}

std::string_view to_string(PaneDevice device) {
  return word_of(kDevices, device);
}
std::string_view to_string(PaneContent content) {
  return word_of(kContents, content);
}
std::string_view to_string(SizeChoice size) {
  return word_of(kSizes, size);
}
std::string_view to_string(OverlayColor color) {
  return word_of(kColors, color);
}
std::string_view to_string(HiddenLines hidden) {
  return word_of(kHidden, hidden);
}
std::string_view to_string(HeatmapCost cost) {
  return word_of(kCosts, cost);
}
std::string_view to_string(EnergySettings::From from) {
  return word_of(kFroms, from);
}

std::optional<PaneDevice> parse_pane_device(std::string_view word) {
  return value_of(kDevices, word);
}
std::optional<PaneContent> parse_pane_content(std::string_view word) {
  return value_of(kContents, word);
}
std::optional<SizeChoice> parse_size_choice(std::string_view word) {
  return value_of(kSizes, word);
}
std::optional<OverlayColor> parse_overlay_color(std::string_view word) {
  return value_of(kColors, word);
}
std::optional<HiddenLines> parse_hidden_lines(std::string_view word) {
  return value_of(kHidden, word);
}
std::optional<HeatmapCost> parse_heatmap_cost(std::string_view word) {
  return value_of(kCosts, word);
}
std::optional<EnergySettings::From> parse_energy_from(std::string_view word) {
  return value_of(kFroms, word);
}

}  // namespace encore::ui
