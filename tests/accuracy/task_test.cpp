// The window's comparison: in the background, while the panes rest.
#include "app/window/accuracy_task.h"
#include "scene/sample_scenes.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

namespace encore::app {
namespace {

class AccuracyTaskTest : public testing::Test {
 protected:
  AccuracyTaskTest()
      : task_({[] { return standard_tools(); },
               [this](bool held, const std::atomic<bool>&) { held_ += held ? 1 : -1; },
               [this] { ++woken_; }}) {
    request_.plan.scene = std::make_shared<const scene::Scene>(*scene::make_sample_scene("mug"));
    request_.plan.size = {24, 24};
    request_.plan.samples = 16;
    request_.plan.threads = 1;
    request_.rounds = 2;
    request_.no_joules = "nothing gives watts";
    for (const int samples : {1, 4}) {
      WorkloadSpec spec;
      spec.scene = request_.plan.scene;
      spec.test = TestKind::fixed;
      spec.size = request_.plan.size;
      spec.threads = 1;
      spec.rays.samples = samples;
      request_.specs.push_back(std::move(spec));
    }
  }
  std::atomic<int> held_{0};
  std::atomic<int> woken_{0};
  AccuracyRequest request_;
  AccuracyTask task_;
};

TEST_F(AccuracyTaskTest, ComparesTimesAndLetsThePanesGo) {
  task_.start(request_);
  EXPECT_TRUE(task_.running());
  task_.wait();
  const ui::AccuracyView view = task_.view();
  EXPECT_EQ(view.problem, "");
  EXPECT_FALSE(view.work.active);
  EXPECT_EQ(view.rounds, 2);
  ASSERT_EQ(view.results.size(), 2U);
  EXPECT_GT(view.results[0].rmse, view.results[1].rmse);
  for (const ui::AccuracyResult& one : view.results) {
    ASSERT_TRUE(one.seconds.has_value());
    EXPECT_GT(*one.seconds, 0.0);
    EXPECT_FALSE(one.joules.has_value());
  }
  EXPECT_TRUE(view.results[1].best_by_time) << "nothing errs less";
  EXPECT_EQ(view.energy.origin, energy::Origin::unavailable);
  EXPECT_EQ(view.energy.detail, "nothing gives watts");
  EXPECT_TRUE(view.reference_error.has_value());
  EXPECT_EQ(held_.load(), 0);
  EXPECT_GT(woken_.load(), 4);
}

TEST_F(AccuracyTaskTest, JoulesAreThoseOfTheModelAndSaySo) {
  energy::PowerModel model;
  model.idle = energy::Watts(10.0);
  model.delta[energy::Phase::render] = energy::Watts(30.0);
  request_.model = model;
  task_.start(request_);
  task_.wait();
  const ui::AccuracyView view = task_.view();
  EXPECT_EQ(view.energy.origin, energy::Origin::modelled);
  ASSERT_EQ(view.results.size(), 2U);
  for (const ui::AccuracyResult& one : view.results) {
    ASSERT_TRUE(one.joules && one.seconds);
    EXPECT_NEAR(*one.joules, 40.0 * *one.seconds, 1e-12);
  }
  EXPECT_NE(view.csv.find(",modelled,"), std::string::npos);
}

TEST_F(AccuracyTaskTest, APhaseWithoutWattsHasNoJoules) {
  energy::PowerModel model;
  model.idle = energy::Watts(10.0);
  model.delta[energy::Phase::build] = energy::Watts(30.0);
  request_.model = model;
  task_.start(request_);
  task_.wait();
  for (const ui::AccuracyResult& one : task_.view().results) EXPECT_FALSE(one.joules.has_value());
}

TEST_F(AccuracyTaskTest, StopsAtAnyTimeAndKeepsWhatItFound) {
  request_.rounds = 1'000'000;
  task_.start(request_);
  while (task_.view().rounds < 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  task_.cancel();
  task_.wait();
  const ui::AccuracyView view = task_.view();
  EXPECT_FALSE(view.work.active);
  EXPECT_EQ(view.results.size(), 2U);
  EXPECT_EQ(view.problem, "");
  EXPECT_EQ(held_.load(), 0);
}

TEST_F(AccuracyTaskTest, AFailureIsOneLine) {
  AccuracyTask failing({[] {
                          WorkloadTools tools = standard_tools();
                          tools.make_renderer = [](Device,
                                                   int) -> std::unique_ptr<renderer::Renderer> {
                            throw std::runtime_error("no such device here");
                          };
                          return tools;
                        },
                        nullptr, nullptr});
  failing.start(request_);
  failing.wait();
  EXPECT_EQ(failing.view().problem, "no such device here");
  EXPECT_TRUE(failing.view().results.empty());
}

TEST_F(AccuracyTaskTest, SavesTheTableAndTheScatter) {
  task_.start(request_);
  task_.wait();
  const test::TemporaryFolder folder;
  task_.save(folder.path() / "accuracy");
  EXPECT_EQ(test::contents_of(folder.path() / "accuracy" / "accuracy.csv"), task_.view().csv);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "accuracy" / "accuracy-time.svg"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "accuracy" / "accuracy-energy.svg"));
}

}  // namespace
}  // namespace encore::app
