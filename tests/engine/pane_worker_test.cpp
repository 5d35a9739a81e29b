// A pane's thread works towards the latest request, and measures alone when its slot comes.
#include "app/window/pane_worker.h"

#include "app/window/measure_scheduler.h"
#include "renderer/image_diff.h"
#include "scene/sample_scenes.h"
#include "tests/support/gl_devices.h"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <string>
#include <thread>

namespace encore::app {
namespace {

using namespace std::chrono_literals;

/// A failsafe, far beyond what anything here takes.
template <class Condition>
bool eventually(const Condition& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

class PaneWorkerTest : public testing::Test {
 protected:
  PaneWorkerTest() {
    MeasuringOptions none;
    none.model = "idle=10,build=20,update=20,render=30,animate=15,transfer=15";
    monitor_.choose(none);
    monitor_.wait_until_open();
  }
  std::unique_ptr<PaneWorker> make_worker() {
    return std::make_unique<PaneWorker>(
        PaneWorker::Setup{std::nullopt, &monitor_, &attribution_, [this] { ++changes_; },
                          [this](const energy::FrameRow& row) { take(row); }});
  }
  void take(const energy::FrameRow& row) {
    for (const energy::KeyValue& cell : row.configuration) {
      if (cell.key != "build_on") continue;
      const std::lock_guard lock(mutex_);
      built_on_ = cell.value;
    }
    ++frames_;
  }
  /// What the last frame's row says of where its structure was built.
  std::string built_on() {
    const std::lock_guard lock(mutex_);
    return built_on_;
  }
  static PaneRequest request_for(const char* scene) {
    PaneRequest request;
    request.scene = std::make_shared<const scene::Scene>(*scene::make_sample_scene(scene));
    request.device = Device::cpu;
    request.camera = request.scene->camera;
    request.width = 64;
    request.height = 48;
    request.threads = 1;
    return request;
  }
  static bool whole(const PaneWorker& worker) {
    const auto output = worker.output();
    return output && output->whole && worker.status().state == ui::PaneState::ready;
  }

  std::atomic<int> changes_{0};
  std::atomic<int> frames_{0};
  std::mutex mutex_;
  std::string built_on_;
  PowerMonitor monitor_;
  LiveAttribution attribution_{monitor_};
};

TEST_F(PaneWorkerTest, DrawsWhatIsAskedForAndTellsWhatItCost) {
  const auto worker = make_worker();
  PaneRequest request = request_for("mug");
  worker->ask(request);
  ASSERT_TRUE(eventually([&] { return whole(*worker); }));
  const auto output = worker->output();
  EXPECT_EQ(output->screen->width, 64);
  EXPECT_EQ(output->screen->rgba.size(), 64U * 48U * 4U);
  ASSERT_TRUE(output->frame.has_value());
  EXPECT_TRUE(output->frame->build_s.has_value());
  EXPECT_TRUE(output->frame->render_s.has_value());
  EXPECT_FALSE(output->frame->update_s.has_value());
  EXPECT_EQ(output->frame->rays, 64U * 48U);
  EXPECT_GT(frames_, 0);
  // The same again is no work.
  const std::uint64_t serial = output->serial;
  worker->ask(request);
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(worker->output()->serial, serial);
}

TEST_F(PaneWorkerTest, StructuresMakeTheSamePicture) {
  const auto worker = make_worker();
  PaneRequest request = request_for("mug");
  worker->ask(request);
  ASSERT_TRUE(eventually([&] { return whole(*worker); }));
  const auto first = worker->output()->image;
  for (const accel::StructureKind kind :
       {accel::StructureKind::grid_exact, accel::StructureKind::kd_sah}) {
    request.structure = accel::default_spec(kind);
    worker->ask(request);
    ASSERT_TRUE(eventually([&] {
      const auto output = worker->output();
      return whole(*worker) && output->image != first;
    }));
    EXPECT_EQ(renderer::compare_images(*first, *worker->output()->image).differing, 0U);
  }
}

TEST_F(PaneWorkerTest, HeatmapsNodesProbesAndThe3dViewComeWhenAskedFor) {
  const auto worker = make_worker();
  PaneRequest request = request_for("mug");
  worker->ask(request);
  ASSERT_TRUE(eventually([&] { return whole(*worker); }));
  EXPECT_FALSE(worker->output()->nodes);
  EXPECT_FALSE(worker->output()->heatmap);
  request.content = ui::PaneContent::heatmap;
  request.nodes = true;
  request.hits = true;
  request.hover = Probe{32, 24};
  request.pick = PickedRay{{32, 24}, ray_of(request.camera, {32, 24}, 64, 48)};
  request.selected_node = 0;
  request.free = FreeView{request.camera, 40, 30};
  worker->ask(request);
  ASSERT_TRUE(eventually([&] {
    const auto output = worker->output();
    return output && output->pick && output->free && output->nodes;
  }));
  const auto output = worker->output();
  ASSERT_TRUE(output->heatmap.has_value());
  EXPECT_GT(output->heatmap->max, 0.0);
  EXPECT_EQ(output->distances->size(), 64U * 48U);
  EXPECT_EQ(output->free->distances.size(), 40U * 30U);
  EXPECT_EQ(output->nodes->size(), output->stats->nodes);
  ASSERT_TRUE(output->pick->pixel.found);
  EXPECT_EQ(output->pick->path->counters.steps, output->pick->pixel.steps);
  EXPECT_EQ(output->pick->sentences.size(), output->pick->path->steps.size());
  EXPECT_EQ(output->hover->pixel.triangle, output->pick->pixel.triangle);
  EXPECT_FALSE(output->selected_triangles.empty());
  EXPECT_EQ(output->selected_triangles.size(), output->selected_shapes.size());
}

TEST_F(PaneWorkerTest, FramesSayWhereTheirOwnTreeWasBuilt) {
  const std::string why = test::why_no_gl_device();
  if (!why.empty()) GTEST_SKIP() << why;
  const auto worker = make_worker();
  PaneRequest request = request_for("wave");
  request.device = Device::gpu;
  request.structure = accel::default_spec(accel::StructureKind::bvh_sah);
  std::get<accel::BvhSettings>(request.structure.settings).preset = accel::BuildPreset::fast;
  request.build_on = accel::BuildPlace::device;
  const auto draw = [&] {
    const int before = frames_;
    worker->ask(request);
    return eventually([&] { return frames_ > before && whole(*worker); });
  };
  ASSERT_TRUE(draw());
  EXPECT_EQ(built_on(), "cpu") << "the first is the CPU's";
  request.time_s = 0.3;
  ASSERT_TRUE(draw());
  EXPECT_EQ(built_on(), "device");
  request.nodes = true;
  request.time_s = 0.6;
  ASSERT_TRUE(draw());
  EXPECT_EQ(built_on(), "cpu") << "somebody looks at the nodes";
}

TEST_F(PaneWorkerTest, ADifferenceOfEqualPicturesIsNone) {
  const auto one = make_worker();
  const auto two = make_worker();
  PaneRequest request = request_for("mug");
  request.hits = true;
  one->ask(request);
  ASSERT_TRUE(eventually([&] { return whole(*one); }));
  request.structure = accel::default_spec(accel::StructureKind::grid_box);
  request.content = ui::PaneContent::difference;
  request.other = one->output();
  two->ask(request);
  ASSERT_TRUE(eventually([&] { return whole(*two) && two->output()->difference; }));
  EXPECT_EQ(two->output()->difference->rmse, 0.0);
  EXPECT_EQ(two->output()->difference->differing_hits, std::optional<std::uint64_t>(0));
}

TEST_F(PaneWorkerTest, ABuildIsCancelledByTheUserAndGoesOnWhenAsked) {
  const auto worker = make_worker();
  PaneRequest request = request_for("dragon");
  request.structure = accel::default_spec(accel::StructureKind::kd_sah);
  worker->ask(request);
  ASSERT_TRUE(eventually([&] { return worker->status().doing.starts_with("building"); }));
  request.cancelled = true;
  worker->ask(request);
  ASSERT_TRUE(eventually([&] { return worker->status().state == ui::PaneState::cancelled; }));
  request.cancelled = false;
  worker->ask(request);
  EXPECT_TRUE(eventually([&] { return whole(*worker); }));
}

TEST_F(PaneWorkerTest, AFailureIsOneLineAndTheNextRequestWorks) {
  const auto worker = make_worker();
  PaneRequest request = request_for("mug");
  request.camera.target = request.camera.eye;
  worker->ask(request);
  ASSERT_TRUE(eventually([&] { return worker->status().state == ui::PaneState::failed; }));
  EXPECT_FALSE(worker->status().problem.empty());
  EXPECT_EQ(worker->status().problem.find('\n'), std::string::npos);
  worker->ask(request_for("mug"));
  EXPECT_TRUE(eventually([&] { return whole(*worker); }));
}

TEST_F(PaneWorkerTest, MeasureModeRunsThePanesByTurnsAndGivesBothTheirCost) {
  const auto one = make_worker();
  const auto two = make_worker();
  PaneRequest request = request_for("mug");
  one->ask(request);
  request.structure = accel::default_spec(accel::StructureKind::grid_exact);
  two->ask(request);
  ASSERT_TRUE(eventually([&] { return whole(*one) && whole(*two); }));
  MeasureScheduler scheduler(
      {{one.get(), two.get()}, &attribution_, &monitor_.clock(), monitor_.start(), [] {}});
  ui::MeasureSettings settings;
  settings.slot_s = 0.15F;
  settings.idle_s = 0.05F;
  scheduler.set(settings);
  scheduler.start();
  bool together = false;
  ASSERT_TRUE(eventually([&] {
    together = together || (one->in_slot() && two->in_slot());
    return scheduler.slots().size() >= 8;
  }));
  scheduler.stop();
  ASSERT_TRUE(eventually([&] { return !scheduler.running(); }));
  EXPECT_FALSE(together);
  const auto slots = scheduler.slots();
  for (std::size_t i = 1; i < slots.size(); ++i) EXPECT_GE(slots[i].from_s, slots[i - 1].to_s);
  const auto figures = attribution_.compute();
  ASSERT_EQ(figures->configurations.size(), 2U);
  for (const LiveFigures& one_configuration : figures->configurations) {
    EXPECT_GT(one_configuration.summary.operations, 0U);
    EXPECT_EQ(one_configuration.energy.origin, energy::Origin::modelled);
    ASSERT_TRUE(one_configuration.summary.watts.has_value());
    EXPECT_NEAR(one_configuration.summary.watts->value, 40.0, 6.0);
  }
  // And then they explore again.
  request.camera.eye.x += 0.5F;
  two->ask(request);
  EXPECT_TRUE(eventually([&] { return two->output()->camera == request.camera; }));
}

TEST_F(PaneWorkerTest, TheEndDoesNotWaitForABuild) {
  for (int i = 0; i < 3; ++i) {
    const auto worker = make_worker();
    PaneRequest request = request_for("dragon");
    request.structure = accel::default_spec(accel::StructureKind::kd_sah);
    worker->ask(request);
    ASSERT_TRUE(eventually([&] { return worker->status().state == ui::PaneState::working; }));
  }
}

}  // namespace
}  // namespace encore::app
