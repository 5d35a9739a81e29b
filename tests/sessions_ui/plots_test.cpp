#include "panel_test.h"
#include "ui/panels/bar_data.h"
#include "views.h"

namespace encore::ui {
namespace {

using energy::Origin;

class Plots : public PanelTest {
 protected:
  void draw() override {
    if (strip) {  // as they lie below everything in a window of 1280 x 800
      draw_power_plot({0.0F, 505.0F, 485.0F, 270.0F}, view, state, commands);
      draw_bars_plot({490.0F, 505.0F, 395.0F, 270.0F}, view, state, commands);
      draw_error_plot({890.0F, 505.0F, 390.0F, 270.0F}, view, state, commands);
      return;
    }
    draw_power_plot({0.0F, 30.0F, width, 300.0F}, view, state, commands);
    draw_bars_plot({0.0F, 340.0F, 0.5F * width, 400.0F}, view, state, commands);
    draw_error_plot({0.5F * width, 340.0F, 0.5F * width, 400.0F}, view, state, commands);
  }
  float width = 1600.0F;
  bool strip = false;
};

TEST_F(Plots, WithoutWattsSaysWhyAndOffersTheWaysOut) {
  view.plots.no_power = kNoSensor;
  add_slots(view.plots);
  view.plots.configurations = {configuration("cpu bvh", Origin::unavailable)};
  settle();
  EXPECT_EQ(state_of("power.problem"), kNoSensor);
  EXPECT_NE(widget("power.chart"), nullptr) << "the time axis stays";
  EXPECT_NE(state_of("bars.no_energy").find(kNoSensor), std::string::npos);
  EXPECT_EQ(widget("power.idle"), nullptr);
  click("power.doctor");
  EXPECT_TRUE(state.doctor_open);
  click("power.watts");
  EXPECT_EQ(state.dialog, Dialog::energy);
}

TEST_F(Plots, NothingOfEnergyIsANumberWhereThereIsNone) {
  view.plots.configurations = {configuration("cpu bvh", Origin::unavailable)};
  const BarData data = configuration_bars(view.plots.configurations);
  ASSERT_EQ(data.groups.size(), 1U);
  const Bar& bar = data.groups[0].bars[0];
  ASSERT_EQ(bar.unit, "J");
  EXPECT_FALSE(bar_sum(bar));
  EXPECT_FALSE(bar.half_width);
  for (const BarPart& part : bar.parts) {
    EXPECT_FALSE(part.value) << part.name;
    EXPECT_EQ(part.provenance.origin, Origin::unavailable);
    EXPECT_EQ(part.provenance.detail, kNoSensor);
  }
  click("bars.copy_csv");
  const auto copy = last<CopyText>();
  ASSERT_TRUE(copy);
  EXPECT_NE(copy->text.find("build,,,J,unavailable"), std::string::npos) << copy->text;
}

TEST_F(Plots, PhasesThatTheSensorCannotTellApartStandTogether) {
  ConfigurationView one = configuration("cpu bvh", Origin::measured);
  one.phases[0].joules = {std::nullopt, std::nullopt, {Origin::unavailable, "too short"}};
  one.phases[1].joules = one.phases[0].joules;
  const BarData data = configuration_bars({one});
  const Bar& bar = data.groups[0].bars[0];
  ASSERT_EQ(bar.parts.size(), 2U);
  EXPECT_EQ(bar.parts[1].name, "not told apart");
  EXPECT_DOUBLE_EQ(*bar.parts[1].value, 2.7 - 1.5);
  EXPECT_NE(bar.parts[1].provenance.detail.find("build, transfer"), std::string::npos);
  EXPECT_DOUBLE_EQ(bar_sum(bar)->value, 2.7);
  EXPECT_EQ(bar_sum(bar)->missing, 0U);

  // Without a total they stay unavailable, and the sum is a lower bound.
  one.joules = {std::nullopt, std::nullopt, {Origin::unavailable, "too short"}};
  const BarData partial = configuration_bars({one});
  EXPECT_EQ(bar_sum(partial.groups[0].bars[0])->missing, 2U);
}

TEST_F(Plots, EachOriginKeepsItsProvenance) {
  for (const Origin origin : {Origin::measured, Origin::modelled, Origin::simulated}) {
    const BarData data = configuration_bars({configuration("cpu bvh", origin)});
    for (const BarPart& part : data.groups[0].bars[0].parts) {
      EXPECT_EQ(part.provenance.origin, origin);
      EXPECT_TRUE(part.value);
    }
  }
}

TEST_F(Plots, ToolsGiveCsvAndPictures) {
  const SampleHistory history = gauge(8.0, 21.0);
  view.plots.power = {series("rapl:package-0", Origin::measured, &history)};
  view.plots.idle_watts = 8.1;
  view.plots.idle_half_width = 0.2;
  add_slots(view.plots);
  settle();
  EXPECT_EQ(state_of("power.idle"),
            "idle 8.10 \xC2\xB1"
            "0.20 W");
  EXPECT_EQ(widget("power.doctor"), nullptr) << "nothing is to be mended";
  click("power.copy_csv");
  const auto copy = last<CopyText>();
  ASSERT_TRUE(copy);
  EXPECT_NE(copy->text.find("rapl:package-0,measured"), std::string::npos) << copy->text;
  for (const char* name : {"power.save_png", "bars.save_png", "error.save_png"}) {
    click(name);
    const auto save = last<SavePicture>();
    ASSERT_TRUE(save) << name;
    EXPECT_EQ(save->what, PictureOf::plots);
  }
  click("power.annotate");
  EXPECT_EQ(state.dialog, Dialog::annotate);
  EXPECT_EQ(state_of("bars.copy_csv"), "disabled") << "there are no bars";
}

TEST_F(Plots, ASelectedRangeCanBeCopied) {
  const SampleHistory history = gauge(8.0, 21.0);
  view.plots.power = {series("rapl:package-0", Origin::measured, &history)};
  view.plots.now_s = 30.0;
  settle();
  EXPECT_EQ(widget("power.copy_range"), nullptr);
  const MappedWidget chart = *widget("power.chart");
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {chart.x + 0.5F * chart.width, chart.y + 0.5F * chart.height};
  frame();
  io.MouseDown[0] = true;
  frame();
  io.MousePos.x += 0.2F * chart.width;
  frame();
  io.MouseDown[0] = false;
  frame();
  ASSERT_TRUE(state.plots.now.power.selection);
  click("power.copy_range");
  const auto copy = last<CopyText>();
  ASSERT_TRUE(copy);
  EXPECT_NE(copy->text.find("rapl:package-0"), std::string::npos) << copy->text;
}

TEST_F(Plots, BarsAreNormalisedByTheSwitch) {
  view.plots.configurations = {configuration("cpu bvh", Origin::measured)};
  click("bars.normalised");
  EXPECT_TRUE(state.bars_normalised);
  settle();
  EXPECT_EQ(state.plots.now.bars.mode, BarMode::percent_of_largest);
  EXPECT_EQ(state_of("bars.normalised"), "on");
  click("bars.normalised");
  EXPECT_FALSE(state.bars_normalised);
  settle();
  EXPECT_EQ(state.plots.now.bars.mode, BarMode::absolute);
}

TEST_F(Plots, BarsAreSavedWhereTheUserSays) {
  view.plots.configurations = {configuration("cpu bvh", Origin::measured)};
  state.preferences.last_folder = "/results";
  click("bars.save_csv");
  settle();
  EXPECT_EQ(state_of("bars.csv_file"), "/results/encore-bars.csv");
  EXPECT_FALSE(last<SaveText>()) << "not before it is asked for";
  click("bars.csv_save");
  const auto save = last<SaveText>();
  ASSERT_TRUE(save);
  EXPECT_EQ(save->file, "/results/encore-bars.csv");
  EXPECT_NE(save->text.find("cpu bvh"), std::string::npos);
}

TEST_F(Plots, TheSwitchShowsTheSessionInAllPlots) {
  view.plots.configurations = {configuration("now", Origin::measured)};
  settle();
  EXPECT_EQ(widget("power.session"), nullptr) << "none is open";
  view.session = compared_session();
  view.session.changes.clear();
  click("power.session");
  EXPECT_TRUE(state.show_session);
  settle();
  EXPECT_EQ(widget("power.annotate"), nullptr) << "a recording cannot be annotated any more";
  EXPECT_EQ(state_of("error.configuration"), "the newest 2");
  click("power.now");
  EXPECT_FALSE(state.show_session);
}

TEST_F(Plots, AnotherSessionBeginsWithFreshCharts) {
  view.session = compared_session();
  state.show_session = true;
  settle();
  state.plots.session.power.selection = AxisRange{1.0, 2.0};
  state.plots.session.errors.hidden = {"time"};
  settle();
  EXPECT_TRUE(state.plots.session.power.selection);
  view.session.folder = "/sessions/wednesday";
  settle();
  EXPECT_FALSE(state.plots.session.power.selection);
  EXPECT_TRUE(state.plots.session.errors.hidden.empty());
}

TEST_F(Plots, AComparisonStandsInBarsTableAndCsv) {
  view.session = compared_session();
  state.show_session = true;
  settle();
  EXPECT_EQ(state_of("bars.title"), "A beside B");
  EXPECT_EQ(state_of("bars.changes.row.0"), "cpu bvh; lower; higher");
  const BarData data = comparison_bars(view.session);
  ASSERT_EQ(data.groups.size(), 2U);
  EXPECT_EQ(data.groups[0].bars[0].name, "A: monday");
  EXPECT_DOUBLE_EQ(*data.groups[0].bars[1].parts[0].value, 2.9);
  EXPECT_EQ(data.groups[0].bars[1].parts[0].provenance.origin, Origin::measured);
  EXPECT_FALSE(data.groups[1].bars[0].parts[0].value);
  EXPECT_EQ(data.groups[1].bars[0].parts[0].provenance.origin, Origin::unavailable);
  click("bars.copy_csv");
  const auto copy = last<CopyText>();
  ASSERT_TRUE(copy);
  EXPECT_NE(copy->text.find("cpu bvh,0.09,0.081,-10,-12,-8,lower,2.7,2.9,7.4,5,9.9,higher\n"),
            std::string::npos)
      << copy->text;
  EXPECT_NE(copy->text.find("cpu grid,0.2,0.201,0.5,,,unknown,,,,,,\n"), std::string::npos)
      << copy->text;
}

TEST_F(Plots, TheEstimateIsSaidToBeOne) {
  view.plots.configurations = {configuration("cpu bvh", Origin::measured)};
  state.settings.measure.target_percent = 1.0F;
  settle();
  // The energy's last point is 0.2 / sqrt(40) after 10 s: 1 % takes 10 times as long.
  EXPECT_EQ(state_of("error.estimate"), "1 % in about 90.0 s");
  state.settings.measure.target_percent = 50.0F;
  settle();
  EXPECT_EQ(state_of("error.estimate"), "50 % reached");
  view.plots.configurations[0].time_error.clear();
  view.plots.configurations[0].joules_error.clear();
  settle();
  EXPECT_EQ(widget("error.estimate"), nullptr) << "it cannot be told";
}

TEST_F(Plots, OfTooFewSamplesThereIsNoEstimate) {
  view.plots.configurations = {configuration("cpu bvh", Origin::measured)};
  view.plots.configurations[0].joules_error.back().samples = 3.0;
  settle();
  EXPECT_EQ(widget("error.estimate"), nullptr) << "the older, narrower interval holds no more";
  view.plots.configurations[0].joules_error.back().samples = 30.0;
  settle();
  EXPECT_EQ(state_of("error.estimate"), "1 % in about 90.0 s");
}

TEST_F(Plots, OneLegendEntryAConfigurationAndOneAQuantity) {
  view.plots.configurations = {configuration("cpu", Origin::measured),
                               configuration("gpu", Origin::measured, 2.0)};
  settle();
  for (const char* name : {"cpu", "gpu", "time", "energy"}) {
    EXPECT_EQ(state_of(std::string("error.chart.legend.") + name), "on") << name;
  }
  EXPECT_EQ(widget("error.chart.legend.cpu, time"), nullptr);
  click("error.chart.legend.energy");
  settle();
  EXPECT_EQ(state_of("error.chart.legend.energy"), "off");
  EXPECT_EQ(state_of("error.chart.legend.cpu"), "on");
}

TEST_F(Plots, InTheLowStripTheChartsKeepTheirHeight) {
  strip = true;
  view.plots.no_power = kNoSensor;
  view.plots.configurations = {configuration("cpu", Origin::unavailable),
                               configuration("gpu", Origin::unavailable)};
  settle();
  const float title = widget("bars.title")->y;
  for (const char* name : {"bars.normalised", "bars.copy_csv", "bars.save_csv", "bars.save_png"}) {
    EXPECT_EQ(widget(name)->y, title) << name << " is in the title's row";
  }
  EXPECT_GT(widget("bars.chart")->height, 130.0F);
  EXPECT_GT(widget("error.chart")->height, 130.0F);
  EXPECT_EQ(widget("power.chart.legend.watts"), nullptr) << "there are no watts to tell apart";
  EXPECT_EQ(state_of("power.problem"), kNoSensor);
  EXPECT_GT(widget("power.problem")->height, 1.5F * ImGui::GetFontSize())
      << "in full, on two lines";
}

TEST_F(Plots, InTheLowStripAComparisonIsAChartOrATable) {
  strip = true;
  view.session = compared_session();
  state.show_session = true;
  settle();
  EXPECT_NE(widget("bars.chart"), nullptr);
  EXPECT_EQ(widget("bars.changes.row.0"), nullptr);
  click("bars.table");
  settle();
  EXPECT_EQ(state_of("bars.table"), "on");
  EXPECT_EQ(widget("bars.chart"), nullptr);
  EXPECT_EQ(state_of("bars.changes.row.0"), "cpu bvh; lower; higher");
  strip = false;
  width = 3200.0F;
  settle();
  EXPECT_NE(widget("bars.chart"), nullptr) << "there is room for both";
  EXPECT_NE(widget("bars.changes.row.0"), nullptr);
}

TEST_F(Plots, FiftyConfigurationsLeaveRoomForTheCharts) {
  for (int i = 0; i < 50; ++i) {
    view.plots.configurations.push_back(
        configuration("cpu bvh-median refit 512x512 number " + std::to_string(i), Origin::measured,
                      1.0 + 0.01 * i));
  }
  view.plots.configurations[7].pane = 0;
  for (const float wide : {1600.0F, 900.0F}) {
    width = wide;
    settle();
    ASSERT_NE(widget("bars.chart"), nullptr) << wide;
    ASSERT_NE(widget("error.chart"), nullptr) << wide;
    EXPECT_GT(widget("error.chart")->height, 100.0F) << wide;
    EXPECT_GT(widget("bars.chart")->height, 100.0F) << wide;
  }
  const MappedWidget* of_pane = widget("error.chart.legend.cpu bvh-median refit 512x512 number 7");
  EXPECT_NE(of_pane, nullptr) << "what the panes show now comes first\n" << widget_map_text();
  click("error.configuration");
  settle();
  click("error.configuration.3");
  settle();
  EXPECT_EQ(state.plots.now.configuration, view.plots.configurations[3].label);
  EXPECT_NE(widget("error.chart.legend.time"), nullptr);
}

TEST_F(Plots, NothingIsDrawnOutsideTheirAreas) {
  view.plots.no_power = kNoSensor;
  for (const float wide : {300.0F, 120.0F, 20.0F}) {
    width = wide;
    settle();
    const ImDrawData* drawn = ImGui::GetDrawData();
    for (int l = 0; l < drawn->CmdListsCount; ++l) {
      const ImDrawList& list = *drawn->CmdLists[l];
      for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.ClipRect.z <= width + 0.5F) continue;
        // What is not clipped has to end by itself.
        for (unsigned i = 0; i < command.ElemCount; ++i) {
          const auto index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
          const float x = list.VtxBuffer[static_cast<int>(command.VtxOffset + index)].pos.x;
          ASSERT_LE(x, width + 1.0F) << wide;
        }
      }
    }
  }
}

}  // namespace
}  // namespace encore::ui
