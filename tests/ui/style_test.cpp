// Colours that can be read, scales within their limits, fonts with the signs of units.
#include "ui/style.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace encore;
using namespace encore::ui;

/// Relative luminance and contrast as WCAG 2.1 defines them.
double luminance(const ImVec4& c) {
  const auto linear = [](double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z);
}
double contrast(const ImVec4& a, const ImVec4& b) {
  const double x = luminance(a);
  const double y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(Style, WordsCanBeRead) {
  for (const Theme theme : {Theme::dark, Theme::light}) {
    const ThemeColors& colors = theme_colors(theme);
    for (const ImVec4& color :
         {colors.text, colors.dim_text, colors.accent, colors.good, colors.warning, colors.problem,
          colors.measured, colors.modelled, colors.simulated, colors.unavailable}) {
      EXPECT_GE(contrast(color, colors.background), 4.5);
    }
    EXPECT_GE(contrast(colors.text, colors.background), 10.0);
  }
}

TEST(Style, ScaleIsThePreferenceElseTheMonitors) {
  Preferences preferences;
  EXPECT_EQ(ui_scale(preferences, 1.5F), 1.5F);
  EXPECT_EQ(ui_scale(preferences, std::numeric_limits<float>::quiet_NaN()), 1.0F);
  preferences.ui_scale = 2.0F;
  EXPECT_EQ(ui_scale(preferences, 1.5F), 2.0F);
  preferences.ui_scale = 9.0F;
  EXPECT_EQ(ui_scale(preferences, 1.5F), kLargestScale);
}

TEST(Style, StepsOfTheScaleAreQuarters) {
  EXPECT_EQ(next_scale(1.0F, 1), 1.25F);
  EXPECT_EQ(next_scale(1.3F, -1), 1.25F);
  EXPECT_EQ(next_scale(0.75F, -1), 0.75F);
  EXPECT_EQ(next_scale(3.0F, 1), 3.0F);
}

TEST(Style, FontsHaveTheSignsOfUnits) {
  ImGui::CreateContext();
  const FontReport report = rebuild_fonts(1.0F);
  ASSERT_EQ(ImGui::GetIO().Fonts->Fonts.Size, 3);
  EXPECT_TRUE(ImGui::GetIO().Fonts->IsBuilt());
  if (report.complete()) {
    EXPECT_EQ(ImGui::GetIO().Fonts->Fonts[0]->FontSize, 15.0F);
    for (const ImWchar sign : {L'µ', L'μ', L'Δ', L'±', L'²', L'×', L'·', L'…', L'→', L'≤', L'−'}) {
      EXPECT_NE(ImGui::GetIO().Fonts->Fonts[0]->FindGlyphNoFallback(sign), nullptr) << sign;
      EXPECT_NE(ImGui::GetIO().Fonts->Fonts[1]->FindGlyphNoFallback(sign), nullptr) << sign;
    }
  }
  rebuild_fonts(3.0F);
  EXPECT_LE(ImGui::GetIO().Fonts->TexHeight, 8192);
  ImGui::DestroyContext();
}

TEST(Style, SetsEveryColour) {
  ImGui::CreateContext();
  for (const Theme theme : {Theme::dark, Theme::light}) {
    apply_style(theme, 2.0F);
    const ImGuiStyle& style = ImGui::GetStyle();
    EXPECT_EQ(style.FrameRounding, 8.0F);
    EXPECT_EQ(style.WindowBorderSize, 1.0F);
    EXPECT_EQ(style.Colors[ImGuiCol_Text].x, theme_colors(theme).text.x);
  }
  ImGui::DestroyContext();
}

}  // namespace
