// Parts of triangles lie in the boxes that spatial splits give them, whatever was rounded.
#include "accel/brute_force.h"
#include "accel/wide/wide_bvh.h"
#include "accel/wide/wide_clip.h"
#include "cases.h"

#include <gtest/gtest.h>

#include <cstring>

namespace encore::accel::test {
namespace {

WideItem item_of(const Triangle& t) {
  const Bounds box = scene::bounds_of(t);
  return {{box.min.x, box.min.y, box.min.z}, 0, {-box.max.x, -box.max.y, -box.max.z}, 0};
}

bool contains(const WideItem& item, const double* point, double slack) {
  for (int k = 0; k < 3; ++k) {
    if (point[k] < item.lower[k] - slack || point[k] > -item.minus_upper[k] + slack) return false;
  }
  return true;
}

TEST(WideClip, EveryPointIsInThePartOfItsSide) {
  encore::test::Random random(17);
  for (int round = 0; round < 3000; ++round) {
    const float offset = round % 3 == 0 ? 1000.0F : 0.0F;
    const glm::vec3 shift(offset);
    const Triangle t = scene::make_triangle(random.point(1.0F) + shift, random.point(1.0F) + shift,
                                            random.point(1.0F) + shift);
    WideItem item = item_of(t);
    for (int cut = 0; cut < 4 && !is_empty(item); ++cut) {
      const int axis = static_cast<int>(random.below(3));
      const float plane = random.between(item.lower[axis], -item.minus_upper[axis]);
      WideItem sides[2];
      clip_wide_item(t, item, axis, plane, sides);
      EXPECT_LE(-sides[0].minus_upper[axis], plane);
      EXPECT_GE(sides[1].lower[axis], plane);
      for (int i = 0; i < 50; ++i) {
        const double u = random.unit(), v = (1.0 - u) * random.unit(), w = 1.0 - u - v;
        double point[3];
        for (int k = 0; k < 3; ++k) point[k] = w * t.v0[k] + u * t.v1[k] + v * t.v2[k];
        // The point itself is rounded.
        const double slack = 0x1p-50 * (1.0 + offset);
        if (!contains(item, point, -slack)) continue;
        EXPECT_TRUE(contains(sides[point[axis] > plane ? 1 : 0], point, slack)) << round;
      }
      item = sides[random.below(2)];
    }
  }
}

TEST(WideClip, NoHitIsLostBetweenParts) {
  encore::test::Random random(23);
  std::vector<Triangle> triangles = encore::test::triangle_soup(1500, 0.02F, 1.0F, 22);
  for (int i = 0; i < 40; ++i) {
    const glm::vec3 at = random.point(1.0F), end = random.point(1.0F);
    triangles.push_back(scene::make_triangle(at, end, at + random.point(0.05F)));
  }
  BvhSettings settings;
  settings.preset = BuildPreset::best;
  WideBvh bvh(settings, MemoryMode::fresh);
  bvh.build(triangles);
  ASSERT_GT(bvh.tree().references, triangles.size());
  BruteForce brute;
  brute.build(triangles);
  const std::vector<Ray> rays = hard_rays(brute, triangles, 200, 5);
  std::vector<Hit> expected(rays.size()), found(rays.size());
  brute.intersect(rays, expected);
  bvh.intersect(rays, found);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    wrong += std::memcmp(&expected[i], &found[i], sizeof(Hit)) == 0 ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0U) << "of " << rays.size();
}

}  // namespace
}  // namespace encore::accel::test
