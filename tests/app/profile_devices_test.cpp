#include "app/workload_frames.h"
#include "energy/runner.h"
#include "tests/app/profile_fakes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace encore::app {
namespace {

using accel::Policy;
using energy::Phase;
using Counts = energy::PerPhase<std::uint64_t>;
using Words = std::vector<std::string>;

/// Runs one workload over fake devices.
class ProfileDevices : public testing::Test {
 protected:
  void make(Device device, TestKind test, Policy policy,
            std::shared_ptr<const scene::Scene> scene = small_scene(moving())) {
    WorkloadSpec spec;
    spec.scene = std::move(scene);
    spec.device = device;
    spec.policy = policy;
    spec.test = test;
    spec.size = {8, 4};
    spec.build_on = build_on;
    workload = make_workload(spec, fakes.tools());
  }
  energy::Measurement measure(std::uint64_t operations, std::uint64_t warm_up = 0) {
    energy::Plan plan;
    plan.warm_up = plan.run = energy::Seconds(0);
    plan.warm_up_operations = warm_up;
    plan.min_operations = plan.max_operations = operations;
    return energy::run(*workload, plan, {clock, clock.now(), never, {}, nullptr, {}, nullptr});
  }
  /// The phases of what `work` marks, in order.
  template <class Work>
  std::vector<Phase> phases_of(const Work& work) {
    energy::PhaseLog log(clock);
    work(log);
    std::vector<Phase> phases;
    for (const energy::PhaseSpan& span : log.spans()) phases.push_back(span.phase);
    return phases;
  }
  std::vector<Phase> operation() {
    return phases_of([&](energy::PhaseLog& log) { workload->operation(log); });
  }
  std::vector<Phase> alone(Phase phase) {
    return phases_of([&](energy::PhaseLog& log) { workload->run_alone(phase, log); });
  }
  /// What the device does from now on.
  Words done(std::size_t since) const {
    return {fakes.device.done.begin() + static_cast<std::ptrdiff_t>(since),
            fakes.device.done.end()};
  }
  energy::Counter counter(const std::string& name) const {
    for (const auto& one : workload->counters({})) {
      if (one.name == name) return one;
    }
    throw std::logic_error("no counter " + name);
  }

  FakeTools fakes;
  accel::BuildPlace build_on = accel::BuildPlace::cpu;
  energy::SteadyClock clock;
  std::atomic<bool> never{false};
  std::unique_ptr<SceneWorkload> workload;
};

TEST_F(ProfileDevices, RebuiltStructuresAreSentAfterTheBuild) {
  make(Device::gpu, TestKind::animated, Policy::rebuild);
  workload->prepare();
  const std::size_t before = fakes.device.done.size();
  EXPECT_EQ(operation(),
            (std::vector{Phase::animate, Phase::build, Phase::transfer, Phase::render}));
  EXPECT_EQ(done(before), (Words{"refresh 1100", "draw"})) << "triangles and structure";
}

TEST_F(ProfileDevices, ADeviceThatRefitsGetsTheTrianglesAndTheHostsStructureStays) {
  make(Device::gpu, TestKind::animated, Policy::refit);
  workload->prepare();
  const std::size_t before = fakes.device.done.size();
  const int builds = fakes.counts.builds;
  EXPECT_EQ(operation(),
            (std::vector{Phase::animate, Phase::transfer, Phase::update, Phase::render}));
  EXPECT_EQ(done(before), (Words{"refresh 100", "refit", "draw"}));
  EXPECT_EQ(fakes.counts.updates, 0);
  EXPECT_EQ(fakes.counts.builds, builds);
  EXPECT_FALSE(counter("sah_cost").value) << "the host's boxes are not those that are traced";
  EXPECT_TRUE(counter("sah_cost").unavailable);
}

TEST_F(ProfileDevices, ADeviceThatBuildsGetsTheTrianglesAlone) {
  fakes.device.can_build = true;
  build_on = accel::BuildPlace::device;
  make(Device::gpu, TestKind::animated, Policy::rebuild);
  workload->prepare();
  std::size_t before = fakes.device.done.size();
  const int builds = fakes.counts.builds;
  EXPECT_EQ(operation(),
            (std::vector{Phase::animate, Phase::transfer, Phase::build, Phase::render}));
  EXPECT_EQ(done(before), (Words{"refresh 100", "build", "draw"}));
  EXPECT_EQ(fakes.counts.builds, builds);
  for (const char* figure : {"nodes", "leaves", "structure_bytes", "sah_cost"}) {
    EXPECT_FALSE(counter(figure).value) << figure << " is the host's tree's";
    EXPECT_TRUE(counter(figure).unavailable) << figure;
  }
  EXPECT_EQ(workload->separable(),
            (std::vector{Phase::animate, Phase::build, Phase::transfer, Phase::render}));
  before = fakes.device.done.size();
  EXPECT_EQ(alone(Phase::build), std::vector{Phase::build});
  EXPECT_EQ(done(before), Words{"build"});
  EXPECT_EQ(alone(Phase::transfer), (std::vector{Phase::animate, Phase::transfer, Phase::build}));

  make(Device::gpu, TestKind::forced, Policy::rebuild);
  workload->prepare();
  before = fakes.device.done.size();
  EXPECT_EQ(operation(), (std::vector{Phase::transfer, Phase::build, Phase::render}));
  EXPECT_EQ(done(before), (Words{"refresh 0", "build", "draw"})) << "there is nothing to send";
  EXPECT_EQ(workload->separable(), (std::vector{Phase::build, Phase::render}));

  make(Device::gpu, TestKind::build, Policy::rebuild);
  EXPECT_EQ(measure(6).phase_counts, (Counts{{{0, 6, 0, 0, 0}}}));

  make(Device::gpu, TestKind::fixed, Policy::fixed);
  before = fakes.device.done.size();
  workload->prepare();
  EXPECT_EQ(done(before), Words{"init 1100"}) << "what is built once is the host's";
}

TEST_F(ProfileDevices, AWrongBuildOfTheDeviceIsNeverTimed) {
  fakes.device.can_build = true;
  fakes.device.lie = true;
  build_on = accel::BuildPlace::device;
  for (const TestKind test : {TestKind::build, TestKind::animated, TestKind::forced}) {
    make(Device::gpu, test, Policy::rebuild);
    EXPECT_THROW(measure(3), MismatchError) << to_string(test);
  }
}

TEST_F(ProfileDevices, WhereTheDeviceCannotRefitTheHostDoesAndSendsIt) {
  fakes.device.can_refit = false;
  make(Device::gpu, TestKind::animated, Policy::refit);
  workload->prepare();
  const std::size_t before = fakes.device.done.size();
  EXPECT_EQ(operation(),
            (std::vector{Phase::animate, Phase::update, Phase::transfer, Phase::render}));
  EXPECT_EQ(done(before), (Words{"refresh 1100", "draw"}));
}

TEST_F(ProfileDevices, PolicyStaticSendsTheTrianglesAlone) {
  make(Device::gpu, TestKind::animated, Policy::fixed);
  workload->prepare();
  const std::size_t before = fakes.device.done.size();
  EXPECT_EQ(operation(), (std::vector{Phase::animate, Phase::transfer, Phase::render}));
  EXPECT_EQ(done(before), (Words{"refresh 100", "draw"}));
}

TEST_F(ProfileDevices, NothingIsSentWhereNothingChanged) {
  for (const Policy policy : {Policy::rebuild, Policy::refit}) {
    make(Device::gpu, TestKind::animated, policy, small_scene(resting()));
    EXPECT_EQ(measure(5).phase_counts, (Counts{{{5, 0, 0, 0, 5}}}));
  }
  make(Device::gpu, TestKind::fixed, Policy::fixed);
  EXPECT_EQ(measure(5).phase_counts, (Counts{{{0, 0, 0, 0, 5}}}));
  EXPECT_EQ(counter("transfer_bytes").value, 0.0) << "it could have been sent something";
  EXPECT_EQ(fakes.device.read, 0) << "pictures stay on the device";
}

TEST_F(ProfileDevices, ForcedFramesSendTheStructureThatWasBuilt) {
  make(Device::gpu, TestKind::forced, Policy::rebuild);
  workload->prepare();
  std::size_t before = fakes.device.done.size();
  EXPECT_EQ(operation(), (std::vector{Phase::build, Phase::transfer, Phase::render}));
  EXPECT_EQ(done(before), (Words{"refresh 1000", "draw"})) << "no triangle moved";

  make(Device::gpu, TestKind::forced, Policy::refit);
  workload->prepare();
  before = fakes.device.done.size();
  EXPECT_EQ(operation(), (std::vector{Phase::transfer, Phase::update, Phase::render}));
  EXPECT_EQ(done(before), (Words{"refresh 0", "refit", "draw"})) << "there is nothing to send";
  EXPECT_EQ(fakes.counts.updates, 0);
}

TEST_F(ProfileDevices, UpdatesOnTheDeviceAreATestOfTheirOwn) {
  make(Device::gpu, TestKind::build, Policy::refit);
  EXPECT_EQ(measure(6).phase_counts, (Counts{{{0, 0, 6, 0, 0}}}));
  EXPECT_EQ(std::count(fakes.device.done.begin(), fakes.device.done.end(), "refit"), 1 + 6)
      << "one to check";
  EXPECT_EQ(fakes.counts.updates, 0);
  EXPECT_FALSE(counter("hits").value) << "there is no picture";

  fakes.device.can_refit = false;
  make(Device::gpu, TestKind::build, Policy::refit);
  EXPECT_THROW(workload->prepare(), std::runtime_error);
}

TEST_F(ProfileDevices, TheRasterRendererHasNoStructure) {
  make(Device::raster, TestKind::animated, Policy::fixed);
  EXPECT_EQ(measure(5).phase_counts, (Counts{{{5, 0, 0, 5, 5}}}));
  make(Device::raster, TestKind::fixed, Policy::fixed);
  EXPECT_EQ(measure(5).phase_counts, (Counts{{{0, 0, 0, 0, 5}}}));
  EXPECT_EQ(fakes.counts.made, 0);

  for (const char* none : {"nodes", "sah_cost", "hits", "mrays_per_s", "rays_per_operation"}) {
    EXPECT_FALSE(counter(none).value) << none;
    EXPECT_FALSE(counter(none).unavailable) << none;
  }
  EXPECT_TRUE(counter("joules_per_pixel").unavailable) << "there is a picture, but no sensor";
  EXPECT_FALSE(counter("joules_per_mray").unavailable);
  const auto configuration = workload->configuration();
  EXPECT_EQ(configuration[2], (energy::KeyValue{"device", "raster"}));
  EXPECT_EQ(configuration[3], (energy::KeyValue{"structure", "none"}));
  EXPECT_EQ(configuration[4], (energy::KeyValue{"policy", "static"}));
  EXPECT_EQ(configuration[8], (energy::KeyValue{"memory", ""}));
}

TEST_F(ProfileDevices, TheRasterRendererFollowsAChangingTriangleCount) {
  scene::FrameSequence sequence;
  sequence.frames = {two_triangles(1), two_triangles(2)};
  make(Device::raster, TestKind::animated, Policy::fixed, small_scene(sequence));
  const auto counts = measure(6).phase_counts;
  EXPECT_EQ(counts[Phase::transfer], 6U);
}

TEST_F(ProfileDevices, BytesAndTheDevicesClockAreMeansOfTheMeasuredOperations) {
  make(Device::gpu, TestKind::animated, Policy::rebuild);
  measure(4, 3);
  EXPECT_EQ(counter("transfer_bytes").value, 1100.0);
  EXPECT_EQ(counter("converted_bytes").value, 110.0);
  EXPECT_NEAR(counter("device_transfer_s").value.value_or(0), 0.002, 1e-12);
  EXPECT_NEAR(counter("device_render_s").value.value_or(0), 0.002, 1e-12);
  alone(Phase::transfer);
  alone(Phase::render);
  EXPECT_NEAR(counter("device_render_s").value.value_or(0), 0.002, 1e-12)
      << "phases that run alone are no operations";

  fakes.device.clock = false;
  make(Device::gpu, TestKind::animated, Policy::rebuild);
  measure(4);
  EXPECT_FALSE(counter("device_render_s").value);
  EXPECT_TRUE(counter("device_render_s").unavailable) << "it happened, but there is no clock";
  EXPECT_TRUE(counter("device_transfer_s").unavailable);

  make(Device::cpu, TestKind::animated, Policy::rebuild);
  measure(4);
  for (const char* none :
       {"transfer_bytes", "converted_bytes", "device_transfer_s", "device_render_s"}) {
    EXPECT_FALSE(counter(none).value) << none;
    EXPECT_FALSE(counter(none).unavailable) << none;
  }
}

TEST_F(ProfileDevices, TheWarmUpIsNoPartOfTheFigures) {
  // Frames 0 1 1 | 0 1 1: of three steps two change something.
  scene::FrameSequence sequence;
  sequence.frames = {two_triangles(1), two_triangles(2), two_triangles(2)};
  make(Device::gpu, TestKind::animated, Policy::rebuild, small_scene(sequence));
  measure(1, 1);
  EXPECT_EQ(counter("transfer_bytes").value, 0.0) << "the second step changes nothing";
}

TEST_F(ProfileDevices, HitsAreThoseOfTheDevice) {
  make(Device::gpu, TestKind::fixed, Policy::fixed);
  measure(3);
  EXPECT_EQ(counter("hits").value, 8.0);
  EXPECT_EQ(counter("rays_per_operation").value, 32.0);
}

TEST_F(ProfileDevices, AWrongDeviceIsNeverTimed) {
  fakes.device.lie = true;
  for (const TestKind test : {TestKind::fixed, TestKind::animated, TestKind::forced}) {
    make(Device::gpu, test, Policy::rebuild);
    try {
      measure(3);
      FAIL() << to_string(test);
    } catch (const MismatchError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("fake on device gpu (fake board) is wrong after the build"),
                std::string::npos)
          << message;
    }
  }
  EXPECT_EQ(std::count(fakes.device.done.begin(), fakes.device.done.end(), "draw"), 0);
}

TEST_F(ProfileDevices, AWrongRefitOfTheDeviceIsNeverTimed) {
  fakes.device.lie_after_refit = true;
  for (const TestKind test : {TestKind::build, TestKind::animated, TestKind::forced}) {
    make(Device::gpu, test, Policy::refit);
    EXPECT_THROW(measure(3), MismatchError) << to_string(test);
  }
  make(Device::gpu, TestKind::fixed, Policy::fixed);
  EXPECT_NO_THROW(measure(3));
}

TEST_F(ProfileDevices, PhasesThatRunAloneTellTransferFromTheRest) {
  make(Device::gpu, TestKind::animated, Policy::rebuild);
  measure(2);
  EXPECT_EQ(workload->separable(),
            (std::vector{Phase::animate, Phase::build, Phase::transfer, Phase::render}));
  EXPECT_EQ(alone(Phase::animate), std::vector{Phase::animate});
  EXPECT_EQ(alone(Phase::build), std::vector{Phase::build});
  const std::size_t before = fakes.device.done.size();
  EXPECT_EQ(alone(Phase::transfer), (std::vector{Phase::animate, Phase::build, Phase::transfer}));
  EXPECT_EQ(done(before), Words{"refresh 1100"}) << "something really is sent";
  EXPECT_EQ(alone(Phase::render), std::vector{Phase::render});

  make(Device::gpu, TestKind::animated, Policy::refit);
  measure(2);
  EXPECT_EQ(workload->separable(),
            (std::vector{Phase::animate, Phase::update, Phase::transfer, Phase::render}));
  EXPECT_EQ(alone(Phase::update), std::vector{Phase::update});
  EXPECT_EQ(alone(Phase::transfer), (std::vector{Phase::animate, Phase::transfer, Phase::update}));

  make(Device::gpu, TestKind::forced, Policy::refit);
  measure(2);
  EXPECT_EQ(workload->separable(), (std::vector{Phase::update, Phase::render}))
      << "there is nothing to send";
}

TEST_F(ProfileDevices, WhatWasOnlyAnimatedIsMadeUpForByTheNextFrame) {
  scene::FrameSequence sequence;
  sequence.frames = {two_triangles(1), two_triangles(2), two_triangles(2), two_triangles(2)};
  make(Device::gpu, TestKind::animated, Policy::rebuild, small_scene(sequence));
  workload->prepare();
  EXPECT_EQ(alone(Phase::animate), std::vector{Phase::animate});
  // This step changes nothing, but the device still has the frame before the last.
  EXPECT_EQ(operation(),
            (std::vector{Phase::animate, Phase::build, Phase::transfer, Phase::render}));
}

TEST_F(ProfileDevices, NamesTellTheDevice) {
  WorkloadSpec spec;
  spec.scene = small_scene();
  spec.device = Device::gpu;
  spec.policy = Policy::refit;
  spec.test = TestKind::animated;
  spec.size = {8, 4};
  EXPECT_EQ(workload_name(spec), "small, bvh-median, gpu, dynamic (refit), 8x4");
  spec.device = Device::raster;
  EXPECT_EQ(workload_name(spec), "small, raster, dynamic, 8x4");
  spec.device = Device::cpu;
  EXPECT_EQ(workload_name(spec), "small, bvh-median, dynamic (refit), 8x4");
}

}  // namespace
}  // namespace encore::app
