// The window's division: parts never overlap, lie inside the window, are never negative, and what
// a drag sets is what is then shown.
#include "ui/layout.h"

#include "ui/layout_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace encore::ui;

struct Named {
  std::string name;
  Rect rect;
};

std::vector<Named> parts(const Layout& l) {
  return {{"menu", l.menu},         {"left", l.left},        {"right", l.right},
          {"pane 0", l.panes[0]},   {"pane 1", l.panes[1]},  {"pane 2", l.panes[2]},
          {"power", l.power},       {"bars", l.bars},        {"error", l.error},
          {"status", l.status},     {"ls", l.left_splitter}, {"rs", l.right_splitter},
          {"ps", l.plots_splitter}, {"ss", l.plot_splitter}, {"ns", l.pane_splitter}};
}

bool overlap(const Rect& a, const Rect& b) {
  return !a.empty() && !b.empty() && a.x < b.right() && b.x < a.right() && a.y < b.bottom() &&
         b.y < a.bottom();
}

void expect_sound(const Layout& layout, const LayoutInput& input) {
  const auto all = parts(layout);
  const std::string where = std::to_string(input.width) + " x " + std::to_string(input.height) +
                            ", em " + std::to_string(input.em) + ", panes " +
                            std::to_string(input.panes);
  for (const Named& part : all) {
    EXPECT_GE(part.rect.x, 0.0F) << part.name << " " << where;
    EXPECT_GE(part.rect.y, 0.0F) << part.name << " " << where;
    EXPECT_GE(part.rect.width, 0.0F) << part.name << " " << where;
    EXPECT_GE(part.rect.height, 0.0F) << part.name << " " << where;
    EXPECT_LE(part.rect.right(), input.width) << part.name << " " << where;
    EXPECT_LE(part.rect.bottom(), input.height) << part.name << " " << where;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      EXPECT_FALSE(overlap(all[i].rect, all[j].rect))
          << all[i].name << " and " << all[j].name << " " << where;
    }
  }
}

LayoutInput input_of(float width, float height, float em, int panes) {
  return {.width = width,
          .height = height,
          .em = em,
          .menu_height = em * 1.5F,
          .status_height = em * 1.6F,
          .panes = panes};
}

TEST(WindowLayout, IsSoundForAllSizes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> part(0.0F, 1.0F);
  for (int round = 0; round < 4000; ++round) {
    LayoutSettings settings;
    settings.left = part(random) < 0.8F;
    settings.right = part(random) < 0.8F;
    settings.plots = part(random) < 0.8F;
    settings.left_width = part(random) * 60.0F;
    settings.right_width = part(random) * 60.0F;
    settings.plots_share = part(random);
    settings.plot_split = part(random);
    settings.pane_split = part(random);
    const LayoutInput input = input_of(320.0F + std::floor(part(random) * 7360.0F),
                                       240.0F + std::floor(part(random) * 4080.0F),
                                       10.0F + part(random) * 30.0F, round % 4);
    const Layout layout = make_layout(settings, input);
    expect_sound(layout, input);
    for (int pane = 0; pane < 3; ++pane) {
      EXPECT_EQ(layout.panes[static_cast<std::size_t>(pane)].empty(), pane >= input.panes);
    }
  }
}

TEST(WindowLayout, FillsTheWindow) {
  const LayoutInput input = input_of(1600.0F, 960.0F, 15.0F, 2);
  const Layout l = make_layout({}, input);
  for (const Rect& rect : {l.left, l.right, l.power, l.bars, l.error, l.panes[0], l.panes[1]}) {
    EXPECT_FALSE(rect.empty());
  }
  EXPECT_EQ(l.left.x, 0.0F);
  EXPECT_EQ(l.right.right(), 1600.0F);
  EXPECT_EQ(l.left.y, l.menu.bottom());
  EXPECT_EQ(l.left.bottom(), l.plots_splitter.y);
  EXPECT_EQ(l.power.x, 0.0F);
  EXPECT_EQ(l.error.right(), 1600.0F);
  EXPECT_EQ(l.panes[0].x, l.left_splitter.right());
  EXPECT_EQ(l.panes[1].right(), l.right_splitter.x);
  EXPECT_EQ(l.bars.bottom(), l.status.y);
}

TEST(WindowLayout, GivesUpTheRightColumnFirstThenTheLeftOne) {
  bool right_gone = false;
  bool left_gone = false;
  for (float width = 1600.0F; width >= 320.0F; width -= 8.0F) {
    const Layout l = make_layout({}, input_of(width, 900.0F, 16.0F, 2));
    EXPECT_FALSE(l.panes[0].empty()) << width;
    EXPECT_TRUE(!l.left.empty() || l.right.empty()) << width;
    right_gone = right_gone || l.right.empty();
    left_gone = left_gone || l.left.empty();
  }
  EXPECT_TRUE(right_gone);
  EXPECT_TRUE(left_gone);
}

TEST(WindowLayout, SmallWindowsKeepTheirPanes) {
  const Layout l = make_layout({}, input_of(320.0F, 240.0F, 16.0F, 2));
  EXPECT_FALSE(l.panes[0].empty());
  EXPECT_FALSE(l.panes[1].empty());
  EXPECT_TRUE(l.power.empty());
}

TEST(WindowLayout, SurvivesValuesThatAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  LayoutSettings settings;
  settings.left_width = nan;
  settings.plots_share = -3.0F;
  settings.pane_split = std::numeric_limits<float>::infinity();
  const LayoutInput input = input_of(1280.0F, 800.0F, 15.0F, 3);
  expect_sound(make_layout(settings, input), input);
  EXPECT_TRUE(make_layout(settings, input_of(nan, -5.0F, nan, 2)).panes[0].empty());
}

TEST(WindowLayout, TallWindowsStackTheirPanes) {
  const Layout tall = make_layout({}, input_of(1100.0F, 2400.0F, 15.0F, 2));
  EXPECT_TRUE(panes_stacked(tall));
  EXPECT_FALSE(panes_stacked(make_layout({}, input_of(2560.0F, 1440.0F, 15.0F, 2))));
}

TEST(SplitterDrag, FollowsTheMouse) {
  const LayoutInput input = input_of(2000.0F, 1200.0F, 16.0F, 2);
  const LayoutSettings start;
  const Layout before = make_layout(start, input);
  EXPECT_NEAR(make_layout(drag_left(start, input, 40.0F), input).left.width,
              before.left.width + 40.0F, 1.0F);
  EXPECT_NEAR(make_layout(drag_right(start, input, 40.0F), input).right.width,
              before.right.width - 40.0F, 1.0F);
  EXPECT_NEAR(make_layout(drag_plots(start, input, 30.0F), input).power.y, before.power.y + 30.0F,
              1.0F);
  EXPECT_NEAR(make_layout(drag_plot_split(start, input, -25.0F), input).bars.width,
              before.bars.width - 25.0F, 1.0F);
  EXPECT_NEAR(make_layout(drag_pane_split(start, input, 25.0F), input).panes[0].width,
              before.panes[0].width + 25.0F, 1.0F);
}

TEST(SplitterDrag, SetsNoMoreThanIsShown) {
  const LayoutInput input = input_of(1280.0F, 800.0F, 15.0F, 2);
  for (const float delta : {-1e6F, -300.0F, 300.0F, 1e6F}) {
    for (const auto drag : {drag_left, drag_right, drag_plots, drag_plot_split, drag_pane_split}) {
      const LayoutSettings moved = drag({}, input, delta);
      const Layout shown = make_layout(moved, input);
      expect_sound(shown, input);
      // Taking hold again where it is and not moving changes nothing.
      EXPECT_EQ(make_layout(drag(moved, input, 0.0F), input).left, shown.left);
      EXPECT_EQ(make_layout(drag(moved, input, 0.0F), input).power, shown.power);
      EXPECT_EQ(make_layout(drag(moved, input, 0.0F), input).panes[0], shown.panes[0]);
    }
  }
  const LayoutSettings wide = drag_left({}, input, 1e6F);
  EXPECT_NEAR(wide.left_width * 15.0F, make_layout(wide, input).left.width, 0.01F);
}

}  // namespace
