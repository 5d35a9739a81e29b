#include "app/workload_frames.h"
#include "energy/runner.h"
#include "tests/app/profile_fakes.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace encore::app {
namespace {

using accel::Policy;
using energy::Phase;

/// Runs one workload over fakes for a number of operations.
class ProfileWorkloads : public testing::Test {
 protected:
  energy::Measurement measure(TestKind test, Policy policy,
                              std::shared_ptr<const scene::Scene> scene,
                              std::uint64_t operations = 7) {
    WorkloadSpec spec;
    spec.scene = std::move(scene);
    spec.policy = policy;
    spec.test = test;
    spec.size = {8, 4};
    spec.threads = 1;
    const WorkloadTools tools = fakes.tools();
    workload = make_workload(spec, tools);
    energy::Plan plan;
    plan.warm_up = plan.run = energy::Seconds(0);
    plan.warm_up_operations = 0;
    plan.min_operations = plan.max_operations = operations;
    return energy::run(*workload, plan, {clock, clock.now(), never, {}, nullptr, {}, nullptr});
  }

  FakeTools fakes;
  energy::SteadyClock clock;
  std::atomic<bool> never{false};
  std::unique_ptr<SceneWorkload> workload;
};

TEST_F(ProfileWorkloads, BuildTestBuildsOnceAnOperationAndForcesUpdatesWhenRefitting) {
  const auto builds = measure(TestKind::build, Policy::rebuild, small_scene());
  EXPECT_EQ(builds.phase_counts[Phase::build], 7U);
  EXPECT_EQ(fakes.counts.builds, 1 + 7) << "one to prepare";
  EXPECT_EQ(fakes.counts.updates, 0);

  const auto updates = measure(TestKind::build, Policy::refit, small_scene());
  EXPECT_EQ(updates.phase_counts[Phase::build], 0U);
  EXPECT_EQ(updates.phase_counts[Phase::update], 7U) << "though nothing changed";
  EXPECT_EQ(fakes.counts.updates, 1 + 7) << "one to check";
}

TEST_F(ProfileWorkloads, StaticTestBuildsOnceAndOnlyRenders) {
  const auto m = measure(TestKind::fixed, Policy::rebuild, small_scene());
  EXPECT_EQ(m.phase_counts, (energy::PerPhase<std::uint64_t>{{{0, 0, 0, 0, 7}}}));
  EXPECT_EQ(fakes.counts.builds, 1);
  EXPECT_EQ(fakes.frames, 7);
}

TEST_F(ProfileWorkloads, DynamicTestRebuildsEveryFrameThatMoves) {
  const auto m = measure(TestKind::animated, Policy::rebuild, small_scene(moving()));
  EXPECT_EQ(m.phase_counts, (energy::PerPhase<std::uint64_t>{{{7, 7, 0, 0, 7}}}));
}

TEST_F(ProfileWorkloads, DynamicTestRefitsEveryFrameThatMoves) {
  const auto m = measure(TestKind::animated, Policy::refit, small_scene(moving()));
  EXPECT_EQ(m.phase_counts, (energy::PerPhase<std::uint64_t>{{{7, 0, 7, 0, 7}}}));
}

TEST_F(ProfileWorkloads, StructuresThatCannotRefitAreRebuilt) {
  fakes.can_refit = false;
  const auto m = measure(TestKind::animated, Policy::refit, small_scene(moving()));
  EXPECT_EQ(m.phase_counts, (energy::PerPhase<std::uint64_t>{{{7, 7, 0, 0, 7}}}));
  EXPECT_EQ(fakes.counts.updates, 0);
}

TEST_F(ProfileWorkloads, PolicyStaticNeverBuildsWhateverMoves) {
  const auto m = measure(TestKind::animated, Policy::fixed, small_scene(moving()));
  EXPECT_EQ(m.phase_counts, (energy::PerPhase<std::uint64_t>{{{7, 0, 0, 0, 7}}}));
  EXPECT_EQ(fakes.counts.builds, 1) << "to have something to trace";
  EXPECT_EQ(fakes.counts.updates, 0);
}

TEST_F(ProfileWorkloads, AnAnimationThatChangesNothingIsNeitherRebuiltNorRefitted) {
  for (const Policy policy : {Policy::rebuild, Policy::refit}) {
    const auto m = measure(TestKind::animated, policy, small_scene(resting()));
    EXPECT_EQ(m.phase_counts, (energy::PerPhase<std::uint64_t>{{{7, 0, 0, 0, 7}}}));
  }
  EXPECT_EQ(fakes.counts.updates, 0);
}

TEST_F(ProfileWorkloads, ScenesOfFrameSequencesShowEachFrameOnce) {
  scene::FrameSequence sequence;
  sequence.frames = {two_triangles(1), two_triangles(2), two_triangles(1)};
  sequence.frames_per_second = 10.0F;
  const auto scene = small_scene(sequence);
  EXPECT_DOUBLE_EQ(frame_step_s(*scene), 0.1);
  const auto m = measure(TestKind::animated, Policy::refit, scene, 8);
  // Frames 0 1 2 | 0 1 2 | 0 1 2: the count changes at every step but that to a new loop, whose
  // first frame looks as the last one did; where it changes, refitting is out of the question.
  EXPECT_EQ(m.phase_counts[Phase::build], 6U);
  EXPECT_EQ(m.phase_counts[Phase::update], 0U);
  EXPECT_TRUE(changes_triangle_count(*scene));
}

TEST_F(ProfileWorkloads, PolicyStaticCannotFollowAChangingCount) {
  scene::FrameSequence sequence;
  sequence.frames = {two_triangles(1), two_triangles(2)};
  const auto scene = small_scene(sequence);
  WorkloadSpec spec;
  spec.scene = scene;
  spec.policy = Policy::fixed;
  spec.test = TestKind::animated;
  EXPECT_FALSE(reason_to_skip(spec).empty());
  spec.device = Device::raster;
  EXPECT_EQ(reason_to_skip(spec), "") << "without a structure nothing has to follow";
  EXPECT_THROW(measure(TestKind::animated, Policy::fixed, scene), std::runtime_error);
}

TEST_F(ProfileWorkloads, AWrongStructureIsNeverTimed) {
  fakes.lie = true;
  for (const TestKind test : {TestKind::build, TestKind::fixed, TestKind::animated}) {
    try {
      measure(test, Policy::rebuild, small_scene(moving()));
      FAIL() << to_string(test);
    } catch (const MismatchError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("small: fake is wrong after the build"), std::string::npos) << message;
      EXPECT_NE(message.find("origin ("), std::string::npos) << message;
      EXPECT_NE(message.find("expected triangle"), std::string::npos) << message;
    }
  }
  EXPECT_EQ(fakes.frames, 0);
}

TEST_F(ProfileWorkloads, AWrongUpdateIsNeverTimed) {
  fakes.lie_after_update = true;
  for (const TestKind test : {TestKind::build, TestKind::animated}) {
    EXPECT_THROW(measure(test, Policy::refit, small_scene(moving())), MismatchError);
  }
  EXPECT_NO_THROW(measure(TestKind::fixed, Policy::refit, small_scene(moving())));
}

TEST_F(ProfileWorkloads, ConfigurationAndCountersHaveTheSessionsColumns) {
  measure(TestKind::fixed, Policy::rebuild, small_scene());
  std::vector<std::string> keys;
  for (const auto& part : workload->configuration()) keys.push_back(part.key);
  EXPECT_EQ(keys, configuration_columns());
  std::vector<std::string> names;
  for (const auto& counter : workload->counters({})) names.push_back(counter.name);
  EXPECT_EQ(names, counter_columns());
}

TEST_F(ProfileWorkloads, FiguresThatDoNotApplyAreMissing) {
  measure(TestKind::build, Policy::rebuild, small_scene());
  const auto configuration = workload->configuration();
  for (const auto& part : configuration) {
    if (part.key == "width" || part.key == "height") {
      EXPECT_EQ(part.value, "");
    }
    if (part.key == "triangles") {
      EXPECT_EQ(part.value, "2");
    }
  }
  for (const auto& counter : workload->counters({})) {
    // The spec says bvh-median: no grid, no exact triangle-box tests, no rays in a build.
    for (const char* absent : {"grid_x", "triangle_box_tests", "mrays_per_s", "hits"}) {
      if (counter.name == absent) {
        EXPECT_FALSE(counter.value) << absent;
      }
    }
    if (counter.name == "nodes") {
      EXPECT_TRUE(counter.value);
    }
  }
}

TEST_F(ProfileWorkloads, RaysASecondFollowFromTheRenderPhase) {
  measure(TestKind::fixed, Policy::rebuild, small_scene());
  energy::PerPhase<energy::Seconds> mean{};
  mean[Phase::render] = energy::Seconds(1e-6);
  for (const auto& counter : workload->counters(mean)) {
    if (counter.name == "mrays_per_s") {
      EXPECT_NEAR(counter.value.value_or(0), 32.0, 1e-9);
    }
    // The square of side 16 in front of the camera at distance 25 is seen by some, not all.
    if (counter.name == "hits") {
      EXPECT_GT(counter.value.value_or(0), 0);
      EXPECT_LT(counter.value.value_or(32), 32);
    }
  }
}

}  // namespace
}  // namespace encore::app
