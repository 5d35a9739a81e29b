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
    auto& bvh = std::get<accel::BvhSettings>(spec.structure.settings);
    bvh.auto_rule = accel::AutoRule::quality;
    bvh.rebuild_at = rebuild_at;
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

/// A cow that flies apart within four seconds.
std::shared_ptr<const scene::Scene> bursting() {
  auto scene = std::make_shared<scene::Scene>(scene::load_scene("cow"));
  scene::Deformer burst;
  burst.kind = scene::Deformer::Kind::explode;
  burst.amplitude = 8.0F;
  burst.frequency_hz = 0.25F;
  for (scene::Instance& instance : scene->instances) instance.motion = burst;
  return scene;
}

std::optional<double> counter(const SceneWorkload& workload, std::string_view name) {
  for (const auto& one : workload.counters({})) {
    if (one.name == name) return one.value;
  }
  ADD_FAILURE() << "no counter " << name;
  return std::nullopt;
}

TEST_F(ProfileAuto, ByCostsItRebuildsWhatFliesApart) {
  spec.scene = bursting();
  spec.size = {96, 96};
  DynamicWorkload dynamic(spec, standard_tools());
  dynamic.prepare();
  EXPECT_FALSE(dynamic.auto_figures()->break_even_frames);
  dynamic.begin_measuring();
  energy::PhaseLog log(clock);
  for (std::uint64_t i = 0; i < 2 * 120; ++i) {
    log.clear();
    dynamic.operation(log);
  }
  const accel::AutoFigures figures = dynamic.auto_figures().value();
  EXPECT_EQ(figures.rebuilds + figures.updates, 2U * 120U);
  // Once a loop at the very least, where it comes together again and a ray would meet everything.
  EXPECT_GE(figures.rebuilds, 2U);
  EXPECT_GE(figures.updates, 1U);
  EXPECT_GT(figures.break_even_at_rebuild.value(), 0.0);
  EXPECT_EQ(counter(dynamic, "break_even_frames"), figures.break_even_at_rebuild);
}

TEST_F(ProfileAuto, WhereUpdatesAreDearInJoulesItBuilds) {
  spec.scene = bursting();
  DynamicWorkload dynamic(spec, standard_tools());
  energy::PerPhase<double> watts;
  watts.fill(1.0);
  watts[Phase::update] = 1e6;
  dynamic.set_phase_weights(watts);
  dynamic.prepare();
  energy::PhaseLog log(clock);
  for (std::uint64_t i = 0; i < kFrames; ++i) {
    log.clear();
    dynamic.operation(log);
  }
  EXPECT_EQ(dynamic.auto_figures()->updates, 1U) << "the one that is measured";
}

TEST_F(ProfileAuto, OtherPoliciesHaveNoSuchFigures) {
  spec.scene = bursting();
  spec.policy = Policy::refit;
  DynamicWorkload dynamic(spec, standard_tools());
  EXPECT_FALSE(dynamic.auto_figures());
  EXPECT_FALSE(counter(dynamic, "break_even_frames"));
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
