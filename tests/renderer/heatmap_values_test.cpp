// Values of heatmaps: counts and modelled joules, their statistics, ranges, colours, histograms.

#include "renderer/heatmap_values.h"

#include "renderer/heatmap_style.h"
#include "renderer/image_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

using namespace encore;
using renderer::CostWeights;
using renderer::HeatmapQuantity;
using renderer::HeatmapRange;
using renderer::HeatmapScale;
using renderer::HeatmapStyle;
using renderer::HeatmapValues;

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

std::vector<accel::TraceCounters> random_counters(std::size_t count) {
  std::mt19937 random(11);
  std::vector<accel::TraceCounters> counters;
  for (std::size_t i = 0; i < count; ++i) {
    counters.push_back({static_cast<std::uint32_t>(random() % 90),
                        static_cast<std::uint32_t>(random() % 200),
                        static_cast<std::uint32_t>(random() % 30)});
  }
  return counters;
}

TEST(HeatmapValues, CountsAreTheQuantitysWithItsUnit) {
  const std::vector<accel::TraceCounters> counters = {{3, 5, 7}, {0, 1, 2}};
  EXPECT_EQ(renderer::count_values(counters, HeatmapQuantity::steps).values,
            (std::vector<float>{3, 0}));
  const HeatmapValues boxes = renderer::count_values(counters, HeatmapQuantity::box_tests);
  EXPECT_EQ(boxes.values, (std::vector<float>{5, 1}));
  EXPECT_EQ(boxes.unit, "box tests");
  EXPECT_EQ(renderer::count_values(counters, HeatmapQuantity::triangle_tests).unit,
            "triangle tests");
  EXPECT_THROW(renderer::count_values(counters, HeatmapQuantity::energy), std::invalid_argument);
  EXPECT_THROW(renderer::cost_statistics(counters, HeatmapQuantity::energy), std::invalid_argument);
  EXPECT_EQ(renderer::to_string(HeatmapQuantity::energy), "energy");
  EXPECT_FALSE(renderer::parse_heatmap_quantity("energy").has_value()) << "it needs weights";
}

TEST(HeatmapValues, EnergyIsTheWeightedSum) {
  const std::vector<accel::TraceCounters> counters = {{3, 5, 7}, {0, 0, 0}};
  const HeatmapValues found =
      renderer::energy_values(counters, {1e-9, 2e-9, 4e-9}, "modelled: constants of a test");
  EXPECT_FLOAT_EQ(found.values[0], 41e-9F);
  EXPECT_EQ(found.values[1], 0.0F);
  EXPECT_EQ(found.unit, "J");
  EXPECT_EQ(found.provenance, "modelled: constants of a test");
}

TEST(HeatmapValues, AFramesJoulesAreSharedOutWhole) {
  const auto counters = random_counters(5000);
  for (const double size : {1e-300, 1.0, 1e300}) {
    const auto found =
        renderer::shared_energy_values(counters, {size, 2 * size, 3 * size}, 0.25, "measured");
    ASSERT_TRUE(found.has_value());
    const double sum = std::accumulate(found->values.begin(), found->values.end(), 0.0);
    EXPECT_NEAR(sum, 0.25, 1e-6);
    const auto weighted = [&](std::size_t i) {
      return counters[i].steps + 2.0 * counters[i].box_tests + 3.0 * counters[i].triangle_tests;
    };
    EXPECT_NEAR(static_cast<double>(found->values[7]) / static_cast<double>(found->values[8]),
                weighted(7) / weighted(8), 1e-5);
    EXPECT_EQ(found->provenance, "measured");
  }
  const std::vector<accel::TraceCounters> idle(4);
  EXPECT_FALSE(renderer::shared_energy_values(idle, {1, 1, 1}, 0.25, "").has_value());
}

TEST(HeatmapValues, WeightsThatMeanNothingAreRefused) {
  const auto counters = random_counters(3);
  for (const CostWeights& weights :
       {CostWeights{}, CostWeights{-1.0, 1.0, 1.0}, CostWeights{1.0, HUGE_VAL, 1.0},
        CostWeights{1.0, 1.0, std::nan("")}}) {
    EXPECT_THROW(renderer::energy_values(counters, weights, ""), std::invalid_argument);
    EXPECT_THROW(renderer::shared_energy_values(counters, weights, 1.0, ""), std::invalid_argument);
  }
  EXPECT_THROW(renderer::shared_energy_values(counters, {1, 1, 1}, -1.0, ""),
               std::invalid_argument);
}

TEST(HeatmapValues, StatisticsLeaveOutWhatIsNotKnown) {
  std::vector<float> values;
  for (int i = 1; i <= 200; ++i) values.push_back(0.5F * static_cast<float>(i));
  values.insert(values.begin(), {kNan, -1.0F, kInf});
  const auto found = renderer::value_statistics(values);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->count, 201U);
  EXPECT_EQ(found->missing, 2U);
  EXPECT_EQ(found->min, -1.0F);
  EXPECT_EQ(found->median, 50.0F);
  EXPECT_EQ(found->percentile_99, 99.0F);
  EXPECT_EQ(found->max, 100.0F);
  EXPECT_EQ(found->sum, 10049.0);
  EXPECT_EQ(found->mean, 10049.0 / 201.0);
  EXPECT_EQ(found->smallest_positive, 0.5F);
  EXPECT_FALSE(renderer::value_statistics(std::vector<float>{kNan}).has_value());
  EXPECT_FALSE(renderer::value_statistics({}).has_value());
}

TEST(HeatmapStyle, TheDefaultIsThePictureOfTheCounters) {
  const auto counters = random_counters(600);
  renderer::Image counted, valued;
  counted.resize(30, 20);
  valued.resize(30, 20);
  for (const auto quantity :
       {HeatmapQuantity::steps, HeatmapQuantity::triangle_tests, HeatmapQuantity::box_tests}) {
    renderer::draw_heatmap(counters, quantity, counted);
    const auto values = renderer::count_values(counters, quantity).values;
    HeatmapStyle style;
    style.range = renderer::default_range(*renderer::value_statistics(values));
    renderer::draw_heatmap(values, style, valued);
    EXPECT_EQ(valued.pixels, counted.pixels);
  }
}

TEST(HeatmapStyle, BytesAreTheImagesCodes) {
  std::vector<float> values = {kNan, -5.0F, 0.0F, 0.25F, 1.0F, 2.0F, 9.0F, kInf};
  HeatmapStyle style;
  style.range = {0.0, 2.0, HeatmapScale::linear};
  style.below = glm::vec3(0.0F, 0.0F, 1.0F);
  style.above = glm::vec3(1.0F, 0.0F, 1.0F);
  style.missing = glm::vec3(0.5F);
  for (const renderer::Palette palette : renderer::kPalettes) {
    style.palette = palette;
    renderer::Image image;
    image.resize(8, 1);
    renderer::draw_heatmap(values, style, image);
    std::vector<std::uint8_t> rgba(32);
    renderer::draw_heatmap(values, style, rgba);
    for (std::size_t i = 0; i < 8; ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(rgba[4 * i + static_cast<std::size_t>(c)],
                  renderer::to_srgb8(image.pixels[i][c]));
      }
      EXPECT_EQ(rgba[4 * i + 3], 255);
    }
    EXPECT_EQ(image.pixels[0], style.missing);
    EXPECT_EQ(image.pixels[1], *style.below);
    EXPECT_EQ(image.pixels[2], renderer::palette_color(palette, 0.0));
    EXPECT_EQ(image.pixels[4], renderer::palette_color(palette, 0.5));
    EXPECT_EQ(image.pixels[5], renderer::palette_color(palette, 1.0));
    EXPECT_EQ(image.pixels[6], *style.above);
    EXPECT_EQ(image.pixels[7], *style.above);
  }
  std::vector<std::uint8_t> few(31);
  EXPECT_THROW(renderer::draw_heatmap(values, style, few), std::invalid_argument);
}

TEST(HeatmapStyle, PlacesFollowTheScale) {
  const HeatmapRange linear{10.0, 20.0, HeatmapScale::linear};
  EXPECT_EQ(renderer::heatmap_place(linear, 10.0), 0.0);
  EXPECT_EQ(renderer::heatmap_place(linear, 15.0), 0.5);
  EXPECT_EQ(renderer::heatmap_place(linear, 20.0), 1.0);
  EXPECT_LT(renderer::heatmap_place(linear, 9.999), 0.0);
  EXPECT_GT(renderer::heatmap_place(linear, std::nextafter(20.0, 21.0)), 1.0);
  EXPECT_TRUE(std::isnan(renderer::heatmap_place(linear, std::nan(""))));
  const HeatmapRange decades{1e-9, 1e-5, HeatmapScale::logarithmic};
  EXPECT_NEAR(renderer::heatmap_place(decades, 1e-7), 0.5, 1e-12);
  EXPECT_EQ(renderer::heatmap_place(decades, 1e-5), 1.0);
  EXPECT_LT(renderer::heatmap_place(decades, 0.0), 0.0);
  EXPECT_LT(renderer::heatmap_place(decades, -3.0), 0.0);
  const HeatmapRange point{2.0, 2.0, HeatmapScale::linear};
  EXPECT_EQ(renderer::heatmap_place(point, 2.0), 0.0);
  EXPECT_GT(renderer::heatmap_place(point, 2.5), 1.0);
  EXPECT_LT(renderer::heatmap_place(point, 1.5), 0.0);
  for (const HeatmapRange& bad : {HeatmapRange{2.0, 1.0, HeatmapScale::linear},
                                  HeatmapRange{0.0, 1.0, HeatmapScale::logarithmic},
                                  HeatmapRange{0.0, HUGE_VAL, HeatmapScale::linear}}) {
    EXPECT_THROW(renderer::heatmap_place(bad, 1.0), std::invalid_argument);
  }
}

TEST(HeatmapStyle, DefaultRangesFitTheirScale) {
  const std::vector<float> costs = {0.0F, 4.0F, 8.0F, 2.0F};
  const auto statistics = renderer::value_statistics(costs);
  EXPECT_EQ(renderer::default_range(*statistics).low, 0.0);
  EXPECT_EQ(renderer::default_range(*statistics).high, 8.0);
  const HeatmapRange decades = renderer::default_range(*statistics, HeatmapScale::logarithmic);
  EXPECT_EQ(decades.low, 2.0);
  EXPECT_EQ(decades.scale, HeatmapScale::logarithmic);
  const auto nothing = renderer::value_statistics(std::vector<float>{0.0F, 0.0F});
  EXPECT_EQ(renderer::default_range(*nothing, HeatmapScale::logarithmic).scale,
            HeatmapScale::linear);
}

TEST(HeatmapHistogram, EveryValueIsCountedOnce) {
  const std::vector<float> values = {kNan, -1.0F, 0.0F, 0.9F, 1.0F, 3.5F, 4.0F, 4.1F, kInf};
  const auto found = renderer::heatmap_histogram(values, {0.0, 4.0, HeatmapScale::linear}, 4);
  EXPECT_EQ(found.bins, (std::vector<std::uint64_t>{2, 1, 0, 2}));
  EXPECT_EQ(found.below, 1U);
  EXPECT_EQ(found.above, 2U);
  EXPECT_EQ(found.missing, 1U);
  const auto decades = renderer::heatmap_histogram(std::vector<float>{1.5F, 15.0F, 150.0F, 0.0F},
                                                   {1.0, 1000.0, HeatmapScale::logarithmic}, 3);
  EXPECT_EQ(decades.bins, (std::vector<std::uint64_t>{1, 1, 1}));
  EXPECT_EQ(decades.below, 1U);
  EXPECT_EQ(decades.high, 1000.0);
  EXPECT_THROW(renderer::heatmap_histogram(values, {0.0, 4.0, HeatmapScale::linear}, 0),
               std::invalid_argument);
}

}  // namespace
