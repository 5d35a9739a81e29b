// Policy auto by measured costs on a scene that flies apart: it rebuilds, and hits stay those of
// brute force. The costs it is fed are made up from the tree's own quality, so no clock is read.
#include "accel/auto_policy.h"
#include "accel/brute_force.h"
#include "accel/bvh/bvh.h"
#include "accel/test_rays.h"
#include "accel/update_policy.h"
#include "accel/verify.h"
#include "scene/sample_scenes.h"
#include "scene/triangles.h"

#include <gtest/gtest.h>

namespace encore::accel {
namespace {

TEST(AutoPolicyHits, StayRightWhileItRebuildsAnExplosion) {
  scene::Scene scene = scene::make_sample_scene("cow").value();
  scene::Deformer burst;
  burst.kind = scene::Deformer::Kind::explode;
  burst.amplitude = 8.0F;
  burst.frequency_hz = 0.25F;
  for (scene::Instance& instance : scene.instances) instance.motion = burst;
  scene.mark_changed();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  Bvh bvh(StructureKind::bvh_median, {}, MemoryMode::pool);
  AutoPolicy policy;
  carry_out(UpdateAction::build, Policy::automatic, bvh, list.triangles);
  policy.observe_build(4.0);
  policy.observe_frame(bvh.stats().sah_cost, bvh.assessed_cost());
  for (int frame = 1; frame <= 120; ++frame) {
    const auto change = scene::update_triangles(scene, frame / 30.0, list);
    const UpdateAction action = decide(Policy::automatic, bvh, change, policy);
    carry_out(action, Policy::automatic, bvh, list.triangles);
    if (action == UpdateAction::build) policy.observe_build(4.0);
    if (action == UpdateAction::update) policy.observe_update(1.0);
    policy.observe_frame(bvh.stats().sah_cost, bvh.assessed_cost());
    if (frame % 10 != 0) continue;
    BruteForce brute;
    brute.build(list.triangles);
    const auto rays = test_rays(RayKind::outside, 10, 1, list.triangles, bvh);
    EXPECT_EQ(compare_hits(bvh, brute, rays).mismatches(), 0U) << frame;
  }
  EXPECT_GE(policy.figures().rebuilds, 3U);
  EXPECT_GE(policy.figures().updates, 3U);
  EXPECT_GT(policy.figures().break_even_at_rebuild.value(), 0.0);
}

/// A sample of the nodes tells the decay as well as all of them.
TEST(AutoPolicyHits, ASampleOfTheNodesTellsTheDecay) {
  const scene::Scene scene = scene::make_sample_scene("wave").value();
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  Bvh bvh(StructureKind::bvh_median, {}, MemoryMode::pool);
  bvh.build(list.triangles);
  ASSERT_GT(bvh.nodes().size(), 16384U);
  const double all = bvh_sah_cost(bvh.nodes());
  bvh.assess();
  for (const double time : {0.2, 0.4, 0.7, 1.1}) {
    scene::update_triangles(scene, time, list);
    bvh.update(list.triangles);
    bvh.assess();
    EXPECT_NEAR(bvh.decay().value(), bvh_sah_cost(bvh.nodes()) / all, 0.03) << time;
  }
}

}  // namespace
}  // namespace encore::accel
