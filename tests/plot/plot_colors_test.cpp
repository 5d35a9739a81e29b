// Colours stand out from the ground, and from each other for any kind of colour vision.
#include "ui/plot/plot_colors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using namespace encore::ui;

double linear(float channel) {
  const double c = static_cast<double>(channel);
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double luminance(const Rgb& c) {
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

/// Contrast as the WCAG defines it.
double contrast(double a, double b) {
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

TEST(PlotColors, StandOutFromTheGround) {
  for (std::size_t i = 0; i < kPlotColorCount; ++i) {
    const auto color = static_cast<PlotColor>(i);
    EXPECT_GE(contrast(luminance(plot_rgb(color, true)), 0.01), 3.0) << i;
    EXPECT_GE(contrast(luminance(plot_rgb(color, false)), 0.94), 2.5) << i;
  }
}

/// Red and green seen as one: the mean that people without red or green cones are left with, after
/// Vienot, Brettel and Mollon (1999), for linear RGB.
std::array<double, 3> seen(const Rgb& c, int kind) {
  const double r = linear(c.r);
  const double g = linear(c.g);
  const double b = linear(c.b);
  if (kind == 0) return {r, g, b};
  const double mixed = kind == 1 ? 0.11238 * r + 0.88762 * g : 0.29275 * r + 0.70725 * g;
  const double blue = kind == 1 ? 0.00401 * (r - g) + b : -0.02234 * (r - g) + b;
  return {mixed, mixed, blue};
}

TEST(PlotColors, PhasesOfOneStackDiffer) {
  constexpr std::array kStack{PlotColor::build, PlotColor::update, PlotColor::transfer,
                              PlotColor::render, PlotColor::animate};
  for (const bool dark : {true, false}) {
    for (int kind = 0; kind < 3; ++kind) {
      for (std::size_t i = 0; i < kStack.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const auto a = seen(plot_rgb(kStack[i], dark), kind);
          const auto b = seen(plot_rgb(kStack[j], dark), kind);
          const double apart =
              std::hypot(std::cbrt(a[0]) - std::cbrt(b[0]), std::cbrt(a[1]) - std::cbrt(b[1]),
                         std::cbrt(a[2]) - std::cbrt(b[2]));
          EXPECT_GT(apart, 0.08) << "colours " << i << " and " << j << ", vision " << kind
                                 << (dark ? ", dark" : ", light");
        }
      }
    }
  }
}

}  // namespace
