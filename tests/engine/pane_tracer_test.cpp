// A pane does the least work that brings it to what is asked for.
#include "app/window/pane_tracer.h"

#include "energy/clock.h"
#include "scene/sample_scenes.h"
#include "tests/support/gl_devices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace encore::app {
namespace {

PaneRequest request_for(const char* scene, Device device = Device::cpu) {
  PaneRequest request;
  request.scene = std::make_shared<const scene::Scene>(*scene::make_sample_scene(scene));
  request.device = device;
  request.camera = request.scene->camera;
  request.width = 48;
  request.height = 32;
  request.threads = 1;
  return request;
}

class PaneTracerTest : public testing::Test {
 protected:
  std::vector<energy::Phase> prepare(const PaneRequest& request) {
    log_.clear();
    tracer_.prepare(request, log_, nullptr);
    std::vector<energy::Phase> phases;
    for (const energy::PhaseSpan& span : log_.spans()) phases.push_back(span.phase);
    return phases;
  }
  energy::SteadyClock clock_;
  energy::PhaseLog log_{clock_};
  PaneTracer tracer_{std::nullopt};
};

using Phases = std::vector<energy::Phase>;

TEST_F(PaneTracerTest, BuildsOnceAndThenOnlyWhatChanged) {
  PaneRequest request = request_for("mug");
  EXPECT_TRUE(tracer_.must_build(request));
  EXPECT_EQ(prepare(request), Phases{energy::Phase::build});
  EXPECT_FALSE(tracer_.must_build(request));
  EXPECT_EQ(prepare(request), Phases{});
  request.camera.eye.x += 1.0F;
  EXPECT_EQ(prepare(request), Phases{});
  request.structure = accel::default_spec(accel::StructureKind::kd_sah);
  EXPECT_EQ(prepare(request), Phases{energy::Phase::build});
  request.rebuild = 7;
  EXPECT_EQ(prepare(request), Phases{energy::Phase::build});
  EXPECT_EQ(prepare(request), Phases{});
}

TEST_F(PaneTracerTest, AMovingSceneFollowsItsPolicy) {
  PaneRequest request = request_for("wave");
  ASSERT_TRUE(request.scene->animated());
  prepare(request);
  request.time_s = 0.3;
  EXPECT_EQ(prepare(request), (Phases{energy::Phase::animate, energy::Phase::build}));
  request.policy = accel::Policy::refit;
  request.time_s = 0.4;
  EXPECT_EQ(prepare(request), (Phases{energy::Phase::animate, energy::Phase::update}));
  request.policy = accel::Policy::fixed;
  request.time_s = 0.5;
  EXPECT_EQ(prepare(request), Phases{energy::Phase::animate});
}

TEST_F(PaneTracerTest, PolicyAutoWeighsSecondsWithWattsWhereTheyAreStated) {
  // Whatever the seconds of this machine: one of the two is dearer by far in joules.
  for (const bool dear_build : {false, true}) {
    PaneRequest request = request_for("wave");
    request.structure = accel::default_spec(accel::StructureKind::bvh_median);
    request.policy = accel::Policy::automatic;
    energy::PerPhase<double> watts;
    watts.fill(1.0);
    watts[energy::Phase::build] = dear_build ? 1e9 : 1e-9;
    watts[energy::Phase::update] = dear_build ? 1e-9 : 1e9;
    request.phase_watts = watts;
    int builds = 0;
    int updates = 0;
    for (int frame = 0; frame < 40; ++frame) {
      request.time_s = 0.05 * frame;
      const Phases phases = prepare(request);
      tracer_.learn_frame(0.01);
      if (frame < 10) continue;  // what it costs is learned first
      builds += static_cast<int>(std::count(phases.begin(), phases.end(), energy::Phase::build));
      updates += static_cast<int>(std::count(phases.begin(), phases.end(), energy::Phase::update));
    }
    EXPECT_EQ(dear_build ? updates : builds, 30);
    EXPECT_EQ(dear_build ? builds : updates, 0);
    tracer_.clear();
  }
}

TEST_F(PaneTracerTest, ContentChangesWithTimeButNotWithTheStructure) {
  PaneRequest request = request_for("wave");
  prepare(request);
  const std::uint64_t first = tracer_.content_serial();
  prepare(request);
  EXPECT_EQ(tracer_.content_serial(), first);
  request.time_s = 0.3;
  prepare(request);
  EXPECT_NE(tracer_.content_serial(), first);
}

TEST_F(PaneTracerTest, ACancelledBuildIsDoneAgainWhenAskedFor) {
  PaneRequest request = request_for("toys");
  const std::atomic<bool> cancel{true};
  accel::BuildWatch watch;
  watch.cancel = &cancel;
  log_.clear();
  EXPECT_THROW(tracer_.prepare(request, log_, &watch), accel::BuildCancelled);
  EXPECT_EQ(tracer_.structure(), nullptr);
  EXPECT_TRUE(tracer_.must_build(request));
  EXPECT_EQ(prepare(request), Phases{energy::Phase::build});
  EXPECT_NE(tracer_.structure(), nullptr);
}

TEST_F(PaneTracerTest, ForcedFramesBuildOrUpdateThoughNothingMoves) {
  PaneRequest request = request_for("mug");
  prepare(request);
  log_.clear();
  tracer_.follow_forced(request, log_);
  ASSERT_EQ(log_.spans().size(), 1U);
  EXPECT_EQ(log_.spans()[0].phase, energy::Phase::build);
  request.policy = accel::Policy::refit;
  log_.clear();
  tracer_.follow_forced(request, log_);
  ASSERT_EQ(log_.spans().size(), 1U);
  EXPECT_EQ(log_.spans()[0].phase, energy::Phase::update);
}

/// The same pane with structures built on the device and on the CPU.
class BuildingDevice : public PaneTracerTest {
 protected:
  void SetUp() override {
    const std::string why = test::why_no_gl_device();
    if (!why.empty()) GTEST_SKIP() << why;
  }
  static PaneRequest fast_request() {
    PaneRequest request = request_for("wave", Device::gpu);
    request.structure = accel::default_spec(accel::StructureKind::bvh_sah);
    std::get<accel::BvhSettings>(request.structure.settings).preset = accel::BuildPreset::fast;
    request.build_on = accel::BuildPlace::device;
    return request;
  }
  renderer::Image picture(PaneTracer& tracer, const PaneRequest& request) {
    renderer::Image image;
    tracer.draw(request.camera, request.width, request.height, log_, nullptr);
    tracer.renderer()->read(image);
    return image;
  }
  /// Draws the same on a pane whose structures come from the CPU.
  void expect_same_picture(PaneRequest request, const std::string& what) {
    const renderer::Image found = picture(tracer_, request);
    request.build_on = accel::BuildPlace::cpu;
    energy::PhaseLog log(clock_);
    cpu_.prepare(request, log, nullptr);
    EXPECT_FALSE(cpu_.built_on_device());
    const renderer::Image expected = picture(cpu_, request);
    ASSERT_EQ(found.pixels.size(), expected.pixels.size());
    EXPECT_TRUE(found.pixels == expected.pixels) << what;
  }
  PaneTracer cpu_{std::nullopt};
};

TEST_F(BuildingDevice, SendsTheTrianglesAloneAndDrawsTheSamePicture) {
  PaneRequest request = fast_request();
  EXPECT_EQ(prepare(request), (Phases{energy::Phase::build, energy::Phase::transfer}))
      << "the first is the CPU's";
  EXPECT_FALSE(tracer_.built_on_device());
  const std::uint64_t whole = tracer_.uploaded_bytes();
  for (const double time_s : {0.3, 0.6}) {
    request.time_s = time_s;
    EXPECT_EQ(prepare(request),
              (Phases{energy::Phase::animate, energy::Phase::transfer, energy::Phase::build}));
    EXPECT_TRUE(tracer_.built_on_device());
    EXPECT_TRUE(tracer_.fitted_on_device());
    EXPECT_LT(tracer_.uploaded_bytes(), whole);
    expect_same_picture(request, std::to_string(time_s));
  }
  EXPECT_EQ(prepare(request), Phases{}) << "nothing changed";
}

TEST_F(BuildingDevice, WhoeverNeedsTheNodesGetsATreeOfTheCpu) {
  PaneRequest request = fast_request();
  prepare(request);
  request.time_s = 0.4;
  prepare(request);
  ASSERT_TRUE(tracer_.built_on_device());
  request.nodes = true;
  EXPECT_EQ(prepare(request), (Phases{energy::Phase::build, energy::Phase::transfer}));
  EXPECT_FALSE(tracer_.fitted_on_device());
  EXPECT_FALSE(tracer_.built_on_device());
  expect_same_picture(request, "nodes");
}

TEST_F(BuildingDevice, ADeviceThatIsSentEverythingAnewGetsATreeOfThatTime) {
  PaneRequest request = fast_request();
  prepare(request);
  request.time_s = 0.4;
  prepare(request);
  ASSERT_TRUE(tracer_.built_on_device());
  request.structure.intersection = accel::IntersectionMode::watertight;
  EXPECT_EQ(prepare(request), (Phases{energy::Phase::build, energy::Phase::transfer}));
  expect_same_picture(request, "another mode");
  request.policy = accel::Policy::refit;
  request.time_s = 0.5;
  prepare(request);
  ASSERT_TRUE(tracer_.fitted_on_device());
  request.device = Device::cpu;
  prepare(request);
  EXPECT_FALSE(tracer_.fitted_on_device());
  expect_same_picture(request, "the CPU after a fit of the device's");
}

TEST_F(BuildingDevice, OthersAreBuiltOnTheCpuWhateverIsAskedFor) {
  PaneRequest request = fast_request();
  std::get<accel::BvhSettings>(request.structure.settings).preset = accel::BuildPreset::balanced;
  prepare(request);
  request.time_s = 0.4;
  EXPECT_EQ(prepare(request),
            (Phases{energy::Phase::animate, energy::Phase::build, energy::Phase::transfer}));
  EXPECT_FALSE(tracer_.built_on_device());
}

TEST_F(PaneTracerTest, AnotherSceneReplacesEverything) {
  prepare(request_for("mug"));
  const auto before = tracer_.triangles().triangles.size();
  const PaneRequest request = request_for("wave");
  EXPECT_EQ(prepare(request), Phases{energy::Phase::build});
  EXPECT_NE(tracer_.triangles().triangles.size(), before);
  EXPECT_TRUE(tracer_.draw(request.camera, 16, 16, log_, nullptr));
}

TEST_F(PaneTracerTest, PolicyStaticSaysWhatItCannotFollow) {
  PaneRequest request = request_for("toys");
  // A scene whose number of triangles changes from frame to frame.
  auto changing = std::make_shared<scene::Scene>(*request.scene);
  const auto few = std::make_shared<const scene::Model>(*changing->instances.front().model);
  auto less = std::make_shared<scene::Model>(*few);
  less->mesh.triangles.pop_back();
  if (!less->mesh.material_of.empty()) less->mesh.material_of.pop_back();
  changing->instances.resize(1);
  changing->instances[0].motion = scene::FrameSequence{{few, less}, 10.0F};
  request.scene = changing;
  request.policy = accel::Policy::fixed;
  prepare(request);
  request.time_s = 0.15;
  log_.clear();
  try {
    tracer_.prepare(request, log_, nullptr);
    FAIL() << "a structure over triangles that are gone was traced";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("choose rebuild"), std::string::npos);
  }
}

}  // namespace
}  // namespace encore::app
