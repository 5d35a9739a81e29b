#include "ui/style.h"

#include <algorithm>
#include <cmath>

namespace encore::ui {

namespace {

ImVec4 rgb(unsigned hex, float alpha = 1.0F) {
  return {static_cast<float>((hex >> 16U) & 0xFFU) / 255.0F,
          static_cast<float>((hex >> 8U) & 0xFFU) / 255.0F,
          static_cast<float>(hex & 0xFFU) / 255.0F, alpha};
}

ImVec4 faded(ImVec4 color, float alpha) {
  color.w = alpha;
  return color;
}

const ThemeColors kDark{.background = rgb(0x1B1E24),
                        .canvas = rgb(0x121419),
                        .text = rgb(0xDEE2E8),
                        .dim_text = rgb(0x9AA3B0),
                        .accent = rgb(0x5FA8D8),
                        .good = rgb(0x6CC58B),
                        .warning = rgb(0xE3B15B),
                        .problem = rgb(0xF0817A),
                        .measured = rgb(0x6CC58B),
                        .modelled = rgb(0xE3B15B),
                        .simulated = rgb(0xB89BEA),
                        .unavailable = rgb(0x9AA3B0)};
const ThemeColors kLight{.background = rgb(0xFAFAFB),
                         .canvas = rgb(0xDFE2E7),
                         .text = rgb(0x1E232B),
                         .dim_text = rgb(0x5A6370),
                         .accent = rgb(0x1F6FA8),
                         .good = rgb(0x1E7A3D),
                         .warning = rgb(0x8F5F00),
                         .problem = rgb(0xB3261E),
                         .measured = rgb(0x1E7A3D),
                         .modelled = rgb(0x8F5F00),
                         .simulated = rgb(0x6C3FC0),
                         .unavailable = rgb(0x5A6370)};

/// The greys of frames and lines, from the background towards the text.
struct Greys {
  ImVec4 raised, frame, frame_hovered, frame_active, line, menu;
};
const Greys kDarkGreys{rgb(0x22262E), rgb(0x2A2F39), rgb(0x343B47),
                       rgb(0x3E4754), rgb(0x353B46), rgb(0x171A1F)};
const Greys kLightGreys{rgb(0xFFFFFF), rgb(0xE0E4EA), rgb(0xD5DBE3),
                        rgb(0xC6CED8), rgb(0xC2C9D2), rgb(0xEEF0F3)};

void set_surfaces(ImVec4* to, const ThemeColors& colors, const Greys& greys) {
  to[ImGuiCol_Text] = colors.text;
  to[ImGuiCol_TextDisabled] = colors.dim_text;
  to[ImGuiCol_WindowBg] = colors.background;
  to[ImGuiCol_ChildBg] = rgb(0, 0.0F);
  to[ImGuiCol_PopupBg] = greys.raised;
  to[ImGuiCol_Border] = greys.line;
  to[ImGuiCol_BorderShadow] = rgb(0, 0.0F);
  to[ImGuiCol_FrameBg] = greys.frame;
  to[ImGuiCol_FrameBgHovered] = greys.frame_hovered;
  to[ImGuiCol_FrameBgActive] = greys.frame_active;
  to[ImGuiCol_TitleBg] = greys.menu;
  to[ImGuiCol_TitleBgActive] = greys.frame;
  to[ImGuiCol_TitleBgCollapsed] = greys.menu;
  to[ImGuiCol_MenuBarBg] = greys.menu;
  to[ImGuiCol_ScrollbarBg] = rgb(0, 0.0F);
  to[ImGuiCol_ScrollbarGrab] = greys.frame_active;
  to[ImGuiCol_ScrollbarGrabHovered] = faded(colors.dim_text, 0.7F);
  to[ImGuiCol_ScrollbarGrabActive] = colors.dim_text;
  to[ImGuiCol_Separator] = greys.line;
  to[ImGuiCol_TableHeaderBg] = greys.frame;
  to[ImGuiCol_TableBorderStrong] = greys.line;
  to[ImGuiCol_TableBorderLight] = faded(greys.line, 0.6F);
  to[ImGuiCol_TableRowBg] = rgb(0, 0.0F);
  to[ImGuiCol_TableRowBgAlt] = faded(greys.frame, 0.45F);
  to[ImGuiCol_ModalWindowDimBg] = rgb(0x05070A, 0.45F);
}

void set_controls(ImVec4* to, const ThemeColors& colors, const Greys& greys) {
  to[ImGuiCol_CheckMark] = colors.accent;
  to[ImGuiCol_SliderGrab] = faded(colors.accent, 0.85F);
  to[ImGuiCol_SliderGrabActive] = colors.accent;
  to[ImGuiCol_Button] = greys.frame;
  to[ImGuiCol_ButtonHovered] = greys.frame_hovered;
  to[ImGuiCol_ButtonActive] = greys.frame_active;
  to[ImGuiCol_Header] = faded(colors.accent, 0.22F);
  to[ImGuiCol_HeaderHovered] = faded(colors.accent, 0.30F);
  to[ImGuiCol_HeaderActive] = faded(colors.accent, 0.40F);
  to[ImGuiCol_SeparatorHovered] = faded(colors.accent, 0.6F);
  to[ImGuiCol_SeparatorActive] = colors.accent;
  to[ImGuiCol_ResizeGrip] = rgb(0, 0.0F);
  to[ImGuiCol_ResizeGripHovered] = faded(colors.accent, 0.5F);
  to[ImGuiCol_ResizeGripActive] = colors.accent;
  to[ImGuiCol_Tab] = greys.menu;
  to[ImGuiCol_TabHovered] = greys.frame_hovered;
  to[ImGuiCol_TabActive] = greys.frame;
  to[ImGuiCol_TabUnfocused] = greys.menu;
  to[ImGuiCol_TabUnfocusedActive] = greys.frame;
  to[ImGuiCol_PlotLines] = colors.accent;
  to[ImGuiCol_PlotLinesHovered] = colors.warning;
  to[ImGuiCol_PlotHistogram] = faded(colors.accent, 0.75F);
  to[ImGuiCol_PlotHistogramHovered] = colors.accent;
  to[ImGuiCol_TextSelectedBg] = faded(colors.accent, 0.35F);
  to[ImGuiCol_DragDropTarget] = colors.warning;
  to[ImGuiCol_NavHighlight] = colors.accent;
  to[ImGuiCol_NavWindowingHighlight] = colors.accent;
  to[ImGuiCol_NavWindowingDimBg] = rgb(0x05070A, 0.3F);
}

void set_sizes(ImGuiStyle& style) {
  style.WindowPadding = {8.0F, 8.0F};
  style.FramePadding = {6.0F, 3.0F};
  style.ItemSpacing = {7.0F, 5.0F};
  style.ItemInnerSpacing = {5.0F, 4.0F};
  style.CellPadding = {5.0F, 2.0F};
  style.IndentSpacing = 16.0F;
  style.ScrollbarSize = 11.0F;
  style.GrabMinSize = 10.0F;
  style.WindowRounding = 4.0F;
  style.ChildRounding = 4.0F;
  style.FrameRounding = 4.0F;
  style.PopupRounding = 4.0F;
  style.ScrollbarRounding = 4.0F;
  style.GrabRounding = 4.0F;
  style.TabRounding = 4.0F;
  style.WindowTitleAlign = {0.0F, 0.5F};
  style.WindowMenuButtonPosition = ImGuiDir_None;
}

}  // namespace

const ThemeColors& theme_colors(Theme theme) {
  return theme == Theme::dark ? kDark : kLight;
}

ImVec4 origin_color(Theme theme, energy::Origin origin) {
  const ThemeColors& colors = theme_colors(theme);
  switch (origin) {
    case energy::Origin::measured:
      return colors.measured;
    case energy::Origin::modelled:
      return colors.modelled;
    case energy::Origin::simulated:
      return colors.simulated;
    case energy::Origin::unavailable:
      break;
  }
  return colors.unavailable;
}

void apply_style(Theme theme, float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_sizes(style);
  const Greys& greys = theme == Theme::dark ? kDarkGreys : kLightGreys;
  set_surfaces(style.Colors, theme_colors(theme), greys);
  set_controls(style.Colors, theme_colors(theme), greys);
  style.ScaleAllSizes(scale);
  // Hair lines stay one pixel.
  style.WindowBorderSize = 1.0F;
  style.ChildBorderSize = 1.0F;
  style.PopupBorderSize = 1.0F;
  style.FrameBorderSize = 0.0F;
}

float ui_scale(const Preferences& preferences, float monitor_scale) {
  const float wanted = preferences.ui_scale > 0.0F ? preferences.ui_scale : monitor_scale;
  if (!std::isfinite(wanted) || wanted <= 0.0F) return 1.0F;
  return std::clamp(wanted, kSmallestScale, kLargestScale);
}

float next_scale(float scale, int direction) {
  // A hair more or less than a quarter counts as the quarter.
  const float quarters = scale * 4.0F;
  const float next =
      direction > 0 ? std::floor(quarters + 0.01F) + 1.0F : std::ceil(quarters - 0.01F) - 1.0F;
  return std::clamp(next / 4.0F, kSmallestScale, kLargestScale);
}

}  // namespace encore::ui
