// What the mouse does to a strip chart, and that drawing costs what the screen is wide.
#include "ui/plot/strip_chart.h"

#include "tests/plot/screenless.h"

#include <cmath>

namespace {

using namespace encore::ui;
using encore::energy::Origin;

class StripChart : public encore::ui::test::Screenless {
 protected:
  void SetUp() override {
    Screenless::SetUp();
    for (int i = 0; i <= 1000; ++i) history_.add(i * 0.1, 30.0 + std::sin(i * 0.05), i % 3 == 0);
    StripSeries series;
    series.name = "RAPL";
    series.history = &history_;
    series.provenance = {Origin::measured, "intel-rapl:0"};
    series.idle = Level{29.5, 0.2};
    data_.series.push_back(series);
    data_.spans = {{0.0, 50.0, 0, PlotColor::cpu, "CPU slot", ""},
                   {50.0, 100.0, 0, PlotColor::gpu, "GPU slot", ""}};
    data_.flags = {{20.0, "warm-up done"}};
  }

  StripResult draw() {
    StripResult result;
    frame([&] { result = strip_chart("power", data_, state_); });
    return result;
  }

  SampleHistory history_;
  StripData data_;
  StripState state_;
};

TEST_F(StripChart, FitsARecording) {
  draw();
  EXPECT_LE(state_.x.low, 0.0);
  EXPECT_GE(state_.x.high, 100.0);
  EXPECT_LT(state_.x.high, 110.0);
  EXPECT_LE(state_.y.low, 29.0);
  EXPECT_GE(state_.y.high, 31.0);
}

TEST_F(StripChart, WheelZoomsAtTheCursor) {
  draw();
  mouse_at(widget("power"), 0.25F, 0.5F);
  draw();
  const auto before = draw();
  ASSERT_TRUE(before.cursor_s);
  const double width = state_.x.high - state_.x.low;
  ImGui::GetIO().MouseWheel = 2.0F;
  const auto after = draw();
  EXPECT_LT(state_.x.high - state_.x.low, 0.8 * width);
  EXPECT_NEAR(*after.cursor_s, *before.cursor_s, 1e-6);
  EXPECT_TRUE(tooltip_drawn());
  // With Ctrl it is the other axis.
  const Axis x = state_.x;
  const Axis y = state_.y;
  ImGui::GetIO().KeyCtrl = true;
  ImGui::GetIO().KeyMods = ImGuiKeyModFlags_Ctrl;
  ImGui::GetIO().MouseWheel = 1.0F;
  draw();
  EXPECT_EQ(state_.x.low, x.low);
  EXPECT_LT(state_.y.high - state_.y.low, y.high - y.low);
  EXPECT_FALSE(state_.fit_y);
}

TEST_F(StripChart, LeftDragSelectsAndAClickDrops) {
  draw();
  const MappedWidget plot = widget("power");
  mouse_at(plot, 0.2F, 0.5F);
  draw();
  const double from = *draw().cursor_s;
  button(0, true);
  draw();
  mouse_at(plot, 0.6F, 0.5F);
  const double to = *draw().cursor_s;
  EXPECT_FALSE(state_.selection) << "not before the button is let go";
  button(0, false);
  EXPECT_TRUE(draw().selection_changed);
  ASSERT_TRUE(state_.selection);
  EXPECT_NEAR(state_.selection->from, from, 1e-9);
  EXPECT_NEAR(state_.selection->to, to, 1e-9);
  const auto statistics = selection_statistics(history_, state_);
  ASSERT_TRUE(statistics);
  EXPECT_NEAR(static_cast<double>(statistics->samples), (to - from) * 10.0, 1.5);
  EXPECT_NEAR(*statistics->integral, 30.0 * (to - from), (to - from));
  // A click without a drag takes it away; late enough not to be a double click.
  for (int i = 0; i < 60; ++i) draw();
  button(0, true);
  draw();
  button(0, false);
  EXPECT_TRUE(draw().selection_changed);
  EXPECT_FALSE(state_.selection);
}

TEST_F(StripChart, RightDragPansAndDoubleClickFits) {
  draw();
  const MappedWidget plot = widget("power");
  const Axis fitted = state_.x;
  mouse_at(plot, 0.5F, 0.5F);
  draw();
  button(1, true);
  draw();
  mouse_at(plot, 0.75F, 0.5F);
  draw();
  button(1, false);
  draw();
  const double width = fitted.high - fitted.low;
  EXPECT_NEAR(state_.x.low, fitted.low - 0.25 * width, 0.01 * width);
  for (int i = 0; i < 2; ++i) {
    button(0, true);
    draw();
    button(0, false);
    draw();
  }
  draw();
  EXPECT_NEAR(state_.x.low, fitted.low, 1e-9);
  EXPECT_NEAR(state_.x.high, fitted.high, 1e-9);
  EXPECT_FALSE(state_.selection);
}

TEST_F(StripChart, ALiveStripFollowsUntilItIsMoved) {
  data_.now_s = 100.0;
  draw();
  EXPECT_GT(state_.x.high, 100.0);
  EXPECT_NEAR(state_.x.high - state_.x.low, 60.0, 1e-9);
  data_.now_s = 130.0;
  draw();
  EXPECT_GT(state_.x.high, 130.0);
  const MappedWidget plot = widget("power");
  mouse_at(plot, 0.5F, 0.5F);
  draw();
  button(1, true);
  draw();
  mouse_at(plot, 0.6F, 0.5F);
  draw();
  button(1, false);
  data_.now_s = 200.0;
  draw();
  EXPECT_FALSE(state_.follow);
  EXPECT_LT(state_.x.high, 140.0);
}

TEST_F(StripChart, AYoungLiveStripBeginsWithItsFirstSample) {
  SampleHistory young;
  for (int i = 0; i <= 120; ++i) young.add(0.1 * i, 30.0, true);
  data_.series.resize(1);
  data_.series[0].history = &young;
  data_.spans.clear();
  data_.now_s = 12.0;
  draw();
  EXPECT_NEAR(state_.x.low, 0.0, 1e-9) << "there is nothing before";
  EXPECT_NEAR(state_.x.high, 20.0, 1e-9) << "whole tens of seconds";
  data_.now_s = 17.0;
  draw();
  EXPECT_NEAR(state_.x.high, 20.0, 1e-9) << "the scale stays still";
  data_.now_s = 500.0;
  draw();
  EXPECT_NEAR(state_.x.high - state_.x.low, 60.0, 1e-9);
  EXPECT_GT(state_.x.high, 500.0);
}

TEST_F(StripChart, TheLegendHidesASeries) {
  draw();
  const MappedWidget entry = widget("power.legend.RAPL");
  EXPECT_EQ(entry.state, "on");
  mouse_at(entry, 0.5F, 0.5F);
  draw();
  EXPECT_TRUE((draw(), tooltip_drawn())) << "the provenance";
  button(0, true);
  draw();
  button(0, false);
  EXPECT_EQ(draw().toggled, 0U);
  EXPECT_TRUE(state_.hidden.contains("RAPL"));
  draw();
  EXPECT_EQ(widget("power.legend.RAPL").state, "off");
}

TEST_F(StripChart, VerticesAreBoundedByTheWidth) {
  SampleHistory dense;
  for (int i = 0; i < 1'000'000; ++i)
    dense.add(i * 1e-4, (i % 1000 * 7919) % 100, true, i % 5000 == 0, 2.0);
  data_.series[0].history = &dense;
  data_.spans.clear();
  for (int i = 0; i < 50'000; ++i) {
    data_.spans.push_back({i * 0.002, i * 0.002 + 0.001, i % 8, PlotColor::build, "build", ""});
    data_.flags.push_back({i * 0.002, "flag"});
  }
  state_.selection = AxisRange{10.0, 90.0};
  for (const double width : {1e-3, 0.1, 1.0, 10.0, 100.0}) {
    state_.fit_x = false;
    set_range(state_.x, 50.0 - 0.5 * width, 50.0 + 0.5 * width);
    draw();
    // A thousand pixels: some 30 vertices each for everything together.
    EXPECT_LT(vertices(), 80'000) << width;
    EXPECT_GT(vertices(), 100) << width;
  }
}

TEST_F(StripChart, NothingToShowIsSaidAndNothingBreaks) {
  data_.series[0].history = nullptr;
  data_.series[0].reason = "no power source: /sys/class/powercap is empty";
  data_.spans.clear();
  draw();
  const int with_reason = vertices();
  data_.series[0].reason.clear();
  data_.series[0].provenance.detail.clear();
  draw();
  EXPECT_GT(with_reason, vertices());
  data_.series.clear();
  draw();
  ImGui::GetIO().DisplaySize = {30.0F, 30.0F};
  draw();
  draw();
}

}  // namespace
