// The window of accuracy: choices, results, and nothing that does not apply.
#include "tests/sessions_ui/panel_test.h"
#include "ui/panels/accuracy_parts.h"

#include <memory>
#include <string>
#include <vector>

namespace encore::ui {
namespace {

class AccuracyWindow : public PanelTest {
 protected:
  AccuracyWindow() {
    state.accuracy.open = true;
    view.scene.scene = std::make_shared<const scene::Scene>();
  }
  void draw() override { draw_accuracy_window(view, state, commands); }

  void put_results(bool joules) {
    const auto add = [&](PaneDevice device, int samples, double rmse, double seconds, bool best) {
      AccuracyResult one;
      one.device = device;
      one.samples = samples;
      one.rmse = rmse;
      one.seconds = seconds;
      if (joules) one.joules = 50.0 * seconds;
      one.best_by_time = one.best_by_energy = best;
      view.accuracy.results.push_back(one);
    };
    add(PaneDevice::cpu, 1, 0.05, 0.002, true);
    add(PaneDevice::cpu, 4, 0.02, 0.008, true);
    add(PaneDevice::gpu, 4, 0.03, 0.009, false);
    view.accuracy.reference_error = 0.001;
    view.accuracy.of = "mug, 256 × 256";
    view.accuracy.rounds = 5;
    view.accuracy.rounds_wanted = 5;
    view.accuracy.energy = {joules ? energy::Origin::modelled : energy::Origin::unavailable,
                            "by the test"};
  }
};

TEST_F(AccuracyWindow, OffersNoDeviceThatIsNotThere) {
  settle();
  EXPECT_NE(widget("accuracy.device.cpu"), nullptr);
  EXPECT_EQ(widget("accuracy.device.gpu"), nullptr);
  view.accuracy.gpu = true;
  settle();
  EXPECT_NE(widget("accuracy.device.gpu"), nullptr);
}

TEST_F(AccuracyWindow, StartsWhatIsChosen) {
  view.accuracy.gpu = true;
  click("accuracy.device.gpu");
  click("accuracy.structure.kd-sah");
  click("accuracy.mode.watertight");
  click("accuracy.samples.64");
  click("accuracy.start");
  const auto start = last<StartAccuracy>();
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(start->choice.devices.size(), 2U);
  EXPECT_FALSE(start->choice.structures.contains(accel::StructureKind::kd_sah));
  EXPECT_FALSE(start->choice.modes.contains(accel::IntersectionMode::watertight));
  EXPECT_TRUE(start->choice.samples.contains(64));
  EXPECT_EQ(start->choice.configurations(), 2U * 1U * 2U * 4U);
}

TEST_F(AccuracyWindow, NothingToCompareCannotBeStarted) {
  click("accuracy.device.cpu");
  EXPECT_EQ(state_of("accuracy.start"), "disabled");
  click("accuracy.device.cpu");
  EXPECT_EQ(state_of("accuracy.start"), "");
  view.scene.scene.reset();
  settle();
  EXPECT_EQ(state_of("accuracy.start"), "disabled");
}

TEST_F(AccuracyWindow, WhileItRunsItCanBeStopped) {
  view.accuracy.work.active = true;
  view.accuracy.work.progress = 0.25;
  view.accuracy.work.doing = "timing, round 1 of 5";
  settle();
  EXPECT_EQ(widget("accuracy.start"), nullptr);
  EXPECT_EQ(state_of("accuracy.progress"), "25 %");
  EXPECT_EQ(state_of("accuracy.doing"), "timing, round 1 of 5");
  click("accuracy.stop");
  EXPECT_TRUE(last<StopAccuracy>().has_value());
}

TEST_F(AccuracyWindow, SortsByTheColumnThatIsClicked) {
  put_results(false);
  settle();
  EXPECT_EQ(state_of("accuracy.row.0"), "bvh-median, cpu, precise, 4 samples") << "least error";
  EXPECT_EQ(state_of("accuracy.row.2"), "bvh-median, cpu, precise, 1 sample");
  click("accuracy.sort.time");
  EXPECT_EQ(state_of("accuracy.row.0"), "bvh-median, cpu, precise, 1 sample");
  click("accuracy.sort.time");
  EXPECT_EQ(state_of("accuracy.row.0"), "bvh-median, gpu, precise, 4 samples");
}

TEST_F(AccuracyWindow, JoulesAndTheirAxisAreThereOnlyWhereTheyAreKnown) {
  put_results(false);
  settle();
  EXPECT_EQ(widget("accuracy.sort.energy"), nullptr);
  EXPECT_EQ(widget("accuracy.by_joules"), nullptr);
  EXPECT_NE(state_of("accuracy.facts").find("no joules: by the test"), std::string::npos);
  view.accuracy.results.clear();
  put_results(true);
  settle();
  EXPECT_NE(widget("accuracy.sort.energy"), nullptr);
  EXPECT_EQ(state.accuracy.chart.x.unit, "s");
  click("accuracy.by_joules");
  EXPECT_TRUE(state.accuracy.by_joules);
  EXPECT_EQ(state.accuracy.chart.x.unit, "J");
  EXPECT_EQ(state_of("accuracy.origin"), "modelled");
}

TEST_F(AccuracyWindow, ASeriesIsHiddenByItsLegend) {
  put_results(false);
  click("accuracy.chart.legend.gpu, precise");
  EXPECT_TRUE(state.accuracy.chart.hidden.contains("gpu, precise"));
}

TEST_F(AccuracyWindow, ResultsAreCopiedAndSaved) {
  settle();
  EXPECT_EQ(state_of("accuracy.copy_csv"), "disabled");
  put_results(false);
  view.accuracy.csv = "scene,device\n";
  click("accuracy.copy_csv");
  const auto copy = last<CopyText>();
  ASSERT_TRUE(copy.has_value());
  EXPECT_EQ(copy->text, "scene,device\n");
  click("accuracy.save");
  EXPECT_TRUE(last<SaveAccuracy>().has_value());
  click("accuracy.save_png");
  const auto picture = last<SavePicture>();
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->what, PictureOf::accuracy);
  EXPECT_GT(state.accuracy.area.width, 0.0F);
}

TEST(AccuracyResults, UnknownCostsComeLastEitherWay) {
  std::vector<AccuracyResult> results(3);
  results[1].seconds = 2.0;
  results[2].seconds = 1.0;
  EXPECT_EQ(sorted_results(results, AccuracyColumn::time, false),
            (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_EQ(sorted_results(results, AccuracyColumn::time, true),
            (std::vector<std::size_t>{1, 2, 0}));
}

TEST(AccuracyResults, ErrorsBelowTheReferencesOwnAreDrawnAtIt) {
  AccuracyView view;
  view.reference_error = 0.01;
  AccuracyResult one;
  one.seconds = 2.0;
  one.rmse = 0.0;
  view.results = {one};
  const ScatterData data = accuracy_scatter(view, false);
  ASSERT_EQ(data.series.size(), 1U);
  ASSERT_EQ(data.series[0].points.size(), 1U);
  EXPECT_TRUE(drawable(data.series[0].points[0], data));
  EXPECT_DOUBLE_EQ(shown_error(data.series[0].points[0], data), 1.0);
  EXPECT_TRUE(accuracy_scatter(view, true).series[0].points.empty()) << "no joules, no place";
}

TEST(AccuracyResults, TheFrontRisesInCostAndLeavesHiddenSeriesOut) {
  ScatterData data;
  data.series = {{.name = "a", .points = {{4.0, 1.0, "", true}, {1.0, 9.0, "", true}}},
                 {.name = "b", .points = {{2.0, 3.0, "", true}, {3.0, 8.0, "", false}}}};
  ScatterState state;
  const auto front = front_of(data, state);
  ASSERT_EQ(front.size(), 3U);
  EXPECT_EQ(front[0].point, 1U);
  EXPECT_EQ(front[1].series, 1U);
  EXPECT_EQ(front[2].point, 0U);
  state.hidden.insert("b");
  EXPECT_EQ(front_of(data, state).size(), 2U);
}

}  // namespace
}  // namespace encore::ui
