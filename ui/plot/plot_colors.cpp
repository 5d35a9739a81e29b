#include "ui/plot/plot_colors.h"

#include <imgui.h>

#include <array>

namespace encore::ui {

namespace {

struct Pair {
  Rgb dark;
  Rgb light;
};

constexpr Rgb rgb(std::uint32_t hex) {
  return {static_cast<float>((hex >> 16U) & 255U) / 255.0F,
          static_cast<float>((hex >> 8U) & 255U) / 255.0F, static_cast<float>(hex & 255U) / 255.0F};
}

constexpr std::array<Pair, kPlotColorCount> kColors{{
    {rgb(0xE69F00), rgb(0xD08A00)},  // build: orange
    {rgb(0xF0E442), rgb(0x8F8500)},  // update: yellow
    {rgb(0xE08CBF), rgb(0xCC6FA6)},  // transfer: reddish purple
    {rgb(0x4FA8E0), rgb(0x0072B2)},  // render: blue
    {rgb(0x00B283), rgb(0x00855F)},  // animate: bluish green
    {rgb(0x9A9A9A), rgb(0x808080)},  // idle: grey
    {rgb(0xC4C4C4), rgb(0x5A5A5A)},  // remainder: grey of another lightness
    {rgb(0x56B4E9), rgb(0x1C78B8)},  // cpu: sky blue
    {rgb(0xF07840), rgb(0xC84E00)},  // gpu: vermilion
    {rgb(0x2CC79A), rgb(0x00795A)},  // raster: green
    {rgb(0x2F78B8), rgb(0x003F6B)},  // shadow rays: render's blue, darker
    {rgb(0x8CCBF2), rgb(0x3E86BE)},  // reflection rays: lighter
    {rgb(0xC4E4FA), rgb(0x6E9CC0)},  // refraction rays: lighter still
}};

std::uint32_t pack(const Rgb& c, float alpha) {
  return ImGui::GetColorU32(ImVec4(c.r, c.g, c.b, alpha));
}

}  // namespace

Rgb plot_rgb(PlotColor color, bool dark) {
  const Pair& pair = kColors.at(static_cast<std::size_t>(color));
  return dark ? pair.dark : pair.light;
}

PlotColor series_color(std::size_t index) {
  constexpr std::array kOrder{PlotColor::cpu,      PlotColor::gpu,      PlotColor::raster,
                              PlotColor::build,    PlotColor::transfer, PlotColor::update,
                              PlotColor::remainder};
  return kOrder.at(index % kOrder.size());
}

std::uint32_t plot_color(PlotColor color, float alpha) {
  return pack(plot_rgb(color, dark_style()), alpha);
}

bool dark_style() {
  const ImVec4& ground = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  return 0.2126F * ground.x + 0.7152F * ground.y + 0.0722F * ground.z < 0.5F;
}

std::uint32_t text_color(float alpha) {
  return ImGui::GetColorU32(ImGuiCol_Text, alpha);
}

std::uint32_t frame_color() {
  return text_color(0.45F);
}

std::uint32_t grid_color(bool major) {
  return text_color(major ? 0.13F : 0.06F);
}

std::uint32_t ground_color() {
  // A little off the window's ground, towards white: the data stand on paper.
  return dark_style() ? IM_COL32(0, 0, 0, 64) : IM_COL32(255, 255, 255, 160);
}

std::uint32_t accent_color(float alpha) {
  return pack(dark_style() ? rgb(0xFF5C6C) : rgb(0xC81E3A), alpha);
}

}  // namespace encore::ui
