// What the mouse does to bars and to the chart of errors.
#include "tests/plot/screenless.h"
#include "ui/plot/error_chart.h"
#include "ui/plot/stacked_bars.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using namespace encore::ui;
using encore::energy::Origin;

class Charts : public encore::ui::test::Screenless {
 protected:
  static BarData bars(int groups) {
    BarData data;
    for (int g = 0; g < groups; ++g) {
      BarGroup group{"configuration " + std::to_string(g), {}};
      for (const char* unit : {"J", "s"}) {
        Bar bar;
        bar.name = bar.unit = unit;
        bar.parts = {{"build", PlotColor::build, 1.0, 0.1, {Origin::measured, "x"}},
                     {"render", PlotColor::render, 3.0, 0.2, {Origin::measured, "x"}}};
        group.bars.push_back(bar);
      }
      data.groups.push_back(group);
    }
    return data;
  }
  static ErrorData errors(int points) {
    ErrorData data;
    data.target = 0.01;
    data.series.resize(2);
    for (std::size_t s = 0; s < 2; ++s) {
      data.series[s].name = s == 0 ? "cpu" : "gpu";
      for (int i = 1; i <= points; ++i) {
        data.series[s].points.push_back(
            {i * 0.5, (s == 0 ? 0.1 : 0.4) / std::sqrt(static_cast<double>(i))});
      }
    }
    return data;
  }
};

TEST_F(Charts, HoveringABarTellsItsPart) {
  const BarData data = bars(4);
  BarState state;
  BarResult result;
  const auto draw = [&] { frame([&] { result = stacked_bars("bars", data, state); }); };
  draw();
  const MappedWidget plot = widget("bars");
  EXPECT_GT(plot.width, 800.0F);
  // The first group's first bar begins left of the group's middle, an eighth of the width.
  mouse_at(plot, 0.125F, 0.98F);
  ImGui::GetIO().MousePos.x -= 5.0F;
  draw();
  draw();
  ASSERT_TRUE(result.under_mouse);
  EXPECT_EQ(result.under_mouse->group, 0U);
  EXPECT_EQ(result.under_mouse->bar, 0U);
  EXPECT_EQ(result.under_mouse->part, 0U);
  EXPECT_TRUE(tooltip_drawn());
  button(0, true);
  draw();
  EXPECT_TRUE(result.selection_changed);
  EXPECT_EQ(state.selected, 0U);
  button(0, false);
  draw();
  EXPECT_FALSE(result.selection_changed);
}

TEST_F(Charts, ManyBarsScrollAndCostNoMore) {
  const BarData few = bars(30);
  const BarData many = bars(3000);
  BarState state;
  const auto draw = [&](const BarData& data) {
    frame([&] { stacked_bars("bars", data, state); });
    return vertices();
  };
  draw(few);
  const int cost = draw(few);
  EXPECT_LT(draw(many), 2 * cost);
  mouse_at(widget("bars"), 0.5F, 0.5F);
  draw(many);
  ImGui::GetIO().MouseWheel = -1.0F;
  draw(many);
  EXPECT_GT(state.scroll, 0.0F);
  ImGui::GetIO().MouseWheel = -1e6F;
  draw(many);
  const float end = state.scroll;
  ImGui::GetIO().MouseWheel = -1.0F;
  draw(many);
  EXPECT_EQ(state.scroll, end);
}

TEST_F(Charts, UnavailableBarsAreDrawnAsSuch) {
  BarData data = bars(1);
  for (Bar& bar : data.groups[0].bars) {
    for (BarPart& part : bar.parts) part.value.reset();
  }
  BarState state;
  BarResult result;
  frame([&] { result = stacked_bars("bars", data, state); });
  mouse_at(widget("bars"), 0.49F, 0.9F);
  for (int i = 0; i < 2; ++i) frame([&] { result = stacked_bars("bars", data, state); });
  ASSERT_TRUE(result.under_mouse);
  EXPECT_EQ(result.under_mouse->part, 2U) << "on no part, as there is none";
  EXPECT_TRUE(tooltip_drawn());
  frame([&] { stacked_bars("bars", {}, state); });
}

TEST_F(Charts, ErrorsAreHoveredZoomedAndFitted) {
  const ErrorData data = errors(200);
  ErrorState state;
  ErrorResult result;
  const auto draw = [&] { frame([&] { result = error_chart("errors", data, state); }); };
  draw();
  const Axis fitted = state.x;
  EXPECT_LT(fitted.low, 0.5);
  EXPECT_GT(fitted.high, 100.0);
  const MappedWidget plot = widget("errors");
  const auto& last = data.series[0].points.back();
  mouse_at(plot, static_cast<float>(axis_position(state.x, last.elapsed_s)),
           static_cast<float>(1.0 - axis_position(state.y, *last.relative_ci95 * 100.0)));
  draw();
  draw();
  ASSERT_TRUE(result.under_mouse);
  EXPECT_EQ(result.under_mouse->series, 0U);
  EXPECT_EQ(result.under_mouse->point, data.series[0].points.size() - 1);
  EXPECT_TRUE(tooltip_drawn());
  const double there = axis_value(state.x, axis_position(state.x, last.elapsed_s));
  ImGui::GetIO().MouseWheel = 1.0F;
  draw();
  EXPECT_FALSE(state.fit);
  EXPECT_LT(state.x.high / state.x.low, fitted.high / fitted.low);
  EXPECT_NEAR(axis_position(state.x, there), axis_position(fitted, there), 1e-3)
      << "to a pixel, as the mouse has whole ones";
  for (int i = 0; i < 2; ++i) {
    button(0, true);
    draw();
    button(0, false);
    draw();
  }
  draw();
  EXPECT_DOUBLE_EQ(state.x.low, fitted.low);
}

TEST_F(Charts, ALegendLeavesTheChartItsHeight) {
  ErrorData data;
  data.series.resize(40);
  for (std::size_t i = 0; i < data.series.size(); ++i) {
    data.series[i].name = "a rather long name of configuration " + std::to_string(i);
    data.series[i].points = {{1.0, 0.5}, {2.0, 0.3}};
  }
  ErrorState state;
  for (int i = 0; i < 2; ++i) {
    frame([&] { error_chart("errors", data, state, {390.0F, 240.0F}); });
  }
  EXPECT_GT(widget("errors").height, 115.0F);
  const std::string more = widget("errors.legend_more").state;
  EXPECT_EQ(more.front(), '+') << more;
  mouse_at(widget("errors.legend_more"), 0.5F, 0.5F);
  for (int i = 0; i < 2; ++i) {
    frame([&] { error_chart("errors", data, state, {390.0F, 240.0F}); });
  }
  EXPECT_TRUE(tooltip_drawn()) << "it names the others";
}

TEST_F(Charts, ALegendEntryWiderThanTheChartIsShortened) {
  ErrorData data;
  data.series.resize(1);
  data.series[0].name = std::string(200, 'n');
  ErrorState state;
  frame([&] { error_chart("errors", data, state, {390.0F, 240.0F}); });
  const MappedWidget entry = widget("errors.legend." + data.series[0].name);
  EXPECT_LE(entry.width, 390.0F);
  EXPECT_GT(entry.width, 200.0F);
}

TEST_F(Charts, PartsThatNeverOccurAreNotInTheLegend) {
  BarData data = bars(2);
  for (BarGroup& group : data.groups) {
    for (Bar& bar : group.bars) {
      bar.parts.push_back({"update", PlotColor::update, 0.0, {}, {Origin::measured, "x"}});
      bar.parts.push_back({"transfer", PlotColor::transfer, {}, {}, {Origin::unavailable, "x"}});
    }
  }
  BarState state;
  frame([&] { stacked_bars("bars", data, state); });
  const auto drawn = [](const std::string& name) {
    return std::any_of(widget_map().begin(), widget_map().end(),
                       [&](const MappedWidget& one) { return one.name == name; });
  };
  EXPECT_TRUE(drawn("bars.legend.build"));
  EXPECT_TRUE(drawn("bars.legend.render"));
  EXPECT_FALSE(drawn("bars.legend.update"));
  EXPECT_FALSE(drawn("bars.legend.transfer"));
}

TEST_F(Charts, ErrorVerticesAreBounded) {
  ErrorState state;
  const ErrorData data = errors(300'000);
  for (int i = 0; i < 2; ++i) frame([&] { error_chart("errors", data, state); });
  EXPECT_LT(vertices(), 30'000);
  ErrorData none;
  none.series.resize(1);
  none.series[0].reason = "no power source";
  frame([&] { error_chart("errors", none, state); });
  EXPECT_GT(vertices(), 50);
}

}  // namespace
