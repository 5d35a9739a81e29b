#pragma once

#include <cstddef>
#include <cstdint>

namespace encore::ui {

/// What a colour stands for, the same in every plot.
enum class PlotColor : std::uint8_t {
  build,
  update,
  transfer,
  render,
  animate,
  idle,
  remainder,
  cpu,
  gpu,
  raster,
  shadow_rays,  ///< parts of render, whose blue is that of the camera's rays
  reflection_rays,
  refraction_rays,
};
inline constexpr std::size_t kPlotColorCount = 13;

/// Red, green, blue in [0, 1].
struct Rgb {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
};

/// The colour on a dark or a light ground. After the palette of Okabe and Ito (Color Universal
/// Design, 2008), whose hues people with any colour vision tell apart, made lighter or darker so
/// that every one of them stands out from the ground.
Rgb plot_rgb(PlotColor color, bool dark);
/// The colour of the nth series that has none of its own.
PlotColor series_color(std::size_t index);

/// A colour as Dear ImGui packs it, for the ground of its current style.
std::uint32_t plot_color(PlotColor color, float alpha = 1.0F);
/// Whether the current style has a dark ground.
bool dark_style();
/// Text, frame and grid of the current style.
std::uint32_t text_color(float alpha = 1.0F);
std::uint32_t frame_color();
std::uint32_t grid_color(bool major);
std::uint32_t ground_color();
/// What draws attention: a target, a selection.
std::uint32_t accent_color(float alpha = 1.0F);

}  // namespace encore::ui
