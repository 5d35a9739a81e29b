// What each policy does when triangles change, and when policy auto finds a hierarchy too old.
#include "accel/update_policy.h"

#include "accel/brute_force.h"
#include "accel/bvh/bvh.h"
#include "accel/make_structure.h"
#include "accel/test_rays.h"
#include "accel/verify.h"
#include "scene/sample_scenes.h"
#include "scene/triangles.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace encore::accel {
namespace {

using scene::TriangleChange;

constexpr int kFrames = 40;

/// A moving scene under policy auto, frame by frame.
class AutoRun {
 public:
  AutoRun(const char* name, float rebuild_at)
      : AutoRun(scene::make_sample_scene(name).value(), rebuild_at) {}
  AutoRun(scene::Scene scene, float rebuild_at) : scene_(std::move(scene)) {
    StructureSpec spec = default_spec(StructureKind::bvh_median);
    std::get<BvhSettings>(spec.settings).rebuild_at = rebuild_at;
    structure = make_structure(spec);
    scene::update_triangles(scene_, 0.0, list);
    carry_out(UpdateAction::build, Policy::automatic, *structure, list.triangles);
  }

  UpdateAction frame() {
    ++frame_;
    const TriangleChange change =
        scene::update_triangles(scene_, scene_.duration_s() * (frame_ + 0.5) / kFrames, list);
    const UpdateAction action = decide(Policy::automatic, *structure, change);
    carry_out(action, Policy::automatic, *structure, list.triangles);
    return action;
  }

  scene::TriangleList list;
  std::unique_ptr<AccelerationStructure> structure;
  int frame_ = 0;

 private:
  scene::Scene scene_;
};

struct Counts {
  int builds = 0;
  int updates = 0;
};
Counts run(const char* name, float rebuild_at) {
  AutoRun run(name, rebuild_at);
  Counts counts;
  for (int i = 0; i < kFrames; ++i) {
    const UpdateAction action = run.frame();
    counts.builds += action == UpdateAction::build ? 1 : 0;
    counts.updates += action == UpdateAction::update ? 1 : 0;
  }
  return counts;
}

TEST(UpdatePolicy, DecidesByPolicyStructureAndChange) {
  const scene::Scene scene = scene::make_sample_scene("mug").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  for (const StructureKind kind : all_structure_kinds()) {
    const auto structure = make_structure(default_spec(kind));
    carry_out(UpdateAction::build, Policy::automatic, *structure, list.triangles);
    const UpdateAction refitted =
        structure->can_refit() ? UpdateAction::update : UpdateAction::build;
    for (const Policy policy : all_policies()) {
      EXPECT_EQ(decide(policy, *structure, TriangleChange::none), UpdateAction::none);
    }
    for (const TriangleChange change : {TriangleChange::moved, TriangleChange::topology}) {
      EXPECT_EQ(decide(Policy::fixed, *structure, change), UpdateAction::none);
      EXPECT_EQ(decide(Policy::rebuild, *structure, change), UpdateAction::build);
    }
    for (const Policy policy : {Policy::refit, Policy::automatic}) {
      EXPECT_EQ(decide(policy, *structure, TriangleChange::moved), refitted);
      EXPECT_EQ(decide(policy, *structure, TriangleChange::topology), UpdateAction::build);
      EXPECT_EQ(updates(policy, *structure), structure->can_refit());
    }
  }
}

TEST(UpdatePolicy, AutoRefitsUntilTheTreeHasDecayedAndThenRebuilds) {
  constexpr float kAt = 1.08F;
  for (const char* name : {"toys", "wave"}) {
    AutoRun run(name, kAt);
    EXPECT_EQ(run.structure->decay(), 1.0);
    Counts counts;
    for (int i = 0; i < kFrames; ++i) {
      const double before = run.structure->decay().value();
      const UpdateAction action = run.frame();
      EXPECT_EQ(action, before >= double(kAt) ? UpdateAction::build : UpdateAction::update);
      if (action == UpdateAction::build) {
        ++counts.builds;
        EXPECT_EQ(run.structure->decay(), 1.0) << "as good as new";
      } else {
        ++counts.updates;
      }
      BruteForce brute;
      brute.build(run.list.triangles);
      const auto rays = test_rays(RayKind::outside, 40, 1, run.list.triangles, *run.structure);
      EXPECT_EQ(compare_hits(*run.structure, brute, rays).mismatches(), 0U) << name << ' ' << i;
    }
    EXPECT_GT(counts.builds, 0) << name;
    EXPECT_GT(counts.updates, counts.builds) << name;
  }
}

TEST(UpdatePolicy, TheThresholdReachesFromAlwaysToNever) {
  const Counts never = run("toys", 1e6F);
  EXPECT_EQ(never.builds, 0);
  EXPECT_EQ(never.updates, kFrames);
  const Counts always = run("toys", 1.001F);
  EXPECT_GT(always.builds, kFrames / 3) << "every frame that follows an update";
}

TEST(UpdatePolicy, AScenesThatChangesItsCountIsAlwaysRebuilt) {
  const Counts counts = run("metaballs", 1e6F);
  EXPECT_EQ(counts.updates, 0);
  EXPECT_GT(counts.builds, 0);
}

/// The cow under a wave of its own.
scene::Scene waving_cow() {
  scene::Scene scene = scene::make_sample_scene("cow").value();
  scene::Deformer wave;
  wave.amplitude = 2.0F;
  for (scene::Instance& instance : scene.instances) instance.motion = wave;
  scene.mark_changed();
  return scene;
}

/// The cost of a tree by the definition and from what a visitor sees.
double cost_by_visiting(const AccelerationStructure& structure) {
  double sum = 0.0;
  double root = 0.0;
  structure.visit([&](const NodeView& node) {
    if (node.depth == 0) root = node.bounds.area();
    sum += node.bounds.area() * (node.leaf ? static_cast<double>(node.triangles.size()) : 1.0);
    return true;
  });
  return sum / root;
}

/// Runs half a loop of updates and holds decay to the costs that a visitor sees.
void expect_decay(AutoRun run, double tolerance) {
  EXPECT_EQ(run.structure->decay(), 1.0);
  const double built = cost_by_visiting(*run.structure);
  for (int i = 0; i < kFrames / 2; ++i) {
    ASSERT_EQ(run.frame(), UpdateAction::update);
    const double now = cost_by_visiting(*run.structure);
    EXPECT_NEAR(run.structure->stats().sah_cost, now, 1e-9 * now);
    EXPECT_NEAR(run.structure->assessed_cost().value(), now, tolerance * now) << i;
    EXPECT_NEAR(run.structure->decay().value(), now / built, tolerance) << i;
  }
  EXPECT_GT(cost_by_visiting(*run.structure), 1.03 * built);
}

TEST(UpdatePolicy, DecayIsTheCostOverThatOfTheBuild) {
  AutoRun small(waving_cow(), 1e6F);
  ASSERT_LE(small.structure->stats().nodes, 16384U);
  expect_decay(std::move(small), 1e-12);
}

TEST(UpdatePolicy, TheDecayOfLargeTreesIsThatOfASample) {
  AutoRun large("toys", 1e6F);
  ASSERT_GT(large.structure->stats().nodes, 16384U);
  expect_decay(std::move(large), 0.02);
}

TEST(UpdatePolicy, ATreeOfUnknownQualityIsRebuiltOnce) {
  const scene::Scene scene = scene::make_sample_scene("toys").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  const auto structure = make_structure(default_spec(StructureKind::bvh_median));
  structure->build(list.triangles);
  scene::update_triangles(scene, 0.3, list);
  structure->update(list.triangles);
  EXPECT_FALSE(structure->decay()) << "nobody looked at what it was after the build";
  structure->assess();
  EXPECT_FALSE(structure->decay());
  ASSERT_EQ(decide(Policy::automatic, *structure, TriangleChange::moved), UpdateAction::build);
  carry_out(UpdateAction::build, Policy::automatic, *structure, list.triangles);
  EXPECT_EQ(decide(Policy::automatic, *structure, TriangleChange::moved), UpdateAction::update);
  // Nor is a change that nobody looked at.
  structure->update(list.triangles);
  EXPECT_FALSE(structure->decay());
}

TEST(UpdatePolicy, FlatAndEmptyTreesDoNotDecay) {
  const std::vector<Triangle> point(8, scene::make_triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}));
  for (const std::span<const Triangle> triangles : {std::span<const Triangle>(point), {}}) {
    const auto structure = make_structure(default_spec(StructureKind::bvh_median));
    carry_out(UpdateAction::build, Policy::automatic, *structure, triangles);
    carry_out(UpdateAction::update, Policy::automatic, *structure, triangles);
    EXPECT_EQ(structure->decay(), 1.0);
    EXPECT_FALSE(structure->decayed());
  }
}

}  // namespace
}  // namespace encore::accel
