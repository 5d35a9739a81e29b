#include "renderer/heatmap.h"

#include "renderer/heatmap_palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using namespace encore;
using renderer::cost_statistics;
using renderer::draw_heatmap;
using renderer::HeatmapQuantity;
using renderer::palette_color;

/// OKLab coordinates of a linear colour, by the forward matrices (the palette uses the inverses).
glm::dvec3 oklab(const glm::vec3& c) {
  const double l = std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
  const double m = std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
  const double s = std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

std::vector<accel::TraceCounters> ramp(std::uint32_t count) {
  std::vector<accel::TraceCounters> counters;
  for (std::uint32_t i = 1; i <= count; ++i) counters.push_back({i, 1000 + i, 7});
  return counters;
}

TEST(Heatmap, EqualStepsOfThePaletteLookEquallyLarge) {
  double smallest = 1e9;
  double largest = 0.0;
  for (int i = 1; i < 256; ++i) {
    const glm::dvec3 before = oklab(palette_color((i - 1) / 255.0));
    const glm::dvec3 after = oklab(palette_color(i / 255.0));
    EXPECT_GT(after.x, before.x) << "lightness must grow at " << i;
    const glm::dvec3 d = after - before;
    const double step = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    smallest = std::min(smallest, step);
    largest = std::max(largest, step);
  }
  EXPECT_LT(largest / smallest, 1.02);
}

TEST(Heatmap, ThePaletteClamps) {
  EXPECT_EQ(palette_color(-1.0), palette_color(0.0));
  EXPECT_EQ(palette_color(std::numeric_limits<double>::quiet_NaN()), palette_color(0.0));
  EXPECT_EQ(palette_color(7.0), palette_color(1.0));
}

TEST(HeatmapPalette, EveryPaletteHasItsNameAndShownColours) {
  for (const renderer::Palette palette : renderer::kPalettes) {
    EXPECT_EQ(renderer::parse_palette(renderer::to_string(palette)), palette);
    const auto colors = renderer::palette_colors(palette);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(colors[i][c], 0.0F);
        EXPECT_LE(colors[i][c], 1.0F);
      }
      EXPECT_EQ(renderer::palette_codes(palette)[i], renderer::rgba8_of(colors[i]));
    }
    // No two neighbours are far apart: a step is never a border.
    for (std::size_t i = 1; i < colors.size(); ++i) {
      const glm::dvec3 d = oklab(colors[i]) - oklab(colors[i - 1]);
      EXPECT_LT(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), 0.03)
          << renderer::to_string(palette) << ' ' << i;
    }
  }
  EXPECT_FALSE(renderer::parse_palette("plaid").has_value());
  EXPECT_EQ(renderer::palette_color(renderer::Palette::helix, 0.3), palette_color(0.3));
}

TEST(HeatmapPalette, GreyIsEvenAndWithoutColour) {
  const auto colors = renderer::palette_colors(renderer::Palette::grey);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const glm::dvec3 lab = oklab(colors[i]);
    EXPECT_NEAR(lab.x, static_cast<double>(i) / 255.0, 1e-4);
    EXPECT_LT(std::hypot(lab.y, lab.z), 1e-4);
  }
}

TEST(HeatmapPalette, DivergingIsLightestInTheMiddleAndAlikeOnBothSides) {
  const auto colors = renderer::palette_colors(renderer::Palette::diverging);
  for (std::size_t i = 1; i <= 127; ++i) {
    EXPECT_GT(oklab(colors[i]).x, oklab(colors[i - 1]).x);
    EXPECT_NEAR(oklab(colors[i]).x, oklab(colors[255 - i]).x, 1e-4);
  }
  EXPECT_GT(colors[0].b, 2.0F * colors[0].r);
  EXPECT_GT(colors[255].r, 2.0F * colors[255].b);
}

TEST(Heatmap, StatisticsAreThoseOfTheChosenQuantity) {
  const auto counters = ramp(1000);
  const auto steps = cost_statistics(counters, HeatmapQuantity::steps);
  EXPECT_EQ(steps.min, 1U);
  EXPECT_EQ(steps.median, 500U);
  EXPECT_EQ(steps.percentile_99, 990U);
  EXPECT_EQ(steps.max, 1000U);
  EXPECT_EQ(steps.mean, 500.5);
  EXPECT_EQ(cost_statistics(counters, HeatmapQuantity::box_tests).median, 1500U);
  const auto tests = cost_statistics(counters, HeatmapQuantity::triangle_tests);
  EXPECT_EQ(tests.min, 7U);
  EXPECT_EQ(tests.max, 7U);
  EXPECT_EQ(cost_statistics({}, HeatmapQuantity::steps).max, 0U);
}

TEST(Heatmap, TheScaleEndsAtThe99thPercentile) {
  const auto counters = ramp(1000);
  renderer::Image image;
  image.resize(50, 20);
  const auto statistics = draw_heatmap(counters, HeatmapQuantity::steps, image);
  EXPECT_EQ(statistics.percentile_99, 990U);
  EXPECT_EQ(image.pixels[494], palette_color(495.0 / 990.0));
  EXPECT_EQ(image.pixels[989], palette_color(1.0));
  EXPECT_EQ(image.pixels[999], palette_color(1.0));
  EXPECT_NE(image.pixels[0], image.pixels[989]);
}

TEST(Heatmap, RareCostsStandOutOfNothing) {
  std::vector<accel::TraceCounters> counters(400);
  counters[17].steps = 3;
  renderer::Image image;
  image.resize(20, 20);
  draw_heatmap(counters, HeatmapQuantity::steps, image);
  EXPECT_EQ(image.pixels[17], palette_color(1.0));
  EXPECT_EQ(image.pixels[18], palette_color(0.0));
}

TEST(Heatmap, SizesMustAgreeAndNamesAreKnown) {
  renderer::Image image;
  image.resize(3, 3);
  EXPECT_THROW(draw_heatmap(ramp(8), HeatmapQuantity::steps, image), std::invalid_argument);
  for (const auto quantity :
       {HeatmapQuantity::steps, HeatmapQuantity::triangle_tests, HeatmapQuantity::box_tests}) {
    EXPECT_EQ(renderer::parse_heatmap_quantity(renderer::to_string(quantity)), quantity);
  }
  EXPECT_FALSE(renderer::parse_heatmap_quantity("heat").has_value());
}

}  // namespace
