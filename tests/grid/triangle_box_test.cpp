// The triangle-box test never turns away a triangle that touches, and keeps none that does not.
#include "accel/triangle_box.h"

#include "tests/grid/random_scenes.h"
#include "tests/grid/triangle_clip.h"

#include <gtest/gtest.h>

#include <cmath>

namespace encore::accel::test {
namespace {

const scene::Bounds kUnit{vec3(0.0F), vec3(1.0F)};

TEST(TriangleBox, TouchingAFaceAnEdgeOrACornerIsOverlapping) {
  EXPECT_TRUE(overlaps(scene::make_triangle(vec3(1, 0, 0), vec3(2, 0, 0), vec3(1, 2, 0)), kUnit));
  EXPECT_TRUE(overlaps(scene::make_triangle(vec3(1, 1, 1), vec3(2, 1, 1), vec3(1, 2, 3)), kUnit));
  // The plane x + y + z = 3 meets the box in its corner alone, x + y = 2 in an edge.
  EXPECT_TRUE(overlaps(scene::make_triangle(vec3(3, 0, 0), vec3(0, 3, 0), vec3(0, 0, 3)), kUnit));
  EXPECT_TRUE(overlaps(scene::make_triangle(vec3(2, 0, -1), vec3(0, 2, -1), vec3(1, 1, 5)), kUnit));
  // An edge that grazes a box edge from outside.
  EXPECT_TRUE(
      overlaps(scene::make_triangle(vec3(2, 0, 0.5F), vec3(0, 2, 0.5F), vec3(4, 4, 0.5F)), kUnit));
}

TEST(TriangleBox, ALittleFurtherAwayIsApart) {
  const float d = 1e-6F;
  EXPECT_FALSE(
      overlaps(scene::make_triangle(vec3(1 + d, 0, 0), vec3(2, 0, 0), vec3(1 + d, 2, 0)), kUnit));
  EXPECT_FALSE(overlaps(
      scene::make_triangle(vec3(3 + d, 0, 0), vec3(0, 3 + d, 0), vec3(0, 0, 3 + d)), kUnit));
  EXPECT_FALSE(overlaps(
      scene::make_triangle(vec3(2 + d, 0, 0.5F), vec3(d, 2, 0.5F), vec3(4, 4, 0.5F)), kUnit));
  // A segment past a corner, which only the cross products can tell.
  EXPECT_FALSE(
      overlaps(scene::make_triangle(vec3(2 + d, 0, 0), vec3(d, 2, 1), vec3(d, 2, 1)), kUnit));
}

TEST(TriangleBox, AgreesWithClippingAtAnyScale) {
  Random random(5);
  std::size_t together = 0, apart = 0;
  for (int i = 0; i < 200000; ++i) {
    const float scale = std::ldexp(1.0F, static_cast<int>(random.below(121)) - 60);
    const float size = random.below(2) == 0 ? 0.3F : 3.0F;
    const vec3 center = random.point(1.5F);
    const vec3 a = center + random.point(size);
    const vec3 b = center + random.point(size);
    const vec3 c = random.below(8) == 0 ? b : center + random.point(size);
    const Triangle triangle = scene::make_triangle(a * scale, b * scale, c * scale);
    const scene::Bounds box{vec3(-0.5F, -0.6F, -0.7F) * scale, vec3(0.5F, 0.4F, 0.3F) * scale};
    const bool found = overlaps(triangle, box);
    if (clip_leaves_something(triangle, box, -1e-12)) {
      ++together;
      ASSERT_TRUE(found) << i;
    } else if (!clip_leaves_something(triangle, box, 1e-12)) {
      ++apart;
      ASSERT_FALSE(found) << i;
    }
  }
  EXPECT_GT(together, 20000U);
  EXPECT_GT(apart, 20000U);
}

TEST(TriangleBox, CutsOfATriangleAtACellPlaneLieOnBothSides) {
  // A vertex exactly on the common plane of two boxes belongs to both.
  Random random(6);
  for (int i = 0; i < 100000; ++i) {
    const vec3 on_plane(0.0F, random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F));
    const Triangle t = scene::make_triangle(on_plane, random.point(2.0F), random.point(2.0F));
    ASSERT_TRUE(overlaps(t, {vec3(-1.0F), vec3(0.0F, 1.0F, 1.0F)}));
    ASSERT_TRUE(overlaps(t, {vec3(0.0F, -1.0F, -1.0F), vec3(1.0F)}));
  }
}

TEST(TriangleBox, ABoxWithoutVolumeIsStillMet) {
  const Triangle t = scene::make_triangle(vec3(0, 0, 0), vec3(4, 0, 0), vec3(0, 4, 0));
  EXPECT_TRUE(overlaps(t, {vec3(1, 1, 0), vec3(1, 1, 0)}));
  EXPECT_TRUE(overlaps(t, {vec3(2, 2, 0), vec3(2, 2, 0)}));
  EXPECT_FALSE(overlaps(t, {vec3(3, 2, 0), vec3(3, 2, 0)}));
}

}  // namespace
}  // namespace encore::accel::test
