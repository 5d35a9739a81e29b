// Cutting a triangle to a node never loses a point of it, and leaves little more than the truth.
#include "accel/kdtree/triangle_clip.h"

#include "accel/kdtree/key_sort.h"
#include "accel/split_cost.h"
#include "kd_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace encore::accel {
namespace {

using kd_test::Random;
using scene::Bounds;
using scene::Triangle;

glm::vec3 lattice_point(Random& random, int steps, float spacing, float offset) {
  const auto coordinate = [&] {
    return offset + spacing * static_cast<float>(random.below(static_cast<std::uint32_t>(steps)));
  };
  const float x = coordinate();
  const float y = coordinate();
  return {x, y, coordinate()};
}

/// The part of `extent` inside the box: what is known of a triangle before it is cut.
Bounds common(const Bounds& a, const Bounds& b) {
  return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

bool holds(const Bounds& box, const glm::dvec3& p) {
  for (int k = 0; k < 3; ++k) {
    if (!(p[k] >= double(box.min[k]) && p[k] <= double(box.max[k]))) return false;
  }
  return true;
}

TEST(SplitExtent, HoldsEveryPointOfTheTriangleInTheHalfBoxes) {
  Random random(41);
  std::size_t points = 0;
  for (int round = 0; round < 20000; ++round) {
    // Small integers and weights of n/64 make every sampled point exact in double, so that it
    // really lies on the triangle; many lie on planes of the box.
    const float spacing = round % 2 ? 1.0F : 0x1p-12F;
    const float offset = round % 4 < 2 ? 0.0F : -1024.0F * spacing;
    const int steps = round % 3 ? 2048 : 16;
    const Triangle t = scene::make_triangle(lattice_point(random, steps, spacing, offset),
                                            lattice_point(random, steps, spacing, offset),
                                            lattice_point(random, steps, spacing, offset));
    Bounds box;
    box.extend(lattice_point(random, steps, spacing, offset));
    box.extend(lattice_point(random, steps, spacing, offset));
    const int axis = static_cast<int>(random.below(3));
    const float position = box.min[axis] * 0.5F + box.max[axis] * 0.5F;
    const Bounds extent = common(box, scene::bounds_of(t));
    if (extent.empty() || !(extent.min[axis] < position && position < extent.max[axis])) continue;
    const SplitExtent parts = split_extent(t, box, extent, axis, position);
    for (int a = 0; a <= 64; ++a) {
      for (int b = 0; a + b <= 64; ++b) {
        const glm::dvec3 p = (double(a) * glm::dvec3(t.v0) + double(b) * glm::dvec3(t.v1) +
                              double(64 - a - b) * glm::dvec3(t.v2)) /
                             64.0;
        if (!holds(box, p)) continue;
        ++points;
        if (p[axis] <= double(position)) {
          ASSERT_TRUE(holds(parts.lower, p)) << round;
        }
        if (p[axis] >= double(position)) {
          ASSERT_TRUE(holds(parts.upper, p)) << round;
        }
      }
    }
  }
  EXPECT_GT(points, 100000U);
}

TEST(SplitExtent, IsTightAndExactAtVertices) {
  const Triangle t = scene::make_triangle({0, 0, 0}, {8, 0, 0}, {0, 8, 4});
  const Bounds whole = scene::bounds_of(t);
  const SplitExtent parts = split_extent(t, whole, whole, 0, 6.0F);
  EXPECT_EQ(parts.lower.min, glm::vec3(0, 0, 0));
  EXPECT_EQ(parts.lower.max, glm::vec3(6, 8, 4));
  EXPECT_EQ(parts.upper.min, glm::vec3(6, 0, 0));
  EXPECT_EQ(parts.upper.max.x, 8.0F);
  EXPECT_NEAR(parts.upper.max.y, 2.0F, 1e-6F);
  EXPECT_GE(parts.upper.max.y, 2.0F);
  EXPECT_NEAR(parts.upper.max.z, 1.0F, 1e-6F);
}

TEST(SplitExtent, IsEmptyWhereOnlyTheTrianglesBoxReaches) {
  // The corner box touches the triangle's bounds but lies beyond its diagonal.
  const Triangle t = scene::make_triangle({0, 0, 0}, {8, 0, 0}, {0, 8, 0});
  const Bounds box{{5, 1, -1}, {8, 8, 1}};
  const SplitExtent parts = split_extent(t, box, common(box, scene::bounds_of(t)), 1, 4.0F);
  EXPECT_FALSE(parts.lower.empty());
  EXPECT_TRUE(parts.upper.empty());
}

TEST(SplitExtent, WorksAtTheEndsOfTheRange) {
  for (const float scale : {1e-38F, 1e-30F, 1e30F, 1e38F}) {
    const Triangle t =
        scene::make_triangle({-1 * scale, 0, 0}, {1 * scale, scale, 0}, {scale, 0, scale});
    const Bounds whole = scene::bounds_of(t);
    const SplitExtent parts = split_extent(t, whole, whole, 0, 0.0F);
    EXPECT_EQ(parts.lower.max.x, 0.0F);
    EXPECT_NEAR(parts.lower.max.y / scale, 0.5F, 1e-3F);
    EXPECT_EQ(parts.upper.max, whole.max);
  }
}

TEST(KeySort, SortsLikeTheFloatsThemselves) {
  Random random(42);
  for (const std::size_t count : {0UL, 1UL, 2UL, 100UL, 127UL, 128UL, 1000UL, 50000UL}) {
    for (const float width : {0.0F, 1e-3F, 1e30F}) {
      std::vector<float> values(count);
      for (float& v : values) v = 1.0F + random.between(-width, width);
      if (count > 2) {
        values[0] = -0.0F;
        values[1] = -std::numeric_limits<float>::denorm_min();
        values[2] = std::numeric_limits<float>::lowest();
      }
      std::vector<std::uint32_t> keys(count);
      std::vector<std::uint32_t> spare(count);
      std::transform(values.begin(), values.end(), keys.begin(), key_of_float);
      sort_keys(keys.data(), spare.data(), count);
      std::sort(values.begin(), values.end());
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(float_of_key(keys[i]), values[i]);
    }
  }
  EXPECT_EQ(key_of_float(-0.0F), key_of_float(0.0F));
}

TEST(SplitCost, WeighsTestsByTheSidesAreas) {
  KdTreeSettings settings;
  settings.traversal_cost = 1.0F;
  settings.intersection_cost = 80.0F;
  settings.empty_bonus = 0.5F;
  const SplitCost cost(Bounds{{0, 0, 0}, {4, 1, 1}}, 0, settings);
  EXPECT_DOUBLE_EQ(cost.leaf(3), 240.0);
  // The box's area is 18; the lower part's 2 * (1 + 2 * 1) = 6, the upper one's 14.
  EXPECT_DOUBLE_EQ(cost.split(1.0, 2, 1), 1.0 + 80.0 * (2 * 6.0 + 1 * 14.0) / 18.0);
  EXPECT_DOUBLE_EQ(cost.split(1.0, 0, 1), 1.0 + 80.0 * 0.5 * 14.0 / 18.0);
  for (const float scale : {1e-18F, 1e18F}) {
    const SplitCost scaled(Bounds{{0, 0, 0}, {4 * scale, scale, scale}}, 0, settings);
    EXPECT_NEAR(scaled.split(scale, 2, 1), cost.split(1.0, 2, 1), 1e-4);
  }
  // A line has lengths to compare.
  const SplitCost line(Bounds{{0, 0, 0}, {4, 0, 0}}, 0, settings);
  EXPECT_DOUBLE_EQ(line.split(1.0, 2, 1), 1.0 + 80.0 * (2 * 1.0 + 1 * 3.0) / 4.0);
}

}  // namespace
}  // namespace encore::accel
