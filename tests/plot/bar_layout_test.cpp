// Stacks stand on their axis, sum up, stay apart and inside; what is missing is no bar of 0.
#include "ui/plot/bar_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace {

using namespace encore::ui;
using encore::energy::Origin;

constexpr PlotRect kArea{100.0F, 50.0F, 700.0F, 450.0F};
const MeasureText kMeasure = [](std::string_view text) {
  return 7.0F * static_cast<float>(text.size());
};

BarPart part(std::string name, std::optional<double> value, std::optional<double> band = {}) {
  return {std::move(name), PlotColor::build, value, band, {Origin::measured, "test"}};
}

Bar bar(std::string name, std::string unit, std::vector<BarPart> parts) {
  return {std::move(name), std::move(unit), false, std::nullopt, std::move(parts)};
}

BarData random_bars(unsigned seed, std::size_t groups) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(0.0, 100.0);
  BarData data;
  for (std::size_t g = 0; g < groups; ++g) {
    BarGroup group{"configuration " + std::to_string(g), {}};
    for (const char* unit : {"J", "s"}) {
      Bar one = bar(unit, unit, {});
      for (int p = 0; p < 4; ++p) one.parts.push_back(part("p" + std::to_string(p), value(random)));
      group.bars.push_back(one);
    }
    data.groups.push_back(group);
  }
  return data;
}

BarLayout layout(const BarData& data, BarMode mode = BarMode::absolute, float scroll = 0.0F) {
  return layout_bars(data, mode, kArea, scroll, {}, kMeasure);
}

TEST(BarLayout, PartsAreAsHighAsTheirValues) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const BarData data = random_bars(seed, 5);
    const BarLayout placed = layout(data);
    ASSERT_EQ(placed.units.size(), 2U);
    ASSERT_EQ(placed.parts.size(), 5U * 2U * 4U);
    for (const PlacedPart& p : placed.parts) {
      const Bar& owner = data.groups[p.group].bars[p.bar];
      const Axis& axis = placed.axes[p.bar];
      const double scale = static_cast<double>(kArea.height()) / (axis.high - axis.low);
      EXPECT_NEAR(p.rect.height(), *owner.parts[p.part].value * scale, 0.01);
    }
    for (const PlacedBar& b : placed.bars) {
      const auto sum = bar_sum(data.groups[b.group].bars[b.bar]);
      const Axis& axis = placed.axes[b.bar];
      EXPECT_NEAR(axis_position(axis, sum->value), (kArea.y1 - b.top) / kArea.height(), 1e-4);
      EXPECT_EQ(axis.low, 0.0);
    }
  }
}

TEST(BarLayout, NothingOverlapsOrSticksOut) {
  for (const std::size_t groups : {1U, 3U, 20U, 200U}) {
    const BarData data = random_bars(7, groups);
    for (const float scroll : {0.0F, 333.0F, 1e9F, -5.0F}) {
      const BarLayout placed = layout(data, BarMode::absolute, scroll);
      EXPECT_GE(placed.scroll, 0.0F);
      EXPECT_LE(placed.scroll, std::max(0.0F, placed.content_width - kArea.width()) + 0.01F);
      for (const PlacedPart& p : placed.parts) {
        EXPECT_GE(p.rect.x0, kArea.x0);
        EXPECT_LE(p.rect.x1, kArea.x1);
        EXPECT_GE(p.rect.y0, kArea.y0);
        EXPECT_LE(p.rect.y1, kArea.y1);
      }
      for (std::size_t i = 1; i < placed.bars.size(); ++i) {
        EXPECT_GE(placed.bars[i].slot.x0, placed.bars[i - 1].slot.x1 - 0.01F);
      }
      for (std::size_t i = 1; i < placed.parts.size(); ++i) {
        const PlacedPart& a = placed.parts[i - 1];
        const PlacedPart& b = placed.parts[i];
        if (a.group == b.group && a.bar == b.bar) {
          EXPECT_LE(b.rect.y1, a.rect.y0 + 0.01F);
        }
      }
      // Only what is in sight is placed.
      EXPECT_LE(placed.bars.size(), 2U * 17U);
      for (const PlacedLabel& label : placed.labels) {
        for (const std::string& line : label.lines) {
          EXPECT_LE(kMeasure(line), placed.content_width / static_cast<float>(groups));
        }
      }
    }
  }
}

TEST(BarLayout, SharesAddUpToAHundred) {
  const BarData data = random_bars(9, 4);
  const BarLayout placed = layout(data, BarMode::percent_of_bar);
  ASSERT_EQ(placed.axes.size(), 1U);
  EXPECT_EQ(placed.axes[0].unit, "%");
  for (const PlacedBar& b : placed.bars) {
    EXPECT_NEAR(axis_position(placed.axes[0], 100.0), (kArea.y1 - b.top) / kArea.height(), 1e-4);
  }
  const BarLayout against = layout(data, BarMode::percent_of_largest);
  for (std::size_t unit = 0; unit < 2; ++unit) {
    float highest = kArea.y1;
    for (const PlacedBar& b : against.bars) {
      if (b.bar == unit) highest = std::min(highest, b.top);
    }
    EXPECT_NEAR(axis_position(against.axes[0], 100.0), (kArea.y1 - highest) / kArea.height(), 1e-4);
  }
}

TEST(BarLayout, MissingIsNoBar) {
  BarData data;
  data.groups.push_back({"a", {bar("energy", "J", {part("build", {}), part("render", {})})}});
  data.groups.push_back({"b", {bar("energy", "J", {part("build", {}), part("render", 5.0)})}});
  data.groups.push_back({"c", {bar("energy", "J", {part("render", std::nan(""))})}});
  const BarLayout placed = layout(data);
  ASSERT_EQ(placed.bars.size(), 3U);
  EXPECT_FALSE(placed.bars[0].available);
  EXPECT_TRUE(placed.bars[1].available);
  EXPECT_FALSE(placed.bars[2].available);
  EXPECT_EQ(placed.parts.size(), 1U);
  EXPECT_FALSE(bar_sum(data.groups[0].bars[0]));
  EXPECT_EQ(bar_sum(data.groups[1].bars[0])->missing, 1U);
  EXPECT_FALSE(bar_sum(data.groups[1].bars[0])->half_width);
}

TEST(BarLayout, PartsBelowZeroGoDown) {
  BarData data;
  data.groups.push_back({"a", {bar("net", "J", {part("render", 10.0), part("remainder", -4.0)})}});
  const BarLayout placed = layout(data);
  ASSERT_EQ(placed.parts.size(), 2U);
  EXPECT_LT(placed.axes[0].low, -4.0);
  EXPECT_NEAR(placed.parts[0].rect.y1, placed.parts[1].rect.y0, 0.01);
}

TEST(BarLayout, TheMouseFindsEveryPart) {
  const BarData data = random_bars(11, 6);
  const BarLayout placed = layout(data);
  for (const PlacedPart& p : placed.parts) {
    if (p.rect.height() < 0.5F) continue;
    const auto hit =
        bar_at(placed, data, 0.5F * (p.rect.x0 + p.rect.x1), 0.5F * (p.rect.y0 + p.rect.y1));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->group, p.group);
    EXPECT_EQ(hit->bar, p.bar);
    EXPECT_EQ(hit->part, p.part);
  }
  const PlacedBar& first = placed.bars.front();
  const auto above = bar_at(placed, data, first.slot.x0 + 1.0F, kArea.y0 + 0.5F);
  ASSERT_TRUE(above);
  EXPECT_EQ(above->part, data.groups[0].bars[0].parts.size());
  EXPECT_FALSE(bar_at(placed, data, kArea.x0 - 5.0F, kArea.y1 - 5.0F));
}

TEST(BarLayout, DifferencesCarryBothIntervals) {
  const Bar a = bar("a", "J", {part("render", 10.0, 0.3), part("build", 10.0, 0.4)});
  const Bar b = bar("b", "J", {part("render", 5.0, 0.3), part("build", 10.0, 0.4)});
  const auto change = difference(a, b);
  ASSERT_TRUE(change);
  EXPECT_DOUBLE_EQ(change->percent, -25.0);
  // Half-widths 0.5 each: sqrt((0.5 / 20)^2 + (0.75 * 0.5 / 20)^2).
  EXPECT_NEAR(change->half_width.value(), 3.125, 1e-12);
  EXPECT_FALSE(difference(a, bar("c", "J", {part("render", {}), part("build", 1.0)})));
  EXPECT_FALSE(difference(bar("z", "J", {part("render", 0.0)}), b));
  EXPECT_FALSE(difference(a, bar("d", "J", {part("render", 1.0)}))->half_width);
}

TEST(BarLayout, LabelsBreakAndShorten) {
  const auto fit = [](std::string_view text, float width, int lines) {
    return fit_label(text, width, lines, kMeasure);
  };
  EXPECT_EQ(fit("bvh-sah", 100.0F, 2).lines, (std::vector<std::string>{"bvh-sah"}));
  EXPECT_EQ(fit("bvh-sah / cpu", 60.0F, 2).lines, (std::vector<std::string>{"bvh-sah", "/ cpu"}));
  const PlacedLabel cut = fit("abcdefghijklmnop", 63.0F, 2);
  EXPECT_EQ(cut.lines, (std::vector<std::string>{"abcdef\xE2\x80\xA6"}));
  EXPECT_TRUE(cut.shortened);
  EXPECT_TRUE(fit("", 50.0F, 2).lines.empty());
  // No half characters.
  EXPECT_EQ(fit("\xC2\xB5\xC2\xB5\xC2\xB5", 40.0F, 1).lines[0], "\xC2\xB5\xE2\x80\xA6");
  EXPECT_TRUE(layout({}).bars.empty());
}

TEST(BarLayout, BarsOfBothUnitsStandOnOneLine) {
  BarData data;
  Bar joules{.name = "energy", .unit = "J", .half_width = 9.0, .parts = {part("a", 5.0)}};
  Bar seconds{.name = "time", .unit = "s", .half_width = {}, .parts = {part("a", 0.1)}};
  data.groups = {{"x", {joules, seconds}}};
  const PlotRect area{0.0F, 0.0F, 400.0F, 200.0F};
  const auto measure = [](std::string_view text) { return 8.0F * static_cast<float>(text.size()); };
  const auto zero = [&](const BarLayout& layout, std::size_t axis) {
    return axis_position(layout.axes[axis], 0.0);
  };
  BarLayout layout = layout_bars(data, BarMode::absolute, area, 0.0F, {}, measure);
  EXPECT_EQ(layout.axes[0].low, 0.0) << "an interval takes no cost below nothing";
  data.groups[0].bars[0].parts.push_back(part("rest", -2.0));
  layout = layout_bars(data, BarMode::absolute, area, 0.0F, {}, measure);
  EXPECT_LT(layout.axes[0].low, 0.0);
  EXPECT_NEAR(zero(layout, 0), zero(layout, 1), 1e-9);
}

TEST(BarLayout, GroupsAreWideEnoughForTheirLabels) {
  const auto measure = [](std::string_view text) { return 8.0F * static_cast<float>(text.size()); };
  EXPECT_FLOAT_EQ(two_line_width("grid 128x128", measure), 8.0F * 7.0F);
  EXPECT_FLOAT_EQ(two_line_width("grid", measure), 8.0F * 4.0F);
  BarData data;
  for (int i = 0; i < 8; ++i) {
    data.groups.push_back(
        {"cpu bvh-median, 128x128",
         {{.name = "t", .unit = "s", .half_width = {}, .parts = {part("a", 1.0)}}}});
  }
  BarSizes sizes;
  sizes.most_group = 200.0F;
  const BarLayout layout =
      layout_bars(data, BarMode::absolute, {0.0F, 0.0F, 400.0F, 200.0F}, 0.0F, sizes, measure);
  ASSERT_FALSE(layout.labels.empty());
  for (const PlacedLabel& label : layout.labels) EXPECT_FALSE(label.shortened);
  EXPECT_GT(layout.content_width, 400.0F) << "the others are reached by scrolling";
}

}  // namespace
