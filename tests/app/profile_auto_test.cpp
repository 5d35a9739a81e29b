// Policy auto in the dynamic test: each frame an update or a build, by how far the tree has
// decayed.
#include "app/workload_frames.h"
#include "energy/runner.h"
#include "scene/scene_file.h"
#include "tests/app/profile_fakes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace encore::app {
namespace {

using accel::Policy;
using energy::Phase;

constexpr std::uint64_t kFrames = 40;

std::shared_ptr<const scene::Scene> sample(const std::string& name) {
  return std::make_shared<const scene::Scene>(scene::load_scene(name));
}

class ProfileAuto : public testing::Test {
 protected:
  /// Over the program's own structures and renderer.
  energy::Measurement measure(float rebuild_at) {
    spec.scene = sample("wave");
    std::get<accel::BvhSettings>(spec.structure.settings).rebuild_at = rebuild_at;
    workload = make_workload(spec, standard_tools());
    energy::Plan plan;
    plan.warm_up = plan.run = energy::Seconds(0);
    plan.warm_up_operations = 0;
    plan.min_operations = plan.max_operations = kFrames;
    return energy::run(*workload, plan, {clock, clock.now(), never, {}, nullptr, {}, nullptr});
  }
  static WorkloadSpec auto_spec() {
    WorkloadSpec spec;
    spec.policy = Policy::automatic;
    spec.test = TestKind::animated;
    spec.size = {8, 4};
    spec.threads = 1;
    return spec;
  }

  WorkloadSpec spec = auto_spec();
  FakeTools fakes;
  energy::SteadyClock clock;
  std::atomic<bool> never{false};
  std::unique_ptr<SceneWorkload> workload;
};

TEST_F(ProfileAuto, EveryFrameHasAnUpdateOrABuildAsItHappened) {
  const auto m = measure(1.05F);
  const std::uint64_t builds = m.phase_counts[Phase::build];
  EXPECT_GT(builds, 0U);
  EXPECT_GT(m.phase_counts[Phase::update], builds);
  EXPECT_EQ(m.phase_counts[Phase::update] + builds, kFrames);
  // No clock is looked at: the next run does the same.
  EXPECT_EQ(measure(1.05F).phase_counts, m.phase_counts);
}

TEST_F(ProfileAuto, AThresholdOutOfReachIsAPureRefit) {
  const auto m = measure(1000.0F);
  EXPECT_EQ(m.phase_counts[Phase::build], 0U);
  EXPECT_EQ(m.phase_counts[Phase::update], kFrames);
}

TEST_F(ProfileAuto, TheConfigurationSaysAuto) {
  measure(1000.0F);
  for (const auto& part : workload->configuration()) {
    if (part.key == "policy") {
      EXPECT_EQ(part.value, "auto");
    }
    if (part.key == "update_case") {
      EXPECT_EQ(part.value, "real");
    }
  }
  const auto phases = workload->separable();
  for (const Phase phase : {Phase::animate, Phase::update, Phase::build, Phase::render}) {
    EXPECT_EQ(std::count(phases.begin(), phases.end(), phase), 1);
  }
}

TEST_F(ProfileAuto, OnADeviceTheHostFitsAndSends) {
  spec.scene = small_scene(moving());
  spec.device = Device::gpu;
  workload = make_workload(spec, fakes.tools());
  workload->prepare();
  const std::size_t before = fakes.device.done.size();
  energy::PhaseLog log(clock);
  workload->operation(log);
  std::vector<Phase> phases;
  for (const energy::PhaseSpan& span : log.spans()) phases.push_back(span.phase);
  EXPECT_EQ(phases, (std::vector{Phase::animate, Phase::update, Phase::transfer, Phase::render}));
  const std::vector<std::string> done(
      fakes.device.done.begin() + static_cast<std::ptrdiff_t>(before), fakes.device.done.end());
  EXPECT_EQ(done, (std::vector<std::string>{"refresh 1100", "draw"}));
  for (const auto& counter : workload->counters({})) {
    if (counter.name == "sah_cost") {
      EXPECT_FALSE(counter.unavailable) << "the host's boxes are those that are traced";
    }
  }
}

TEST_F(ProfileAuto, HasNothingOfItsOwnWhereNothingMoves) {
  spec.scene = small_scene(moving());
  EXPECT_EQ(reason_to_skip(spec), "");
  for (const TestKind test : {TestKind::build, TestKind::forced}) {
    spec.test = test;
    EXPECT_NE(reason_to_skip(spec).find("refit"), std::string::npos);
  }
}

}  // namespace
}  // namespace encore::app
